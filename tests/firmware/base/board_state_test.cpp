#include "firmware/base/board_state.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace traygauge {
namespace {

class BoardStateOf : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) {
    const std::filesystem::path path = folder_.path() / file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text << "\n";
  }
  BoardState read() const { return read_board_state(folder_.path()); }

  TemporaryFolder folder_;
};

TEST_F(BoardStateOf, ABoardThatTellsNothingHasNone) {
  EXPECT_FALSE(read().temperature_c);
  EXPECT_FALSE(read().under_voltage);
  write("thermal/cooling_device0/type", "fan");
  write("hwmon/hwmon0/name", "nvme");
  EXPECT_FALSE(read().temperature_c);
  EXPECT_FALSE(read().under_voltage);
}

TEST_F(BoardStateOf, TellsTheHottestPart) {
  write("thermal/thermal_zone0/temp", "51234");
  EXPECT_DOUBLE_EQ(read().temperature_c.value_or(0.0), 51.234);
  write("thermal/thermal_zone1/temp", "67000");
  write("thermal/thermal_zone2/temp", "broken");
  write("thermal/thermal_zone3/temp", "4294967295");
  EXPECT_DOUBLE_EQ(read().temperature_c.value_or(0.0), 67.0);
}

TEST_F(BoardStateOf, TellsWhetherTheVoltageWasTooLow) {
  write("hwmon/hwmon0/name", "cpu_thermal");
  write("hwmon/hwmon1/name", "rpi_volt");
  EXPECT_FALSE(read().under_voltage);
  write("hwmon/hwmon1/in0_lcrit_alarm", "0");
  EXPECT_EQ(read().under_voltage, false);
  write("hwmon/hwmon1/in0_lcrit_alarm", "1");
  EXPECT_EQ(read().under_voltage, true);
}

}  // namespace
}  // namespace traygauge
