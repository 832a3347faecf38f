#include "firmware/fleet/home_assistant.hpp"

#include <nlohmann/json.hpp>

#include "firmware/base/build_info.hpp"
#include "firmware/broker/topic.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::vector<RetainedMessage> home_assistant_messages(const FleetConfig& config) {
  const std::string id = "traygauge_" + topic_level(config.name);
  const auto topic = [&config](const char* what) {
    return topic_of(config.broker.prefix, config.name, what);
  };
  std::vector<RetainedMessage> messages;
  const auto add = [&](const std::string& component, const std::string& object, Json json) {
    json["unique_id"] = id + "_" + object;
    json["object_id"] = id + "_" + object;
    json["device"] = {{"identifiers", Json::array({id})},
                      {"name", "Traygauge " + config.name},
                      {"manufacturer", "Traygauge"},
                      {"sw_version", program_version()}};
    messages.push_back({config.home_assistant_prefix + "/" + component + "/" + id + "/" + object + "/config",
                        config.home_assistant == false ? std::string() : json.dump()});
  };
  add("binary_sensor", "status",
      {{"name", "Connection"},
       {"device_class", "connectivity"},
       {"entity_category", "diagnostic"},
       {"state_topic", topic("status")},
       {"payload_on", "online"},
       {"payload_off", "offline"}});
  add("sensor", "health",
      {{"name", "Health"},
       {"entity_category", "diagnostic"},
       {"state_topic", topic("health")},
       {"value_template", "{{ value_json.status }}"},
       {"availability_topic", topic("status")}});
  add("sensor", "volume",
      {{"name", "Last tray"},
       {"device_class", "volume"},
       {"unit_of_measurement", "mL"},
       {"state_topic", topic("scan")},
       {"value_template", "{{ value_json.scan.volume_ml }}"},
       {"availability_topic", topic("status")}});
  return messages;
}

std::string home_assistant_birth_topic(const FleetConfig& config) {
  return config.home_assistant_prefix + "/status";
}

}  // namespace traygauge
