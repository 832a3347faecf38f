// What feeds the watchdog: a station that hangs anywhere notes no progress, and one that works does so often
// enough, also while its devices fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <semaphore>
#include <thread>
#include <utility>

#include "tests/firmware/station/station_rig.hpp"
#include "tests/simulator/devices/random_faults.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

// WatchdogSec= of config/systemd/traygauge-station.service.
constexpr Nanoseconds kWatchdog = 60s;

void hang_once(std::binary_semaphore& reached, std::binary_semaphore& released, bool& has_hung) {
  if (std::exchange(has_hung, true)) return;
  reached.release();
  released.acquire();
}

enum class Place : std::uint8_t { before_a_press, taking_a_view, measuring, handing_over };

class HangingStation : public ::testing::TestWithParam<Place> {};

TEST_P(HangingStation, NotesNoProgressUntilItGetsOn) {
  StationRig rig(2);
  std::binary_semaphore reached(0);
  std::binary_semaphore released(0);
  bool has_hung = false;
  const auto hang = [&] { hang_once(reached, released, has_hung); };
  if (GetParam() == Place::before_a_press) rig.sink.on_attend = hang;
  if (GetParam() == Place::taking_a_view) {
    rig.measurer.on_view = [&hang] {
      hang();
      return false;
    };
  }
  if (GetParam() == Place::measuring) rig.measurer.on_measure = hang;
  if (GetParam() == Place::handing_over) rig.sink.on_delivery = hang;

  std::atomic<int> notes = 0;
  rig.station.emplace(*rig.devices, rig.measurer, rig.sink, rig.stop, rig.params);
  auto run =
      std::async(std::launch::async, [&] { return rig.station->run([&notes] { ++notes; }).all_worked(); });
  reached.acquire();
  const int before = notes;
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(notes, before);
  released.release();
  EXPECT_TRUE(run.get());
  EXPECT_GT(notes, before);
}

INSTANTIATE_TEST_SUITE_P(Everywhere, HangingStation,
                         ::testing::Values(Place::before_a_press, Place::taking_a_view, Place::measuring,
                                           Place::handing_over));

// By the station's clock, which is right here; devices that hang do so for as long as their drivers let them.
Nanoseconds longest_without_progress(const std::string& script) {
  StationRig rig(20);
  if (!script.empty()) rig.apply(read_fault_file(FaultFile(script).path()));
  rig.params.max_retries = 50;
  rig.station.emplace(*rig.devices, rig.measurer, rig.sink, rig.stop, rig.params);
  Instant last = rig.clock.now();
  Nanoseconds longest{0};
  rig.station->run([&] {
    longest = std::max(longest, rig.clock.now() - last);
    last = rig.clock.now();
  });
  return longest;
}

TEST(StationProgress, IsNotedWellWithinTheWatchdogsTime) {
  EXPECT_LE(longest_without_progress({}), kWatchdog / 4);
  using enum SimulatedDevice;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const std::string script = random_fault_script(seed, {camera, button, arm, lamp});
    EXPECT_LE(longest_without_progress(script), kWatchdog / 2) << "seed " << seed << '\n' << script;
  }
}

}  // namespace
}  // namespace traygauge
