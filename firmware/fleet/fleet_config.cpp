#include "firmware/fleet/fleet_config.hpp"

#include "firmware/broker/topic.hpp"
#include "simulator/capture/toml_file.hpp"

namespace traygauge {

FleetConfig read_fleet_table(const JsonNode& table, const std::string& name,
                             const std::filesystem::path& folder) {
  std::vector<std::string_view> keys = broker_keys();
  keys.insert(keys.end(), {"delivered", "home_assistant", "home_assistant_prefix"});
  expect_keys(table, keys);
  FleetConfig config;
  config.broker = read_broker_keys(table, "fleet", folder);
  config.name = name;
  if (const auto delivered = table.find("delivered")) {
    const std::string text = delivered->text();
    if (text != "receipt" && text != "broker")
      delivered->fail(R"("receipt" or "broker")", "correct the value");
    if (text == "broker") config.delivery = FleetDelivery::broker;
  }
  if (const auto told = table.find("home_assistant")) config.home_assistant = told->truth();
  if (const auto prefix = table.find("home_assistant_prefix")) {
    config.home_assistant_prefix = prefix->text();
    if (!is_topic_prefix(config.home_assistant_prefix))
      prefix->fail("levels of a-z, A-Z, 0-9, '-' and '_' with '/' between them", "correct the value");
  }
  return config;
}

}  // namespace traygauge
