// A station of simulated devices with a measurer and a sink that write down what they are asked.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "firmware/station/station.hpp"
#include "simulator/devices/fault_file.hpp"
#include "simulator/devices/simulated_arm.hpp"
#include "simulator/devices/simulated_camera.hpp"
#include "simulator/devices/simulated_clock.hpp"
#include "simulator/devices/simulated_indicator.hpp"
#include "simulator/devices/simulated_trigger.hpp"
#include "tests/simulator/devices/synthetic_captures.hpp"

namespace traygauge {

inline void PrintTo(Signal signal, std::ostream* out) {
  *out << name(signal);
}

// Its one item's volume is ten times the first view's mean grey plus the second's. It refuses what the real
// measurement refuses: noise, pictures of the wrong size, the same view twice, views of two trays.
class FakeMeasurer final : public Measurer {
 public:
  void begin_scan(const TrayHint& hint) override {
    hints.push_back(hint);
    grays_.clear();
    views.clear();
    view_status_ = {};
    ++scans;
  }
  Status add_view(const StationView& view) override {
    views.push_back(view);
    look_at(view.frame);
    arm_was_moving = on_view ? on_view() : false;
    arm_moving_at.push_back(arm_was_moving);
    return views.size() == 1 && !first_view_status.ok() ? first_view_status : view_status_;
  }
  const Measurement& measure() override {
    if (on_measure) on_measure();
    measurement_ = {};
    measurement_.status = first_view_status.ok() ? status : first_view_status;
    if (measurement_.status.ok()) measurement_.status = judge_views();
    if (grays_.size() == 2) item_.volume_ml = 10.0 * grays_[0] + grays_[1];
    if (measurement_.status.ok() || status.code() == StatusCode::partial) measurement_.items = {&item_, 1};
    measurement_.warnings.raise_if(disagreements > 0, Warning::arm_angle_disagrees);
    if (disagreements > 0) --disagreements;
    return measurement_;
  }
  const Measurement* await_measurement(Nanoseconds timeout) override {
    return still_measures && still_measures(timeout) ? nullptr : &measure();
  }
  bool can_guide() const override { return static_cast<bool>(guide); }
  std::optional<double> turned_deg(const FrameView& live) override { return guide(live); }
  std::string_view tray_name() const override { return "tray"; }

  std::vector<TrayHint> hints;  // of every scan
  std::function<std::optional<double>(const FrameView&)> guide;
  Status first_view_status;
  Status status;
  int disagreements = 0;  // measurements that show another angle than the arm's
  CameraFormat camera_format;
  std::function<bool()> on_view;
  std::function<void()> on_measure;
  std::function<bool(Nanoseconds)>
      still_measures;  // after so much more time; else the result is there at once
  std::vector<StationView> views;
  std::vector<bool> arm_moving_at;
  bool arm_was_moving = false;
  int scans = 0;

 private:
  void look_at(const FrameView& frame) {
    std::set<std::uint8_t> values;
    double sum = 0.0;
    const auto bytes = static_cast<std::size_t>(frame.stride_bytes * frame.height);
    for (std::size_t i = 0; i < bytes; ++i) {
      values.insert(frame.data[i]);
      sum += frame.data[i];
    }
    grays_.push_back(sum / static_cast<double>(bytes));
    const bool is_whole = frame.width == camera_format.width && frame.height == camera_format.height;
    if (!is_whole) view_status_ = StatusCode::frame_size_mismatch;
    if (values.size() > 2) view_status_ = StatusCode::card_not_found;  // two may be rows of two views
  }
  Status judge_views() const {
    if (!view_status_.ok() || grays_.size() < 2) return view_status_;
    if (grays_[0] == grays_[1]) return StatusCode::views_identical;
    const bool are_whole = grays_[0] == std::floor(grays_[0]) && grays_[1] == std::floor(grays_[1]);
    const bool are_of_one_tray = std::fmod(grays_[1] - grays_[0] + 256.0, 256.0) == 100.0;
    return are_whole && !are_of_one_tray ? StatusCode::too_few_matches : StatusCode::ok;
  }

