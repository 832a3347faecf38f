// A station of simulated devices with a measurer and a sink that write down what they are asked.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "firmware/station/station.hpp"
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

// Its one item's volume is ten times the first view's grey plus the second's.
class FakeMeasurer final : public Measurer {
 public:
  void begin_scan() override {
    grays_.clear();
    views.clear();
    ++scans;
  }
  Status add_view(const StationView& view) override {
    views.push_back(view);
    grays_.push_back(view.frame.data[0]);
    arm_was_moving = on_view ? on_view() : false;
    arm_moving_at.push_back(arm_was_moving);
    return views.size() == 1 ? first_view_status : Status();
  }
  const Measurement& measure() override {
    if (on_measure) on_measure();
    measurement_ = {};
    measurement_.status = first_view_status.ok() ? status : first_view_status;
    if (grays_.size() == 2) item_.volume_ml = 10.0 * grays_[0] + grays_[1];
    if (measurement_.status.ok() || status.code() == StatusCode::partial) measurement_.items = {&item_, 1};
    return measurement_;
  }
  std::string_view tray_name() const override { return "tray"; }

  Status first_view_status;
  Status status;
  std::function<bool()> on_view;
  std::function<void()> on_measure;
  std::vector<StationView> views;
  std::vector<bool> arm_moving_at;
  bool arm_was_moving = false;
  int scans = 0;

 private:
  std::vector<double> grays_;
  ItemResult item_;
  Measurement measurement_;
};

// One line for each call, in order.
class RecordingSink final : public ResultSink {
 public:
  bool deliver(const ScanResult& result) override {
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
    return accepts;
  }
  void report_fault(const DeviceFailure& failure) override {
    lines.push_back(std::string("fault ").append(text(failure)));
  }
  void report_recovery(std::string_view what) override {
    lines.push_back(std::string("recovery ").append(what));
  }

  bool accepts = true;
  std::vector<std::string> lines;
  std::vector<Nanoseconds> durations;

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
    measurer.on_view = [this] { return arm.is_homed() && arm_speed() > 0.0; };
    devices.emplace(StationDevices{camera, trigger, has_arm ? &arm : nullptr, lamp, clock});
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
