#include "firmware/check/drift_check.hpp"

#include <gtest/gtest.h>

#include "firmware/handover/told_drift.hpp"
#include "tests/firmware/handover/fake_hub.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

class DriftCheck : public testing::Test {
 protected:
  CheckResult check(const std::vector<ToldTrend>& told) {
    const FakeHub hub(folder_.path() / "hub", [&told](const Message&) -> std::vector<Message> {
      return {{MessageType::drift, told_drift_json(told), {}}};
    });
    return check();
  }
  CheckResult check() {
    HandoverConfig handover;
    handover.name = "kitchen";
    handover.socket = folder_.path() / "hub";
    return check_drift(handover);
  }

  TemporaryFolder folder_;
};

TEST_F(DriftCheck, TellsTheMedians) {
  const CheckResult result =
      check({{"scale_percent", 0.021, 0.049, 50, ""}, {"blur_px", 0.875, 0.01, 48, ""}});
  EXPECT_TRUE(result.is_good);
  EXPECT_EQ(result.device, "drift of kitchen");
  EXPECT_EQ(result.text, "scale_percent 0.02 ± 0.05 over 50 trays, blur_px 0.88 ± 0.01 over 48 trays");
}

TEST_F(DriftCheck, FailsWithWhatTheHubSaysOfADrift) {
  const CheckResult result = check({{"scale_percent", 0.42, 0.05, 50, "The card is worn."},
                                    {"dish_height_mm", 0.0, 0.05, 50, ""},
                                    {"blur_px", 1.5, 0.01, 50, "The lens was moved."}});
  EXPECT_FALSE(result.is_good);
  EXPECT_EQ(result.text, "The card is worn. The lens was moved.");
}

TEST_F(DriftCheck, WithoutAHubNothingIsKnownAndNothingFails) {
  const CheckResult result = check();
  EXPECT_TRUE(result.is_good);
  EXPECT_TRUE(result.text.starts_with("not known, because no hub answers (")) << result.text;
  EXPECT_NE(result.text.find("nobody answers there"), std::string::npos) << result.text;
}

TEST_F(DriftCheck, AStationWithoutTraysHasNoDrift) {
  const CheckResult result = check({});
  EXPECT_TRUE(result.is_good);
  EXPECT_EQ(result.text, "not known, because the hub has stored no tray that says it");
}

}  // namespace
}  // namespace traygauge::test
