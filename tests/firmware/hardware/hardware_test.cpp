// What follows from a station file for the devices.
#include "firmware/station/hardware.hpp"

#include <gtest/gtest.h>

namespace traygauge {
namespace {

using namespace std::chrono_literals;

TEST(HardwareParams, TheArmHasAsLongAsItsLongestMoveTakes) {
  StationFile station;
  station.arm.emplace();
  auto& stepper = std::get<StepperConfig>(station.arm->kind);
  EXPECT_GE(hardware_params(station).arm_timeout, 12s) << "the usual homing takes as long";
  EXPECT_LE(hardware_params(station).arm_timeout, 30s);
  stepper.motion.homing_speed_deg_per_s = 1.0;
  EXPECT_GE(hardware_params(station).arm_timeout, 60s);
  SerialArmParams serial;
  serial.longest_move = 75s;
  station.arm->kind = serial;
  EXPECT_EQ(hardware_params(station).arm_timeout, 75s);
}

}  // namespace
}  // namespace traygauge
