#include "simulator/devices/fault_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "simulator/capture/input_error.hpp"
#include "tests/simulator/devices/random_faults.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

FaultPlan read(const std::string& text) {
  return read_fault_file(FaultFile(text).path());
}

TEST(FaultFile, SaysWhatWhenAndHowOften) {
  const FaultPlan plan = read(R"(
seed = 7
[[fault]]
device = "camera"
what = "late"
by_ms = 2500
after_calls = 3
times = 2
[[fault]]
device = "arm"
what = "wrong_angle"
by_deg = -2.5
after_s = 12.5
times = "forever"
[[fault]]
device = "camera"
what = "garbage"
share = 0.25
)");
  EXPECT_EQ(plan.seed, 7U);
  ASSERT_EQ(plan.of(SimulatedDevice::camera).size(), 2U);
  const Fault& late = plan.of(SimulatedDevice::camera)[0];
  EXPECT_EQ(late.action.kind, FaultKind::late);
  EXPECT_EQ(late.action.delay(), 2500ms);
  EXPECT_EQ(late.after_calls, 3);
  EXPECT_EQ(late.times, 2);
  const Fault& garbage = plan.of(SimulatedDevice::camera)[1];
  EXPECT_EQ(garbage.share, 0.25);
  EXPECT_EQ(garbage.times, Fault::kForever);
  ASSERT_EQ(plan.of(SimulatedDevice::arm).size(), 1U);
  const Fault& angle = plan.of(SimulatedDevice::arm)[0];
  EXPECT_EQ(angle.action.amount, -2.5);
  EXPECT_EQ(angle.after_time, 12500ms);
  EXPECT_EQ(angle.times, Fault::kForever);
  EXPECT_TRUE(plan.of(SimulatedDevice::lamp).empty());
}

TEST(FaultFile, EveryDevicePlaysItsKindsAndNoOther) {
  for (const SimulatedDevice device : all_simulated_devices()) {
    const auto own = kinds_of(device);
    for (std::size_t i = 0; i < kFaultKindCount; ++i) {
      const auto kind = static_cast<FaultKind>(i);
      const std::string text = fault_text(device, kind, usual_amount(kind));
      if (std::find(own.begin(), own.end(), kind) != own.end()) {
        EXPECT_EQ(read(text).of(device).front().action.kind, kind) << text;
      } else {
        EXPECT_THROW(read(text), InputError) << text;
      }
    }
  }
}

TEST(FaultFile, NamesTheKeyThatIsWrongAndWhatWasExpected) {
  struct Case {
    const char* text;
    const char* key;
    const char* expected;
  };
  const Case cases[] = {
      {"", "fault", "this key"},
      {"fault = []", "fault", "an array of 1 to 1000"},
      {"faults = 1", "faults", "one of seed, fault"},
      {"seed = -1\n[[fault]]", "seed", "a whole number from 0"},
      {"[[fault]]\nwhat = \"off\"", "fault[0].device", "this key"},
      {"[[fault]]\ndevice = \"mixer\"", "fault[0].device", "one of camera, button, arm, lamp, clock"},
      {"[[fault]]\ndevice = \"lamp\"", "fault[0].what", "this key"},
      {"[[fault]]\ndevice = \"lamp\"\nwhat = \"torn\"", "fault[0].what", "one of off, stuck"},
      {"[[fault]]\ndevice = \"lamp\"\nwhat = 3", "fault[0].what", "a text"},
      {"[[fault]]\ndevice = \"arm\"\nwhat = \"slow\"", "fault[0].factor", "this key"},
      {"[[fault]]\ndevice = \"arm\"\nwhat = \"slow\"\nfactor = 0.5", "fault[0].factor", "a number from 1"},
      {"[[fault]]\ndevice = \"button\"\nwhat = \"bounce\"\nedges = 2.5", "fault[0].edges", "a whole number"},
      {"[[fault]]\ndevice = \"lamp\"\nwhat = \"off\"\nby_ms = 5", "fault[0].by_ms", "one of device, what"},
      {"[[fault]]\ndevice = \"lamp\"\nwhat = \"off\"\ntime = 5", "fault[0].time", "one of device, what"},
      {"[[fault]]\ndevice = \"lamp\"\nwhat = \"off\"\ntimes = 0", "fault[0].times", "a whole number from 1"},
      {"[[fault]]\ndevice = \"lamp\"\nwhat = \"off\"\ntimes = \"often\"", "fault[0].times", "\"forever\""},
      {"[[fault]]\ndevice = \"lamp\"\nwhat = \"off\"\nshare = 0", "fault[0].share", "a number above 0"},
      {"[[fault]]\ndevice = \"lamp\"\nwhat = \"off\"\nafter_s = nan", "fault[0].after_s", "a number from 0"},
      {"[[fault]]\ndevice = \"lamp\"\nwhat = \"off\"\nafter_s = 1\nafter_calls = 1", "fault[0].after_s",
       "either after_calls or after_s"},
      {"[[fault]", "", "a fault script in TOML"},
  };
  for (const Case& wrong : cases) {
    try {
      read(wrong.text);
      ADD_FAILURE() << "was read: " << wrong.text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.problem().key, wrong.key) << wrong.text;
      EXPECT_NE(error.problem().expected.find(wrong.expected), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(read_fault_file("/nowhere/faults.toml"), InputError);
}

}  // namespace
}  // namespace traygauge
