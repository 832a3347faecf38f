// What is really sent, held against firmware/fleet/asyncapi.yaml.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "firmware/broker/topic.hpp"
#include "tests/firmware/api/json_schema.hpp"
#include "tests/firmware/api/yaml_document.hpp"
#include "tests/firmware/fleet/broker_process.hpp"
#include "tests/firmware/fleet/fleet_rig.hpp"

namespace traygauge::test {
namespace {

using Json = nlohmann::json;

// Both descriptions as one: that of the fleet refers to the API's.
class FleetDescription {
 public:
  FleetDescription() {
    const std::filesystem::path folder = std::filesystem::path(TRAYGAUGE_SOURCE_DIR) / "firmware";
    std::string text = read_yaml(folder / "fleet" / "asyncapi.yaml").dump();
    text = std::regex_replace(text, std::regex("\\.\\./api/openapi\\.yaml#"), "#");
    document_ = Json::parse(text);
    const Json api = read_yaml(folder / "api" / "openapi.yaml");
    document_["components"]["schemas"].update(api.at("components").at("schemas"));
  }
  std::set<std::string> channels() const {
    std::set<std::string> names;
    for (const auto& [name, channel] : document_.at("channels").items()) {
      EXPECT_EQ(channel.at("address"), "{prefix}/v1/{name}/" + name);
      names.insert(name);
    }
    return names;
  }
  std::vector<std::string> misfits(const std::string& channel, const std::string& payload) const {
    const Json& message = followed(document_.at("channels").at(channel).at("messages").begin().value());
    const bool is_text = message.contains("contentType") && message.at("contentType") == "text/plain";
    const JsonSchema schema(message.at("payload"), document_);
    return schema.misfits(is_text ? Json(payload) : Json::parse(payload));
  }

 private:
  const Json& followed(const Json& reference) const {
    const auto path = reference.at("$ref").get<std::string>();
    return document_.at(Json::json_pointer(path.substr(1)));
  }
  Json document_;
};

TEST(FleetDescription, HoldsForWhatIsSent) {
  TRAYGAUGE_NEED_BROKER();
  const FleetDescription description;
  BrokerProcess broker;
  const FleetConfig config = fleet_config(broker.port());
  Listener listener(config.broker);
  listener.give_receipts();
  FleetRig rig(config);
  rig.add(listener);
  ASSERT_TRUE(rig.run_until([&] { return listener.is_connected() && rig.fleet().is_connected(); }));
  rig.put(1);
  rig.put(2);
  rig.correct(1, "bulgur");
  ASSERT_TRUE(rig.run_until([&] { return rig.waiting() == 0; }));
  std::set<std::string> seen;
  for (const BrokerMessage& message : listener.heard) {
    const auto parts = split_topic("traygauge", message.topic);
    ASSERT_TRUE(parts) << message.topic;
    ASSERT_EQ(parts->level, "kitchen");
    const std::string channel(parts->what);
    ASSERT_TRUE(description.channels().contains(channel)) << channel;
    for (const std::string& misfit : description.misfits(channel, message.payload))
      ADD_FAILURE() << channel << misfit;
    seen.insert(channel);
  }
  EXPECT_EQ(seen, description.channels());
  EXPECT_FALSE(description.misfits("scan", R"({"event":"scan","id":"kitchen-1","scan":{}})").empty());
  EXPECT_FALSE(description.misfits("status", "away").empty());
}

}  // namespace
}  // namespace traygauge::test
