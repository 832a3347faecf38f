#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/firmware/api/hub_rig.hpp"

namespace traygauge::test {
namespace {

// The zone is the process's: what a test sets does not outlive it.
class Site : public ::testing::Test {
 protected:
  ~Site() override {
    ::unsetenv("TZ");
    ::tzset();
  }
};

TEST_F(Site, HasANameAndATimeZoneInEveryAnswer) {
  WebConfig web;
  web.site_name = "North canteen";
  web.time_zone = "Asia/Kathmandu";
  HubRig rig(web);
  rig.store(1, 100.0);
  const nlohmann::json site = rig.get("/api/v1/site").json();
  EXPECT_EQ(site["name"], "North canteen");
  EXPECT_EQ(site["time_zone"], "Asia/Kathmandu");
  EXPECT_TRUE(site["configuration_problem"].is_null());
  EXPECT_FALSE(site["program"].get<std::string>().empty());
  EXPECT_TRUE(site["commit"].is_null()) << "tests are of no commit; see build_info.hpp";
  // 07:00 UTC
  const std::string local = "2026-11-27T12:45:00.000+05:45";
  EXPECT_EQ(rig.get("/api/v1/scans/latest").json()["taken_at_local"], local);
  EXPECT_NE(rig.get("/api/v1/export.csv").body.find("," + local + ","), std::string::npos);
}

TEST_F(Site, SaysWhatOfTheStationFileIsFilledIn) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "station.toml";
  HubRig rig({}, file);
  EXPECT_TRUE(rig.get("/api/v1/site").json()["setup"].is_null());
  const auto expect_setup = [&](const char* text, bool card, bool lens, bool arm) {
    std::ofstream(file) << text;
    const nlohmann::json setup = rig.get("/api/v1/site").json()["setup"];
    EXPECT_EQ(setup, (nlohmann::json{{"card", card}, {"lens", lens}, {"arm", arm}})) << text;
  };
  expect_setup("", false, false, true);
  expect_setup("[arm]\n[card]\n", true, false, false);
  expect_setup("[arm]\n[arm_geometry]\n[lens]\n", false, true, true);
  expect_setup("[lens]\n[second_camera]\n", false, false, true);
  expect_setup("[lens]\n[second_camera]\n[second_lens]\n", false, true, true);
  std::ofstream(file) << "[lens\n";
  EXPECT_TRUE(rig.get("/api/v1/site").json()["setup"].is_null());
}

TEST_F(Site, OfNoTimeZoneDoesNotStart) {
  WebConfig web;
  web.listen = {"127.0.0.1:0"};
  web.time_zone = "Europe/Atlantis";
  const Expected<void> checked = HubWeb::check(web);
  ASSERT_FALSE(checked.ok());
  EXPECT_EQ(checked.failure().find("hub.time_zone: expected"), 0U) << checked.failure();
}

}  // namespace
}  // namespace traygauge::test
