// What follows from a station file for the devices.
#include "firmware/station/hardware.hpp"

#include <gtest/gtest.h>

#include <sstream>

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

// The camera is absent here; what the file alone tells is told all the same.
TEST(ChangedLenses, AreWarnedOfAtTheStart) {
  StationFile station;
  station.camera.device = "serial:none-such";
  station.lens.emplace();
  station.lens->camera.size = {1600, 1200};
  const auto warnings = [&station] {
    Hardware hardware(station);
    std::ostringstream log;
    warn_of_changed_lenses(station, hardware, log);
    return log.str();
  };
  EXPECT_EQ(warnings(), "");
  station.lens->calibrated_on = "2025-01-31";
  station.lens->changed_on = "2025-02-01";
  EXPECT_EQ(warnings(),
            "Warning: camera serial:none-such: The lens was changed on 2025-02-01 and calibrated before, on "
            "2025-01-31; calibrate the lens again (traygauge calibrate lens).\n");
  station.lens.reset();
  EXPECT_EQ(warnings(), "");
}

}  // namespace
}  // namespace traygauge
