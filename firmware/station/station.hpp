// The station's loop: a press, two views, a measurement, a result. Every failure leaves it in one of these
// states and is told once.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivers/arm.hpp"
#include "drivers/camera.hpp"
#include "drivers/clock.hpp"
#include "drivers/indicator.hpp"
#include "drivers/trigger.hpp"
#include "firmware/station/block_means.hpp"
#include "firmware/station/measurer.hpp"
#include "firmware/station/scan_result.hpp"
#include "firmware/station/station_state.hpp"

namespace traygauge {

struct StationDevices {
  Camera& camera;
  Trigger& trigger;
  Arm* arm;  // null: a hand moves the camera or the tray, and a second press takes the second view
  Indicator& lamp;
  Clock& clock;
  Camera* second_camera = nullptr;  // takes the second view; then there is no arm, and one press suffices
};

// As faults name them.
std::vector<std::string> device_names(const StationDevices& devices);

// What spoils one scan and leaves the camera usable; anything else needs the device to be opened again.
bool spoils_one_scan(DeviceCode code);

// What the lamp says while a hand moves the camera or the tray to the second view.
struct HandGuideParams {
  // Between the lines of sight: outside of 15 to 25 degrees error and time rise (paper, Table V and its
  // text).
  double enough_from_deg = 15.0;
  double enough_to_deg = 25.0;
  Nanoseconds interval = std::chrono::milliseconds(100);  // between two looks; a hand is no faster
};

struct StationParams {
  double second_view_deg = 18.0;    // paper, Table V: error and time are least at 15 to 20
  double seen_per_commanded = 1.0;  // of the arm's angles, as calibrated
  Nanoseconds capture_timeout = std::chrono::seconds(2);  // longer than any exposure; shorter hides no hang
  int capture_attempts = 6;  // 2 to 20: more than a camera queues old frames; two are needed
  SteadinessParams steadiness;
  // Daylight changes: older exposures settle again at the next press, with its tray in view.
  Nanoseconds exposure_good_for = std::chrono::minutes(10);
  Nanoseconds arm_timeout = std::chrono::seconds(10);  // longer than its longest move; hardware_params knows
  Nanoseconds second_press_timeout = std::chrono::seconds(60);
  // A worn contact bounces for up to 100 ms, when it is released too; nobody presses twice so fast.
  Nanoseconds bounce_time = std::chrono::milliseconds(300);
  // A press counts once the button is open again: what is held for so long cancels the scan that waits for
  // its second view, or opens all devices anew and sends the arm home. Zero: nothing does.
  Nanoseconds long_press = std::chrono::seconds(2);
  HandGuideParams guide;
  Nanoseconds result_shown = std::chrono::seconds(3);  // then the lamp says ready again
  // Whoever presses again for a tray that has not been touched since its result wants that one measured
  // again, not two trays booked. Zero: every press counts.
  Nanoseconds repeat_within = std::chrono::seconds(20);
  // Whether a press during the measurement takes the next tray; the measurer then works in the background,
  // and a third picture has its memory.
  bool takes_next_tray_early = false;
  Nanoseconds next_tray_wait = std::chrono::milliseconds(20);  // between two looks for that press
  Nanoseconds press_wait = std::chrono::milliseconds(500);     // between two looks at the wish to stop
  Nanoseconds first_retry = std::chrono::milliseconds(100);    // of a failed device; doubles up to last_retry
  Nanoseconds last_retry = std::chrono::seconds(5);
  std::uint64_t max_scans = 0;  // then the loop ends; 0: never
  int max_retries = 0;          // of failed devices in a row, then the loop ends; 0: never
};

struct StationTotals {
  std::uint64_t scans = 0;
  std::uint64_t measured = 0;
  std::uint64_t kept = 0;  // of the measured ones: not yet where they belong when they were shown
  std::uint64_t undelivered = 0;
  bool gave_up = false;  // a device did not come back

