// The mechanics behind a stepper's lines: where the arm really is, and the switch that it closes.
#pragma once

#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <utility>

#include "drivers/gpio/gpio_line.hpp"
#include "drivers/gpio/stepper_arm.hpp"
#include "tests/drivers/gpio_bench.hpp"

namespace traygauge {

// Passes everything on, and tells what is written.
class WatchedLine final : public GpioLine {
 public:
  WatchedLine(std::unique_ptr<GpioLine> line, std::function<void(bool)> on_write)
      : line_(std::move(line)), on_write_(std::move(on_write)) {}

  DeviceStatus open_input() override { return line_->open_input(); }
  DeviceStatus open_edges() override { return line_->open_edges(); }
  DeviceStatus open_output(bool active) override { return line_->open_output(active); }
  void close() override { line_->close(); }
  DeviceStatus read(bool& is_active) override { return line_->read(is_active); }
  DeviceStatus write(bool active) override {
    const DeviceStatus status = line_->write(active);
    if (status.ok()) on_write_(active);
    return status;
  }
  DeviceStatus wait_for_edge(Nanoseconds timeout, GpioEdge& edge) override {
    return line_->wait_for_edge(timeout, edge);
  }
  std::string problem() const override { return line_->problem(); }

 private:
  std::unique_ptr<GpioLine> line_;
  std::function<void(bool)> on_write_;
};

// Its state is read by the test while the arm's thread writes steps. As real ones do, the switch opens a
// little further out than it closes, and each time a hair's breadth elsewhere.
class ArmPlant {
 public:
  static constexpr double kCloses_deg = 1.0;  // coming home; half the usual overlap
  static constexpr double kHysteresis_deg = 0.3;
  static constexpr double kJitter_deg = 0.1;  // either way

  // Quick, so that tests are: 18 degrees in a fifth of a second.
  static StepperArmParams params() {
    StepperArmParams params;
    params.steps_per_deg = 10.0;
    params.limits = {0.0, 45.0};
    params.speed_deg_per_s = 300.0;
    params.acceleration_deg_per_s2 = 3000.0;
    params.homing_speed_deg_per_s = 100.0;
    params.settling_time = std::chrono::milliseconds(20);
    return params;
  }

  explicit ArmPlant(GpioBench& bench, double at_deg = 12.0)
      : bench_(bench), steps_(steps_at(at_deg)), is_closed_(at_deg <= kCloses_deg) {
    bench_.set_input("HOME", is_closed_);
  }

  StepperLines lines() {
    StepperLines lines;
    lines.step = std::make_unique<WatchedLine>(bench_.make_line("STEP"), [this](bool high) {
      if (high) step();
    });
    lines.direction =
        std::make_unique<WatchedLine>(bench_.make_line("DIR"), [this](bool away) { is_away_ = away; });
    lines.enable = std::make_unique<WatchedLine>(bench_.make_line("ENABLE"), [this](bool on) {
      if (!on) ++switched_off;
    });
    lines.home = bench_.make_line("HOME");
    return lines;
  }

  double angle_deg() const { return static_cast<double>(steps_) / params().steps_per_deg; }

  std::atomic<bool> is_blocked = false;
  std::atomic<double> block_at_deg = 90.0;  // something stands in its way there
  std::atomic<bool> switch_is_dead = false;
  std::atomic<int> lose_every = 0;  // each so-many-th step; 0: none
  std::atomic<int> switched_off = 0;
  std::atomic<long> pulses = 0;

 private:
  static long steps_at(double angle_deg) { return std::lround(angle_deg * params().steps_per_deg); }
  void step() {
    const long pulse = ++pulses;
    if (is_blocked || (lose_every > 0 && pulse % lose_every == 0)) return;
    if (is_away_ && angle_deg() >= block_at_deg) return;
    steps_ += is_away_ ? 1 : -1;
    const double changes_deg = kCloses_deg + (is_closed_ ? kHysteresis_deg : 0.0) + off_deg_;
    const bool is_closed = steps_ <= steps_at(changes_deg);
    if (is_closed == is_closed_ || switch_is_dead) return;
    is_closed_ = is_closed;
    off_deg_ = std::uniform_real_distribution<double>(-kJitter_deg, kJitter_deg)(random_);
    bench_.set_input("HOME", is_closed);
  }

  GpioBench& bench_;
  std::atomic<long> steps_;
  std::atomic<bool> is_away_ = false;
  bool is_closed_;  // these three on the arm's thread
  double off_deg_ = 0.0;
  std::mt19937 random_{20261122};
};

}  // namespace traygauge
