#include "drivers/serial/serial_arm.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/drivers/serial/arm_controller.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

class Serial : public testing::Test {
 protected:
  Serial() {
    params_.device = controller_.path();
    params_.reply_timeout = 100ms;
    params_.boot_timeout = 400ms;
    params_.settling_time = 5ms;
  }
  SerialArm& arm() {
    if (!arm_) arm_.emplace(clock_, params_);
    return *arm_;
  }
  void answer_to(const std::string& request, std::optional<std::string> reply) {
    controller_.answer_with([request, reply](const std::string& asked) -> std::optional<std::string> {
      if (asked == request) return reply;
      if (asked == "HELLO") return "TRAYGAUGE-ARM 1 -45 45";
      if (asked == "WHERE") return "AT 0 STILL";
      return "OK";
    });
  }

  SystemClock clock_;
  int asked_ = 0;  // by the controller's thread
  ArmController controller_;
  SerialArmParams params_;
  std::optional<SerialArm> arm_;
};

TEST_F(Serial, LearnsItsLimitsFromTheController) {
  ASSERT_TRUE(arm().start().ok()) << arm().detail();
  EXPECT_EQ(arm().limits().min_deg, -45.0);
  EXPECT_EQ(arm().limits().max_deg, 45.0);
}

TEST_F(Serial, RefusesWhatDoesNotSpeakItsProtocol) {
  for (const auto& [reply, code] :
       {std::pair{"TRAYGAUGE-ARM 2 -45 45", DeviceCode::unsupported},
        std::pair{"TRAYGAUGE-ARM 1 45 -45", DeviceCode::unsupported},
        std::pair{"TRAYGAUGE-ARM 1", DeviceCode::unsupported}, std::pair{"ok ready", DeviceCode::io_error}}) {
    answer_to("HELLO", reply);
    EXPECT_EQ(arm().start().code(), code) << reply;
    EXPECT_EQ(arm().detail(), "asked \"HELLO\", it says \"" + std::string(reply) + "\"");
  }
  answer_to("HELLO", std::nullopt);
  EXPECT_EQ(arm().start().code(), DeviceCode::timed_out);
}

TEST_F(Serial, WaitsForAControllerThatStarts) {
  controller_.answer_with([this](const std::string&) -> std::optional<std::string> {
    if (++asked_ < 3) return asked_ == 1 ? std::optional<std::string>("?!") : std::nullopt;
    return "TRAYGAUGE-ARM 1 -45 45";
  });
  EXPECT_TRUE(arm().start().ok());
}

TEST_F(Serial, ReportsAStallAndALostHome) {
  ASSERT_TRUE(arm().start().ok());
  ASSERT_TRUE(arm().home(5s).ok());
  ASSERT_TRUE(arm().begin_move_to(18.0).ok());
  EXPECT_EQ(arm().begin_move_to(1.0).code(), DeviceCode::busy);
  controller_.stalls = true;
  EXPECT_EQ(arm().wait_until_still(5s).code(), DeviceCode::stalled);
  EXPECT_EQ(arm().detail(), "it says STALLED");
  controller_.stalls = false;
  EXPECT_EQ(arm().begin_move_to(0.0).code(), DeviceCode::not_homed);
  EXPECT_TRUE(arm().home(5s).ok());
}

TEST_F(Serial, AnArmThatStandsStillElsewhereHasStalled) {
  ASSERT_TRUE(arm().start().ok());
  answer_to("WHERE", "AT 0.6 STILL");
  EXPECT_EQ(arm().home(1s).code(), DeviceCode::stalled);
  EXPECT_EQ(arm().detail(), "it stands still at 0.60 degrees, sent to 0.00");
  answer_to("WHERE", "AT 0.4 STILL");
  ASSERT_TRUE(arm().home(1s).ok());
  EXPECT_EQ(arm().move_to(18.0, 1s).code(), DeviceCode::stalled);
  EXPECT_FALSE(arm().is_homed());
}

TEST_F(Serial, ALineThatAnotherProgramHasIsInUse) {
  ASSERT_TRUE(arm().start().ok());
  SerialArm second(clock_, params_);
  EXPECT_EQ(second.start().code(), DeviceCode::in_use);
  arm().stop();
  EXPECT_TRUE(second.start().ok());
}

TEST_F(Serial, ReportsRefusalsInTheControllersWords) {
  answer_to("HOME", "ERROR no power");
  ASSERT_TRUE(arm().start().ok());
  EXPECT_EQ(arm().home(1s).code(), DeviceCode::io_error);
  EXPECT_EQ(arm().detail(), "asked \"HOME\", it says \"ERROR no power\"");
}

TEST_F(Serial, AControllerThatFallsSilentTimesOut) {
  ASSERT_TRUE(arm().start().ok());
  ASSERT_TRUE(arm().home(5s).ok());
  answer_to("WHERE", std::nullopt);
  const Instant asked_at = clock_.now();
  EXPECT_EQ(arm().begin_move_to(3.0).code(), DeviceCode::timed_out);
  EXPECT_LT(clock_.now() - asked_at, 1s);
}

TEST_F(Serial, AnUnpluggedControllerIsGone) {
  ASSERT_TRUE(arm().start().ok());
  ASSERT_TRUE(arm().home(5s).ok());
  controller_.unplug();
  EXPECT_EQ(arm().begin_move_to(3.0).code(), DeviceCode::device_gone);
  arm().stop();
  EXPECT_EQ(arm().start().code(), DeviceCode::device_gone);
}

TEST_F(Serial, SurvivesAnyAnswer) {
  std::mt19937 random(20261122);
  for (int run = 0; run < 60; ++run) {
    std::string noise;
    for (int i = static_cast<int>(random() % 250); i > 0; --i) noise += static_cast<char>(random() % 256);
    answer_to("WHERE", run % 3 == 0 ? "AT nan " + noise : noise);
    arm_.reset();
    params_.reply_timeout = 20ms;
    ASSERT_TRUE(arm().start().ok());
    EXPECT_FALSE(arm().home(30ms).ok()) << run;
  }
}

TEST_F(Serial, KnowsWhatIsNoSerialLine) {
  params_.device = "/dev/null";
  EXPECT_EQ(arm().start().code(), DeviceCode::unsupported);
  arm_.reset();
  params_.device = "/no/such/device";
  EXPECT_EQ(arm().start().code(), DeviceCode::device_gone);
  arm_.reset();
  params_.baud = 31;
  EXPECT_EQ(arm().start().code(), DeviceCode::invalid_argument);
}

}  // namespace
}  // namespace traygauge
