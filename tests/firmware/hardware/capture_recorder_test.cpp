// A simulated station that records: what it saves is what it saw.
#include "firmware/record/capture_recorder.hpp"

#include <gtest/gtest.h>

#include "firmware/station/recorded_captures.hpp"
#include "firmware/station/station.hpp"
#include "simulator/capture/output_file.hpp"
#include "simulator/devices/simulated_arm.hpp"
#include "simulator/devices/simulated_camera.hpp"
#include "simulator/devices/simulated_clock.hpp"
#include "simulator/devices/simulated_indicator.hpp"
#include "simulator/devices/simulated_trigger.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

class Names final : public ResultSink {
 public:
  Delivery deliver(const ScanResult& result) override {
    names.emplace_back(result.outcome == ScanOutcome::measured ? result.tray : "not saved");
    return Delivery::done;
  }
  void report_fault(const DeviceFailure&) override {}
  void report_restart() override {}
  void report_recovery(std::string_view) override {}
  std::vector<std::string> names;
};

class Recording : public testing::Test {
 protected:
  void record(int scans) {
    RecordedCaptures captures({demo_});
    SimulatedClock clock;
    TrayPlayer player(captures);
    SimulatedArm arm(clock, &player);
    SimulatedCamera camera(clock, player, &arm);
    SimulatedIndicator lamp(clock);
    SimulatedTrigger trigger(clock, lamp, static_cast<std::uint64_t>(scans));
    trigger.before_press([&player] { player.handle_press(); });
    const Capture source = read_capture(demo_);
    CaptureRecorder recorder(folder_.path() / "out", {source.views[0].camera, source.views[1].camera},
                             source.card);
    std::atomic<bool> stop = false;
    StationParams params;
    params.max_scans = static_cast<std::uint64_t>(scans);
    Station({camera, trigger, &arm, lamp, clock}, recorder, sink_, stop, params).run();
  }
  fs::path demo_ = fs::path(TRAYGAUGE_SOURCE_DIR) / "simulator/demo/mash_and_meatballs";
  TemporaryFolder folder_;
  Names sink_;
};

TEST_F(Recording, SavesCapturesWithEveryPixelThatItSaw) {
  record(1);
  ASSERT_EQ(sink_.names, std::vector<std::string>{"0001"});
  const Capture source = read_capture(demo_);
  const Capture saved = read_capture(folder_.path() / "out" / "0001");
  ASSERT_EQ(saved.views.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(load_view(saved.views[i]).picture.pixels, load_view(source.views[i]).picture.pixels) << i;
    EXPECT_NEAR(saved.views[i].arm_angle_deg.value(), source.views[i].arm_angle_deg.value(), 1e-9);
    EXPECT_EQ(saved.views[i].camera.fx_px, source.views[i].camera.fx_px);
    EXPECT_EQ(saved.views[i].camera.distortion, source.views[i].camera.distortion);
  }
  EXPECT_EQ(load_pattern(saved.card).pixels, load_pattern(source.card).pixels);
  EXPECT_EQ(saved.card.thickness_mm, source.card.thickness_mm);
}

TEST_F(Recording, LeavesNumbersOutThatAreTaken) {
  fs::create_directories(folder_.path() / "out" / "0001");
  fs::create_directories(folder_.path() / "out" / "0002");
  const Capture source = read_capture(demo_);
  CaptureRecorder recorder(folder_.path() / "out", {source.views[0].camera, source.views[1].camera},
                           source.card);
  recorder.begin_scan({});
  EXPECT_EQ(recorder.tray_name(), "0003");
  recorder.begin_scan({});
  EXPECT_EQ(recorder.tray_name(), "0004");
}

TEST_F(Recording, SaysThatItCouldNotSave) {
  write_text(folder_.path() / "file", "");
  const Capture source = read_capture(demo_);
  EXPECT_THROW(
      CaptureRecorder(folder_.path() / "file", {source.views[0].camera, source.views[1].camera}, source.card),
      OutputError);

  CaptureRecorder recorder(folder_.path() / "out", {source.views[0].camera, source.views[1].camera},
                           source.card);
  const LoadedView view = load_view(source.views[0]);
  recorder.begin_scan({});
  fs::remove_all(folder_.path() / "out");
  write_text(folder_.path() / "out", "in the way");
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(recorder.add_view({view.picture.frame(), 1, std::nullopt}).ok());
  }
  EXPECT_FALSE(recorder.measure().status.ok());
  EXPECT_FALSE(recorder.problem().empty());
}

TEST_F(Recording, RefusesPicturesOfAnotherSize) {
  const Capture source = read_capture(demo_);
  CaptureRecorder recorder(folder_.path() / "out", {source.views[0].camera, source.views[1].camera},
                           source.card);
  recorder.begin_scan({});
  const Picture small({32, 32}, PixelFormat::rgb8);
  EXPECT_EQ(recorder.add_view({small.frame(), 1, std::nullopt}).code(), StatusCode::frame_size_mismatch);
  EXPECT_FALSE(recorder.measure().status.ok());
}

}  // namespace
}  // namespace traygauge