  bool all_worked() const { return measured == scans && undelivered == 0 && !gave_up; }
};

class Station {
 public:
  // All outlive the station. Somebody else sets `stop`, a signal handler say; the loop ends before the next
  // scan.
  Station(const StationDevices& devices, Measurer& measurer, ResultSink& sink, const std::atomic<bool>& stop,
          const StationParams& params = {});

  // Blocks until the loop ends; the devices are closed then. Calls `after_step` after each state's work.
  const StationTotals& run(const std::function<void()>& after_step = {});
  // One state's work; the state that follows.
  StationState step();
  StationState state() const { return state_; }
  const StationTotals& totals() const { return totals_; }

 private:
  struct View {
    std::vector<std::uint8_t> pixels;  // sized when the camera starts
    CapturedFrame frame;
  };
  struct Opening {
    Device* failed = nullptr;
    DeviceStatus status;
  };

  StationState start_devices();
  StationState wait_for_press();
  StationState refuse_press();
  StationState take_first_view();
  void recognise_tray();
  bool shows_last_tray() const;
  StationState await_second_view();
  StationState await_second_press();
  DeviceStatus guide_hand();
  StationState cancel_scan(bool was_held);
  DeviceStatus wait_for_press(Nanoseconds timeout, Press& press);
  DeviceStatus wait_for_release(bool& was_held);
  StationState restart_devices();
  StationState take_second_view();
  StationState measure();
  StationState repeat_scan(DeviceStatus returning);
  StationState begin_scan(const Press& press);

  const Measurement& await_measurement();
  void look_for_next_tray();
  void take_next_view();
  StationState begin_next_scan();
  bool take_over_next_view();

  DeviceStatus capture(Camera& camera, View& view);
  DeviceStatus capture_once(Camera& camera, View& view, Instant not_before) const;
  Camera& second_camera() {
    return devices_.second_camera != nullptr ? *devices_.second_camera : devices_.camera;
  }
  DeviceStatus begin_return();
  StationState finish_return(StationState next, bool arm_is_doubtful);

  StationState end_scan(ScanResult result, Signal signal, StationState next);
  StationState fail_scan(Device& device, DeviceStatus status);

  Opening open_all();
  Opening refresh_exposure();
  DeviceStatus open_camera(Camera& camera);
  StationState enter_fault(Device& device, DeviceStatus status);
  void remember_failure(Device& device, DeviceStatus status);
  void confirm_recovery();
  void close(const Device& device);
  void close_all();
  void close_views();
  void show(Signal signal);

  StationDevices devices_;
  Measurer& measurer_;
  ResultSink& sink_;
  const std::atomic<bool>& stop_;
  StationParams params_;

  StationState state_ = StationState::starting;
  StationTotals totals_;
  View first_;
  View second_;
  View next_;                        // the next tray's first, taken while the last one is measured
  std::array<BlockMeans, 2> means_;  // of the last two pictures
  BlockMeans first_means_;           // of the first view
  BlockMeans second_means_;
  BlockMeans next_means_;
  BlockMeans last_tray_;  // of the first view that the last result is of
  Instant last_result_at_;
  bool repeats_last_ = false;
  TrayHint hint_;                    // of this scan's tray
  TrayHint last_hint_;               // of the last result's
  Signal guidance_ = Signal::off;    // for the picture that means_[0] is of
  std::optional<Press> next_press_;  // for the next tray, while the last one is measured
  bool is_next_taken_ = false;       // next_ holds its first view
  Instant pressed_at_;
  Instant settled_at_;                   // the cameras' exposure
  bool exposure_is_doubtful_ = false;    // the last pictures were too dark or too bright
  bool is_repeated_ = false;             // this scan, because the arm stood elsewhere than it said
  std::optional<Instant> last_edge_at_;  // of the button
  Instant result_until_;                 // the lamp shows the last result
  Device* failed_device_ = nullptr;      // while it does not work
  DeviceCode failed_code_ = DeviceCode::ok;
  Nanoseconds retry_after_{0};
  int retries_ = 0;
  bool lamp_failed_ = false;
};

}  // namespace traygauge
