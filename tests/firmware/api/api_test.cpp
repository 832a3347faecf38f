#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>

#include "tests/firmware/api/hub_rig.hpp"
#include "tests/firmware/api/token_files.hpp"

namespace traygauge::test {
namespace {

using Json = nlohmann::json;

std::string error_code(const Answer& answer) {
  return answer.json()["error"]["code"];
}

TEST(Api, TheLatestScanIsTheOneThatArrivedLast) {
  HubRig rig;
  const Answer none = rig.get("/api/v1/scans/latest");
  EXPECT_EQ(none.status, 404);
  EXPECT_EQ(error_code(none), "no_scan_yet");
  rig.store(1, 100.0);
  rig.store(2, 250.5);
  const Answer latest = rig.get("/api/v1/scans/latest");
  EXPECT_EQ(latest.status, 200);
  EXPECT_EQ(latest.json()["id"], "kitchen-2");
  EXPECT_EQ(latest.json()["volume_ml"], 250.5);
  EXPECT_EQ(latest.json()["items"][0]["measured_volume_ml"], 250.5);
  EXPECT_EQ(latest.json()["taken_at"], "2026-11-27T07:00:00.000Z");
}

TEST(Api, OneScanAndItsDocument) {
  HubRig rig;
  rig.store(1, 100.0);
  EXPECT_EQ(rig.get("/api/v1/scans/kitchen-1").json()["id"], "kitchen-1");
  EXPECT_EQ(rig.get("/api/v1/scans/kitchen-1/document").json()["version"], 2);
  for (const std::string id : {"kitchen-2", "kitchen-01", "x", "kitchen-1-"}) {
    const Answer absent = rig.get("/api/v1/scans/" + id);
    EXPECT_EQ(absent.status, 404) << id;
    EXPECT_EQ(error_code(absent), "no_such_scan") << id;
  }
}

TEST(Api, PagesOfTheHistoryHoldEachScanOnce) {
  HubRig rig;
  for (int i = 1; i <= 25; ++i) rig.store(i, i, i);
  std::set<std::string> seen;
  std::string cursor;
  int pages = 0;
  do {
    const Answer page = rig.get("/api/v1/scans?limit=10" + cursor);
    ASSERT_EQ(page.status, 200) << page.body;
    const Json json = page.json();
    for (const Json& scan : json["scans"]) EXPECT_TRUE(seen.insert(scan["id"]).second) << scan["id"];
    // One that arrives meanwhile disturbs nothing.
    if (pages == 0) rig.store(26, 26, 26);
    cursor = json["next"].is_null() ? "" : "&cursor=" + json["next"].get<std::string>();
    ++pages;
  } while (!cursor.empty() && pages < 10);
  EXPECT_EQ(seen.size(), 25U);
  EXPECT_EQ(pages, 3);
}

TEST(Api, FiltersTheHistory) {
  HubRig rig;
  for (int i = 1; i <= 5; ++i) rig.store(i, i, 60 * i, i == 3 ? "card_not_found" : "ok");
  const auto ids = [&rig](const std::string& query) {
    std::vector<std::string> found;
    const Answer answer = rig.get("/api/v1/scans?" + query);
    EXPECT_EQ(answer.status, 200) << answer.body;
    const Json json = answer.json();
    for (const Json& scan : json["scans"]) found.push_back(scan["id"]);
    return found;
  };
  using Ids = std::vector<std::string>;
  EXPECT_EQ(ids("status=card_not_found"), Ids{"kitchen-3"});
  EXPECT_EQ(ids("from=2026-11-27T07:04:00Z"), (Ids{"kitchen-5", "kitchen-4"}));
  EXPECT_EQ(ids("to=2026-11-27T07:02:00Z"), Ids{"kitchen-1"});
  EXPECT_EQ(ids("station=canteen"), Ids{});
  EXPECT_EQ(ids("text=kitchen-2"), Ids{"kitchen-2"});
}

TEST(Api, RefusesWhatItDoesNotKnow) {
  HubRig rig;
  for (const std::string query : {"limit=0", "limit=201", "limit=x", "limit=5x", "cursor=!", "from=today",
                                  "to=2026-13-01T00:00:00Z", "corrected=yes", "statuss=ok"}) {
    const Answer answer = rig.get("/api/v1/scans?" + query);
    EXPECT_EQ(answer.status, 400) << query << answer.body;
    EXPECT_EQ(error_code(answer), "wrong_request") << query;
  }
  EXPECT_EQ(rig.get("/api/v1/nothing").status, 404);
  EXPECT_EQ(rig.post("/api/v1/scans", "{}").status, 405);
  EXPECT_EQ(rig.get("/api/v1/export.csv?limit=3").status, 400);
}

TEST(Api, CorrectionsStandBesideWhatWasMeasured) {
  HubRig rig;
  rig.store(1, 100.0);
  const std::string target = "/api/v1/scans/kitchen-1/corrections";
  const Answer split = rig.post(
      target,
      R"({"action":"split","item":2,"volume_ml":40,"food":"peas","author":"ann","reason":"two foods"})");
  ASSERT_EQ(split.status, 201) << split.body;
  const Json items = split.json()["items"];
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[0]["volume_ml"], 60.0);
  EXPECT_EQ(items[0]["measured_volume_ml"], 100.0);
  EXPECT_EQ(items[1]["food"], "peas");
  EXPECT_EQ(split.json()["volume_ml"], 100.0);
  const Json listed = rig.get(target).json()["corrections"];
  ASSERT_EQ(listed.size(), 1U);
  EXPECT_EQ(listed[0]["author"], "ann");
  EXPECT_EQ(listed[0]["reason"], "two foods");
  // The stored document is as it came.
  EXPECT_EQ(rig.get("/api/v1/scans/kitchen-1/document").json()["items"][0]["volume_ml"], 100.0);
  EXPECT_EQ(rig.post(target, R"({"action":"undo","number":1,"author":"ann"})").json()["items"].size(), 1U);
}

TEST(Api, RefusesCorrectionsThatCannotBe) {
  HubRig rig;
  rig.store(1, 100.0);
  const std::string target = "/api/v1/scans/kitchen-1/corrections";
  for (const std::string body : {"", "[]", "{", "{}", R"({"action":"explode","author":"ann"})",
                                 R"({"action":"rename","item":"two","author":"ann"})",
                                 R"({"action":"split","item":2,"author":"ann"})"}) {
    EXPECT_EQ(rig.post(target, body).status, 400) << body;
  }
  EXPECT_EQ(rig.post(target, R"({"action":"item_wrong","item":99,"author":"ann"})").status, 409);
  EXPECT_EQ(rig.post(target, R"({"action":"split","item":2,"volume_ml":-1,"author":"ann"})").status, 409);
  EXPECT_EQ(rig.post(target, R"({"action":"scan_wrong"})").status, 409);  // by nobody
  EXPECT_EQ(rig.post("/api/v1/scans/kitchen-9/corrections", R"({"action":"scan_wrong","author":"a"})").status,
            404);
  EXPECT_EQ(rig.post(target, std::string(20'000, 'x')).status, 413);
  EXPECT_TRUE(rig.get(target).json()["corrections"].empty());
}

TEST(Api, ExportsWhatTheHistoryHolds) {
  HubRig rig;
  for (int i = 1; i <= 40; ++i) rig.store(i, i, 60 * i, i == 7 ? "card_not_found" : "ok");
  const Answer csv = rig.get("/api/v1/export.csv");
  EXPECT_EQ(csv.status, 200);
  EXPECT_NE(csv.head.find("text/csv"), std::string::npos);
  std::istringstream lines(csv.body);
  std::string line;
  std::getline(lines, line);
  const auto commas = std::count(line.begin(), line.end(), ',');
  int rows = 0;
  while (std::getline(lines, line)) {
    ++rows;
    // The tray's name has a comma and quotes: it is one cell.
    EXPECT_NE(line.find("\"tray, \"\"one\"\"\""), std::string::npos) << line;
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas + 1) << line;
  }
  EXPECT_EQ(rows, 40);
  EXPECT_NE(csv.body.find("card_not_found"), std::string::npos);
  const Json json = rig.get("/api/v1/export.json").json();
  ASSERT_EQ(json["scans"].size(), 40U);
  EXPECT_EQ(json["scans"][0]["id"], "kitchen-1");
  EXPECT_EQ(rig.get("/api/v1/export.json?from=2026-11-27T07:39:30Z").json()["scans"].size(), 1U);
  EXPECT_TRUE(rig.get("/api/v1/export.json?station=x").json()["scans"].empty());
}

TEST(Api, ACellIsNoFormula) {
  HubRig rig;
  rig.store(1, 100.0);
  ASSERT_EQ(rig.post("/api/v1/scans/kitchen-1/corrections",
                     R"x({"action":"rename","item":2,"food":"=HYPERLINK(\"a\")","author":"ann"})x")
                .status,
            201);
  const std::string csv = rig.get("/api/v1/export.csv").body;
  EXPECT_NE(csv.find("\"'=HYPERLINK(\"\"a\"\")\""), std::string::npos) << csv;
}

TEST(Api, HealthNamesThePartThatFails) {
  HubRig rig;
  EXPECT_EQ(rig.get("/health").status, 200);
  rig.station().tell(
      {MessageType::state, R"({"state":"waiting","waiting_results":0,"disk":null,"faults":[]})", {}});
  rig.store(1, 100.0);
  EXPECT_EQ(rig.get("/health").status, 200);
  rig.station().tell(
      {MessageType::state,
       R"({"state":"starting","waiting_results":3,"disk":null,"faults":[{"device":"camera","message":"The device is gone."}]})",
       {}});
  rig.store(2, 100.0);
  const Answer failing = rig.get("/health");
  EXPECT_EQ(failing.status, 503);
  const Json parts = failing.json()["parts"];
  const auto part = [&parts](const std::string& name) {
    for (const Json& candidate : parts) {
      if (candidate["name"] == name) return candidate;
    }
    return Json();
  };
  EXPECT_EQ(part("camera of kitchen")["status"], "failing");
  EXPECT_EQ(part("queue of kitchen")["status"], "warning");
  EXPECT_EQ(part("station kitchen")["status"], "ok");
  EXPECT_EQ(part("disk")["status"], "ok");
}

// A hub that was away takes what waits; a queue that stands has another reason, and somebody has to look.
TEST(Api, HealthFailsWhereAQueueStands) {
  HubRig rig;
  auto health_with = [&rig, scan = 0](const std::string& state) mutable {
    rig.station().tell({MessageType::state, state, {}});
    rig.store(++scan, 100.0);  // its answer comes after the state was read
    return rig.get("/health");
  };
  EXPECT_EQ(health_with(R"({"waiting_results":3,"queue_stands_s":59.0})").status, 200);
  const Answer standing = health_with(R"({"waiting_results":3,"queue_stands_s":61.2})");
  EXPECT_EQ(standing.status, 503);
  EXPECT_NE(standing.body.find("3 results wait at the station to be stored. None was taken for 61 s"),
            std::string::npos)
      << standing.body;
  EXPECT_EQ(health_with(R"({"waiting_results":0,"queue_stands_s":61.2})").status, 200);
}

TEST(Api, HealthTellsOfABoardThatIsHotOrHasTooLittlePower) {
  HubRig rig;
  auto parts_with = [&rig, scan = 0](const std::string& state) mutable {
    rig.station().tell({MessageType::state, state, {}});
    rig.store(++scan, 100.0);  // its answer comes after the state was read
    const Answer health = rig.get("/health");
    EXPECT_EQ(health.status, 200) << health.body;
    return health.json()["parts"].dump();
  };
  const std::string well = parts_with(R"({"temperature_c":79.9,"under_voltage":false})");
  EXPECT_EQ(well.find("of kitchen"), std::string::npos) << well;
  const std::string untold = parts_with(R"({"temperature_c":null,"under_voltage":null})");
  EXPECT_EQ(untold.find("of kitchen"), std::string::npos) << untold;
  const std::string ill = parts_with(R"({"temperature_c":82.4,"under_voltage":true})");
  EXPECT_NE(ill.find(R"("power of kitchen","status":"warning")"), std::string::npos) << ill;
  EXPECT_NE(ill.find("take a stronger power supply"), std::string::npos) << ill;
  EXPECT_NE(ill.find(R"("temperature of kitchen","status":"warning")"), std::string::npos) << ill;
  EXPECT_NE(ill.find("The board has 82 °C"), std::string::npos) << ill;
  const std::string dirty = parts_with(R"({"lens":"Both pictures were dark there."})");
  EXPECT_NE(dirty.find(R"("message":"Both pictures were dark there.","name":"lens of kitchen")"),
            std::string::npos)
      << dirty;
}

// What a station says of itself is passed on; parts that make no sense say nothing.
TEST(Api, HealthStandsAStrangeStation) {
  HubRig rig;
  for (const std::string state :
       {R"({"faults":[{"device":5,"message":[]}]})", R"({"faults":[7]})", R"({"faults":7,"disk":7})",
        R"({"waiting_results":-1})", R"({"waiting_results":"many"})",
        R"({"waiting_results":2,"queue_stands_s":"long"})", R"({"under_voltage":7,"temperature_c":"hot"})",
        R"({"lens":[7]})", "{}"}) {
    rig.station().tell({MessageType::state, state, {}});
    rig.store(1, 100.0);
    EXPECT_NE(rig.get("/health").status, 500) << state;
    EXPECT_EQ(rig.get("/metrics").status, 200) << state;
  }
}

TEST(Api, TellsMetricsInPrometheusText) {
  HubRig rig;
  rig.store(1, 100.0);
  const Answer metrics = rig.get("/metrics");
  EXPECT_EQ(metrics.status, 200);
  EXPECT_NE(metrics.body.find("\ntraygauge_stored_scans 1\n"), std::string::npos) << metrics.body;
  rig.store(1, 100.0);  // the same again is none
  rig.store(2, 100.0);
  EXPECT_NE(rig.get("/metrics").body.find("\ntraygauge_store_new_scans_total 2\n"), std::string::npos);
  EXPECT_NE(metrics.body.find("traygauge_station_connected{station=\"kitchen\"} 1\n"), std::string::npos);
}

// Whoever has no token sees neither food nor person, and only who manages may correct.
TEST(Api, AsksForTokens) {
  const TokenFiles tokens;
  HubRig rig(tokens.config());
  rig.store(1, 100.0);
  const std::string view = TokenFiles::bearer(TokenFiles::kView);
  const std::string manage = TokenFiles::bearer(TokenFiles::kManage);
  EXPECT_EQ(rig.get("/health").status, 200);
  EXPECT_EQ(rig.get("/api/v1/scans/latest").status, 401);
  EXPECT_EQ(rig.get("/api/v1/scans/latest", view).status, 200);
  const std::string target = "/api/v1/scans/kitchen-1/corrections";
  EXPECT_EQ(rig.post(target, R"({"action":"scan_wrong","author":"eve"})", view).status, 403);
  EXPECT_EQ(rig.post(target, R"({"action":"scan_wrong","author":"eve"})", manage).status, 201);
  EXPECT_EQ(rig.get(target, view).json()["corrections"][0]["author"], "ann");
}

TEST(Api, AScreenOnThisMachineMayNeedNoToken) {
  const TokenFiles tokens;
  WebConfig config = tokens.config();
  config.local_without_token = true;
  HubRig rig(config);
  rig.store(1, 100.0);
  EXPECT_EQ(rig.get("/api/v1/scans/latest").status, 200);
  EXPECT_EQ(rig.get("/api/v1/scans/latest", "X-Forwarded-For: 192.0.2.7\r\n").status, 401);
}

TEST(Api, OthersAreNotServedWithoutTokens) {
  const TemporaryFolder folder;
  HubParams params;
  params.socket = folder.path() / "hub";
  params.store.options.file = folder.path() / "results.db";
  params.web.config.listen = {"0.0.0.0:0"};
  const auto hub = Hub::start(params, [](const std::string&) {});
  ASSERT_FALSE(hub.ok());
  EXPECT_NE(hub.failure().find("hub.listen"), std::string::npos) << hub.failure();
}

}  // namespace
}  // namespace traygauge::test
