// Pictures for calibrating: one a press, with every pixel that was seen.
#include "firmware/record/picture_recorder.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "simulator/capture/picture_file.hpp"
#include "simulator/devices/simulated_camera.hpp"
#include "simulator/devices/simulated_clock.hpp"
#include "simulator/devices/simulated_indicator.hpp"
#include "simulator/devices/simulated_trigger.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"
#include "tests/simulator/devices/synthetic_captures.hpp"

namespace traygauge {
namespace {

struct Bench {
  Bench() {
    trigger.before_press([this] { player.handle_press(); });
  }
  bool record(std::uint64_t count) {
    return record_pictures(camera, trigger, lamp, {folder.path() / "out", count}, stop, out, log);
  }
  TemporaryFolder folder;
  SimulatedClock clock;
  SyntheticCaptures captures{std::vector<SyntheticCapture>(2, SyntheticCapture{32, 16})};
  TrayPlayer player{captures};
  SimulatedCamera camera{clock, player, nullptr};
  SimulatedIndicator lamp{clock};
  SimulatedTrigger trigger{clock, lamp, 9};
  std::atomic<bool> stop = false;
  std::ostringstream out;
  std::ostringstream log;
};

TEST(PictureRecorder, SavesAPictureForEachPress) {
  Bench bench;
  EXPECT_TRUE(bench.record(2)) << bench.log.str();
  EXPECT_TRUE(bench.record(1));  // goes on where it ended
  for (std::size_t i = 0; i < 2; ++i) {
    const auto file = bench.folder.path() / "out" / ("000" + std::to_string(i + 1) + ".png");
    const Picture picture = read_picture({file, ""}, PictureSize{32, 16});
    EXPECT_EQ(picture.pixels.front(), SyntheticCaptures::gray_of(i, 0));
  }
  EXPECT_TRUE(std::filesystem::exists(bench.folder.path() / "out" / "0003.png"));
  EXPECT_FALSE(bench.camera.is_started());
}

TEST(PictureRecorder, SaysWhichDeviceFails) {
  Bench bench;
  bench.camera.faults().add({DeviceCode::device_gone, 1, 1});
  EXPECT_FALSE(bench.record(2));
  EXPECT_TRUE(bench.log.str().starts_with("simulated camera: The device has disappeared")) << bench.log.str();
}

}  // namespace
}  // namespace traygauge
