// The events of a hub are those that openapi.yaml describes.
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>

#include "tests/firmware/api/hub_rig.hpp"
#include "tests/firmware/store/sample_shape.hpp"

namespace traygauge::test {
namespace {

using Json = nlohmann::json;

// The names of the events in what was heard; each one's data is held against its schema.
std::set<std::string> check_events(const std::string& heard) {
  const ApiDescription& description = ApiDescription::own();
  const Json& described = description.document()["paths"]["/api/v1/events"]["get"]["x-events"];
  std::set<std::string> names;
  std::istringstream lines(heard);
  std::string name;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("event: ")) name = line.substr(7);
    if (!line.starts_with("data: ")) continue;
    names.insert(name);
    EXPECT_TRUE(described.contains(name)) << name;
    if (!described.contains(name)) continue;
    for (const std::string& misfit : description.misfits(described[name], Json::parse(line.substr(6))))
      ADD_FAILURE() << name << ": " << misfit;
  }
  return names;
}

TEST(ApiEvents, AreThoseDescribed) {
  HubRig rig;
  const Listening listening = rig.listen("heartbeat");
  std::string heard = listening.answer.body;
  rig.store(1, 100.0);
  heard += HubRig::hear(listening, "event: scan");
  rig.station().tell({MessageType::shape, R"({"id":"kitchen-1"})", sample_shape({"kitchen", 1}).dump()},
                     Milliseconds(1000));
  heard += HubRig::hear(listening, "event: shape");
  ASSERT_EQ(
      rig.post("/api/v1/scans/kitchen-1/corrections", R"({"action":"scan_wrong","author":"ann"})").status,
      201);
  heard += HubRig::hear(listening, "event: correction");
  EXPECT_EQ(check_events(heard),
            (std::set<std::string>{"correction", "heartbeat", "scan", "shape", "station"}));
}

}  // namespace
}  // namespace traygauge::test
