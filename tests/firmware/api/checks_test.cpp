// What the hub answers of checks: those of a scan, and what many scans say of a station together.
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tests/firmware/api/hub_rig.hpp"

namespace traygauge::test {
namespace {

using Json = nlohmann::json;

constexpr const char* kDriftPart = "drift of kitchen";

void store_scans(HubRig& rig, std::uint64_t first, std::uint64_t last, double scale_percent) {
  SampleScan scan;
  for (scan.id.number = first; scan.id.number <= last; ++scan.id.number) {
    // Values that differ, as in life; their median is that of the middle one.
    scan.scale_percent = scale_percent + 0.01 * static_cast<double>(scan.id.number % 5) - 0.02;
    rig.store(scan);
  }
}

// Null where there is none.
Json drift_part(const HubRig& rig) {
  const Json health = rig.get("/health").json();
  for (const Json& part : health["parts"]) {
    if (part["name"] == kDriftPart) return part;
  }
  return nullptr;
}

// The lines of /metrics about checks.
std::string check_figures(const HubRig& rig) {
  std::istringstream lines(rig.get("/metrics").body);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("traygauge_check_")) text += line + "\n";
  }
  return text;
}

TEST(ApiChecks, AScanIsAnsweredWithThem) {
  HubRig rig;
  SampleScan sample;
  sample.scale_percent = -1.25;
  sample.blur_px = {0.875, std::nullopt};
  rig.store(sample);
  const Json scan = rig.get("/api/v1/scans/kitchen-1").json();
  ASSERT_EQ(scan["checks"].size(), 11U);
  EXPECT_EQ(scan["checks"][1]["name"], "scale_percent");
  EXPECT_EQ(scan["checks"][1]["value"], -1.25);
  EXPECT_EQ(scan["blur_px"], Json::parse("[0.875,null]"));
  EXPECT_EQ(rig.get("/api/v1/export.json").json()["scans"][0]["checks"], scan["checks"]);
  EXPECT_EQ(rig.get("/api/v1/scans").json()["scans"][0]["blur_px"], scan["blur_px"]);
}

TEST(ApiChecks, AScanOfAnEarlierProgramHasNone) {
  HubRig rig;
  SampleScan sample;
  sample.has_checks = false;
  rig.store(sample);
  const Json scan = rig.get("/api/v1/scans/kitchen-1").json();
  EXPECT_TRUE(scan["checks"].is_null());
  EXPECT_TRUE(scan["blur_px"].is_null());
  EXPECT_EQ(check_figures(rig), "");
  EXPECT_EQ(rig.get("/health").status, 200);
}

TEST(ApiChecks, HealthTellsOfADriftAndDoesNotFail) {
  HubRig rig;
  store_scans(rig, 1, 19, 0.72);
  EXPECT_TRUE(drift_part(rig).is_null()) << "too few scans";
  store_scans(rig, 20, 20, 0.72);
  const Answer health = rig.get("/health");
  EXPECT_EQ(health.status, 200);
  EXPECT_EQ(health.json()["status"], "warning");
  const Json part = drift_part(rig);
  EXPECT_EQ(part["status"], "warning");
  EXPECT_NE(part["message"].get<std::string>().find("In the last 20 trays the card made everything 0.72 % "
                                                    "larger than the dishes say (± 0.00 %). Measure"),
            std::string::npos)
      << part;
  EXPECT_NE(rig.get("/metrics").body.find("traygauge_healthy 1\n"), std::string::npos);
  // Another card, and the median is what the last fifty say.
  store_scans(rig, 21, 60, 0.0);
  EXPECT_TRUE(drift_part(rig).is_null());
}

TEST(ApiChecks, HealthTellsOfAllThatDrifts) {
  HubRig rig;
  SampleScan scan;
  scan.scale_percent = -0.7;
  scan.dish_height_mm = 1.2;
  for (scan.id.number = 1; scan.id.number <= 100; ++scan.id.number) {
    scan.blur_px = {scan.id.number <= 50 ? 0.8 : 1.2, std::nullopt};
    rig.store(scan);
  }
  const std::string message = drift_part(rig)["message"];
  EXPECT_NE(message.find("0.70 % smaller"), std::string::npos) << message;
  EXPECT_NE(message.find("1.20 mm above"), std::string::npos) << message;
  EXPECT_NE(message.find("1.50 times as blurred"), std::string::npos) << message;
}

TEST(ApiChecks, MetricsTellTheMedians) {
  HubRig rig;
  store_scans(rig, 1, 25, 0.72);
  EXPECT_EQ(check_figures(rig),
            "traygauge_check_median{station=\"kitchen\",check=\"scale_percent\"} 0.720\n"
            "traygauge_check_median{station=\"kitchen\",check=\"dish_height_mm\"} 0.046\n"
            "traygauge_check_median{station=\"kitchen\",check=\"blur_px\"} 0.891\n"
            "traygauge_check_median_error{station=\"kitchen\",check=\"scale_percent\"} 0.004\n"
            "traygauge_check_median_error{station=\"kitchen\",check=\"dish_height_mm\"} 0.000\n"
            "traygauge_check_median_error{station=\"kitchen\",check=\"blur_px\"} 0.000\n"
            "traygauge_check_scans{station=\"kitchen\",check=\"scale_percent\"} 25\n"
            "traygauge_check_scans{station=\"kitchen\",check=\"dish_height_mm\"} 25\n"
            "traygauge_check_scans{station=\"kitchen\",check=\"blur_px\"} 25\n"
            "traygauge_check_drifts{station=\"kitchen\",check=\"scale_percent\"} 1\n"
            "traygauge_check_drifts{station=\"kitchen\",check=\"dish_height_mm\"} 0\n"
            "traygauge_check_drifts{station=\"kitchen\",check=\"blur_px\"} 0\n");
}

TEST(ApiChecks, AHubThatWasStartedAnewSaysTheSame) {
  HubRig rig;
  store_scans(rig, 1, 60, 0.72);
  ASSERT_EQ(
      rig.post("/api/v1/scans/kitchen-60/corrections", R"({"action":"scan_wrong","author":"ann"})").status,
      201);
  SampleScan again;
  again.id.number = 61;
  again.supersedes = ScanId{"kitchen", 59};
  again.scale_percent = 7.0;
  rig.store(again);
  const std::string before = check_figures(rig);
  const Json part = drift_part(rig);
  EXPECT_NE(before.find("traygauge_check_scans{station=\"kitchen\",check=\"scale_percent\"} 50\n"),
            std::string::npos)
      << before;
  EXPECT_FALSE(part.is_null());
  rig.restart();
  EXPECT_EQ(check_figures(rig), before);
  EXPECT_EQ(drift_part(rig), part);
}

// The correction is answered before the next scan comes: it counts at once.
TEST(ApiChecks, AScanThatIsMarkedAsWrongDoesNotCount) {
  HubRig rig;
  store_scans(rig, 1, 20, 0.72);
  ASSERT_FALSE(drift_part(rig).is_null());
  const std::string target = "/api/v1/scans/kitchen-7/corrections";
  ASSERT_EQ(rig.post(target, R"({"action":"scan_wrong","author":"ann"})").status, 201);
  EXPECT_TRUE(drift_part(rig).is_null()) << "19 are left";
  ASSERT_EQ(rig.post(target, R"({"action":"undo","number":1,"author":"ann"})").status, 201);
  EXPECT_FALSE(drift_part(rig).is_null());
}

}  // namespace
}  // namespace traygauge::test
