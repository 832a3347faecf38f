// An arm turned by a stepper motor whose driver chip takes steps and a direction; a switch tells home.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "drivers/arm.hpp"
#include "drivers/gpio/gpio_line.hpp"

namespace traygauge {

struct StepperArmParams {
  double steps_per_deg = 53.333;  // 200 steps a turn, 16 microsteps, gear 6
  ArmLimits limits{0.0, 45.0};    // min_deg is 0: the switch is at the lower end
  double speed_deg_per_s = 30.0;
  double acceleration_deg_per_s2 = 60.0;
  double homing_speed_deg_per_s = 5.0;  // also where the switch closes exactly
  // The switch is closed up to here at most. 0 lies half of it inside of where the switch closes, so that at
  // 0 neither its hysteresis nor a hair's breadth opens it.
  double home_overlap_deg = 2.0;
  // Coming back, the switch closes as far from where it did at homing at most. Beyond, steps were lost: scans
  // refuse an angle that is off by as much.
  double home_tolerance_deg = 0.5;
  Nanoseconds pulse = std::chrono::microseconds(5);  // driver chips ask for 1 to 2.5
  Nanoseconds settling_time = std::chrono::milliseconds(300);
};

// How long going home from anywhere, or any move, may take on a busy board.
Nanoseconds longest_move(const StepperArmParams& params);

struct StepperLines {
  std::unique_ptr<GpioLine> step;
  std::unique_ptr<GpioLine> direction;  // active: away from home
  std::unique_ptr<GpioLine> enable;     // null: the motor is always on
  std::unique_ptr<GpioLine> home;       // active: the switch is closed
};

// Steps are counted. The switch catches what the count cannot know: at 0 it must be closed, and open beyond
// home_overlap_deg; and on the way back it must close where it did at homing. Else steps were lost, and the
// move ends with `stalled`.
class StepperArm final : public Arm {
 public:
  // `clock` outlives the arm.
  StepperArm(StepperLines lines, Clock& clock, const StepperArmParams& params);
  ~StepperArm() override { stop(); }

 private:
  enum class Goal : std::uint8_t { none, position, home };

  DeviceStatus do_start() override;
  void do_stop() override;
  ArmLimits do_limits() const override { return params_.limits; }
  DeviceStatus do_home(Nanoseconds timeout) override;
  DeviceStatus do_begin_move_to(double angle_deg) override;
  DeviceStatus do_wait_until_still(Nanoseconds timeout) override;
  DeviceStatus do_read_position(double& angle_deg) override;

  DeviceStatus open_lines();
  void close_lines() const;
  // Below, on the worker's thread.
  void work();
  DeviceStatus carry_out(Goal goal, std::int64_t target);
  DeviceStatus go_home();
  DeviceStatus go_to(std::int64_t target);
  DeviceStatus check_return(bool was_beyond_switch, std::int64_t target);
  // Up to `steps` in one direction, fewer when the switch closes beyond `open_until`; notes where it closes.
  // Without `open_until` the switch is not looked at.
  DeviceStatus run(std::int64_t steps, bool away, double speed_deg_per_s,
                   std::optional<std::int64_t> open_until = std::nullopt);
  DeviceStatus make_step(bool away);
  DeviceStatus expect_switch(bool closed, const char* otherwise);
  DeviceStatus stall(const char* problem);

  void begin(Goal goal, std::int64_t target);
  void halt();
  bool is_busy();
  DeviceStatus finish(Nanoseconds timeout);
  std::int64_t steps_at(double angle_deg) const;
  // Where the switch closes.
  std::int64_t closing_step() const { return steps_at(params_.home_overlap_deg / 2.0); }

  StepperLines lines_;
  Clock& clock_;
  StepperArmParams params_;
  std::thread worker_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Goal goal_ = Goal::none;  // these five under the mutex
  std::int64_t target_ = 0;
  bool must_end_ = false;
  DeviceStatus result_;
  const char* problem_ = "";
  std::atomic<bool> must_halt_ = false;
  std::atomic<std::int64_t> position_ = 0;  // steps from home
  std::optional<std::int64_t> closed_at_;   // where the switch closed in the last run; the worker's
};

}  // namespace traygauge
