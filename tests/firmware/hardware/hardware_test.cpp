// What follows from a station file for the devices.
#include "firmware/station/hardware.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

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

TEST(Calibration, IsAsGoodAsItsWorseLens) {
  StationFile station;
  EXPECT_FALSE(calibration_facts(station));
  station.lens.emplace();
  EXPECT_FALSE(calibration_facts(station)) << "the lens has no grade";
  station.lens->grade_percent = 0.31;
  station.lens->calibrated_on = "2025-02-01";
  ASSERT_TRUE(calibration_facts(station));
  EXPECT_EQ(calibration_facts(station)->grade_percent, 0.31);
  station.second_lens.emplace();
  station.second_lens->grade_percent = 0.42;
  station.second_lens->calibrated_on = "2025-01-31";
  EXPECT_EQ(calibration_facts(station)->grade_percent, 0.42);
  EXPECT_EQ(calibration_facts(station)->calibrated_on, "2025-01-31");
}

TEST(Calibration, DevicesAreNamedAsFaultsNameThem) {
  StationFile station;
  station.camera.device = "serial:A2";
  station.button.line.line = "TRIGGER";
  Hardware hardware(station);
  EXPECT_EQ(device_names(hardware.devices()),
            (std::vector<std::string>{"camera serial:A2", "button TRIGGER", "lamp"}));
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
