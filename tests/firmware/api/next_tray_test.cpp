#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "tests/firmware/api/hub_rig.hpp"

namespace traygauge::test {
namespace {

using Json = nlohmann::json;

void connect(HubRig& rig, const Json& dishes) {
  const Json state = {{"state", "waiting"}, {"dishes", dishes}};
  rig.station().tell({MessageType::state, state.dump(), {}});
  rig.store(1, 100.0);  // everything before it has arrived
}

// What the hub told the station; waits for it.
Json told(HubRig& rig) {
  for (int i = 0; i < 500; ++i) {
    rig.station().attend();
    if (const std::optional<std::string> text = rig.station().take_next_tray()) return Json::parse(*text);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return {};
}

TEST(NextTrayRoutes, TellTheStation) {
  HubRig rig;
  connect(rig, {"dinner", "soup"});
  const Answer answer =
      rig.post("/api/v1/next-tray", R"({"tray":"order 4711","foods":3,"dishes":["soup"],"valid_s":90})");
  ASSERT_EQ(answer.status, 202) << answer.body;
  const Json expected = {{"tray", "order 4711"}, {"foods", 3}, {"dishes", {"soup"}}, {"valid_ms", 90'000}};
  EXPECT_EQ(told(rig), expected);
  EXPECT_EQ(answer.json()["station"], "kitchen");
  EXPECT_EQ(rig.post("/api/v1/next-tray", R"({"station":"kitchen","foods":1})").json()["valid_ms"], 60'000);
  EXPECT_EQ(told(rig)["foods"], 1);
  EXPECT_EQ(rig.request("DELETE", "/api/v1/next-tray?station=kitchen", {}, {}).status, 202);
  EXPECT_EQ(told(rig)["valid_ms"], 0);
}

TEST(NextTrayRoutes, SayWhatIsWrong) {
  HubRig rig;
  connect(rig, {"dinner"});
  const auto message = [&rig](const std::string& body) {
    const Answer answer = rig.post("/api/v1/next-tray", body);
    EXPECT_EQ(answer.status, 400) << body;
    return answer.json()["error"]["message"].get<std::string>();
  };
  EXPECT_EQ(message("[]").find("expected a JSON object"), 0U);
  EXPECT_EQ(message("{}").find("expected at least one"), 0U);
  EXPECT_EQ(message(R"({"station":"canteen","foods":1})").find("station:"), 0U);
  EXPECT_EQ(message(R"({"station":7,"foods":1})").find("station:"), 0U);
  for (const char* foods : {"0", "199", "-1", "1.5", "\"3\"", "true", "[]"}) {
    const std::string body = std::string(R"({"foods":)").append(foods).append("}");
    EXPECT_EQ(message(body).find("foods:"), 0U) << body;
  }
  EXPECT_EQ(message(R"({"dishes":["bowl"]})"), "dishes: expected some of dinner");
  EXPECT_EQ(message(nlohmann::json({{"dishes", std::vector<std::string>(9, "dinner")}}).dump()),
            "dishes: expected at most 8");
  EXPECT_EQ(message(R"({"dishes":"dinner"})").find("dishes:"), 0U);
  EXPECT_EQ(message(R"({"tray":7})").find("tray:"), 0U);
  EXPECT_EQ(message(R"({"tray":")" + std::string(65, 'x') + "\"}").find("tray:"), 0U);
  for (const char* seconds : {"0", "3601", "-5", "1.5", "null"}) {
    const std::string body = std::string(R"({"foods":2,"valid_s":)").append(seconds).append("}");
    EXPECT_EQ(message(body).find("valid_s:"), 0U) << body;
  }
  EXPECT_EQ(message(R"({"foods":2,"food":"rice"})").find("food:"), 0U);
}

TEST(NextTrayRoutes, NameTheStationWhereThereAreSeveral) {
  HubRig rig;
  connect(rig, Json::array());
  HubLinkParams params;
  params.socket = rig.folder().path() / "hub";
  params.station = "canteen";
  HubLink other(params);
  other.tell({MessageType::state, "{}", {}});
  for (int i = 0; i < 500 && rig.get("/api/v1/stations").json()["stations"].size() < 2; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(rig.post("/api/v1/next-tray", R"({"foods":2})").status, 400);
  EXPECT_EQ(rig.post("/api/v1/next-tray", R"({"foods":2,"station":"canteen"})").status, 202);
}

TEST(NextTrayRoutes, AreForManageAlone) {
  HubRig rig;
  EXPECT_EQ(rig.routes().at("POST /api/v1/next-tray"), "manage");
  EXPECT_EQ(rig.routes().at("DELETE /api/v1/next-tray"), "manage");
}

}  // namespace
}  // namespace traygauge::test