  std::vector<double> grays_;
  Status view_status_;
  ItemResult item_;
  Measurement measurement_;
};

// One line for each call, in order.
class RecordingSink final : public ResultSink {
 public:
  Delivery deliver(const ScanResult& result) override {
    const char* const outcomes[] = {"measured", "not_measurable", "device_failed", "cancelled"};
    std::string line = std::to_string(result.scan);
    line += std::string(" ").append(outcomes[static_cast<int>(result.outcome)]);
    if (result.measurement != nullptr)
      line += std::string(" ").append(name(result.measurement->status.code()));
    if (result.measurement != nullptr && !result.measurement->items.empty()) {
      line.append(" ").append(std::to_string(static_cast<int>(result.measurement->items[0].volume_ml)));
    }
    if (!result.failure.device.empty()) line.append(" ").append(text(result.failure));
    lines.push_back(line);
    durations.push_back(result.duration);
    if (on_delivery) on_delivery();
    repeats.push_back(result.repeats_last);
    trays.emplace_back(result.tray);
    return delivery;
  }
  void report_fault(const DeviceFailure& failure) override {
    lines.push_back(std::string("fault ").append(text(failure)));
  }
  void report_restart() override { lines.emplace_back("restart"); }
  void report_recovery(std::string_view what) override {
    lines.push_back(std::string("recovery ").append(what));
  }

  TrayHint next_tray() override { return hint; }
  bool has_room() override { return room; }
  void attend() override {
    if (on_attend) on_attend();
  }

  TrayHint hint;  // of every tray
  Delivery delivery = Delivery::done;
  bool room = true;
  std::function<void()> on_delivery;
  std::function<void()> on_attend;
  std::vector<std::string> lines;
  std::vector<Nanoseconds> durations;
  std::vector<bool> repeats;
  std::vector<std::string> trays;

 private:
  static std::string text(const DeviceFailure& failure) {
    return std::string(failure.device).append(" ").append(name(failure.status.code()));
  }
};

struct StationRig {
  explicit StationRig(std::size_t trays, bool has_arm = true)
      : StationRig(std::vector<SyntheticCapture>(trays), has_arm) {}
  explicit StationRig(std::vector<SyntheticCapture> trays, bool has_arm = true)
      : captures(std::move(trays)),
        player(captures, has_arm ? CameraMover::arm : CameraMover::hand),
        arm(clock, &player),
        camera(clock, player, has_arm ? &arm : nullptr),
        lamp(clock),
        trigger(clock, lamp, (has_arm ? 1 : 2) * captures.capture_count()) {
    trigger.before_press([this] { player.handle_press(); });
    lamp.on_signal([this](Signal signal) { player.handle_signal(signal); });
    measurer.camera_format = captures.largest_frame();
    measurer.on_view = [this] { return arm.is_homed() && arm_speed() > 0.0; };
    devices.emplace(StationDevices{camera, trigger, has_arm ? &arm : nullptr, lamp, clock});
  }

  void apply(const FaultPlan& plan) {
    plan.apply(SimulatedDevice::camera, camera.faults());
    plan.apply(SimulatedDevice::button, trigger.faults());
    plan.apply(SimulatedDevice::arm, arm.faults());
    plan.apply(SimulatedDevice::lamp, lamp.faults());
    plan.apply(SimulatedDevice::clock, clock.faults());
  }
  // Its measurement says so; the others' are as they come.
  void refuse_first_scan(StatusCode code) {
    measurer.on_measure = [this, code] { measurer.status = measurer.scans == 1 ? code : StatusCode::ok; };
  }
  bool faults_are_over() {
    return camera.faults().empty() && trigger.faults().empty() && arm.faults().empty() &&
           lamp.faults().empty() && clock.faults().empty();
  }
  const StationTotals& run() {
    station.emplace(*devices, measurer, sink, stop, params);
    return station->run();
  }
  // Degrees in the next millisecond, which passes.
  double arm_speed() {
    const double before_deg = arm.true_position_deg();
    clock.advance(std::chrono::milliseconds(1));
    return std::abs(arm.true_position_deg() - before_deg);
  }
  std::vector<Signal> signals() const {
    std::vector<Signal> signals;
    for (const ShownSignal& shown : lamp.history()) signals.push_back(shown.signal);
    return signals;
  }

  SimulatedClock clock;
  SyntheticCaptures captures;
  TrayPlayer player;
  SimulatedArm arm;
  SimulatedCamera camera;
  SimulatedIndicator lamp;
  SimulatedTrigger trigger;
  FakeMeasurer measurer;
  RecordingSink sink;
  StationParams params;
  std::atomic<bool> stop = false;
  std::optional<StationDevices> devices;
  std::optional<Station> station;
};

}  // namespace traygauge
