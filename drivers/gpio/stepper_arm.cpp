#include "drivers/gpio/stepper_arm.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "drivers/gpio/step_profile.hpp"

namespace traygauge {
namespace {

// Homing looks this much further than the arm can stand.
constexpr double kSearchMargin_deg = 10.0;
constexpr auto kNowhere = std::numeric_limits<std::int64_t>::min();  // the switch may close at any step
constexpr Nanoseconds kWaitStep = std::chrono::milliseconds(1);
constexpr Nanoseconds kLongestPause = std::chrono::milliseconds(4);     // a motor's inertia bridges no more
constexpr Nanoseconds kDirectionSetup = std::chrono::microseconds(20);  // before the next step

Nanoseconds seconds(double count) {
  return std::chrono::round<Nanoseconds>(std::chrono::duration<double>(count));
}

double off_switch_deg(const StepperArmParams& params) {
  return 2.0 * params.home_overlap_deg;
}
double search_deg(const StepperArmParams& params) {
  return params.limits.max_deg + kSearchMargin_deg;
}

}  // namespace

Nanoseconds longest_move(const StepperArmParams& params) {
  constexpr double kBusy = 1.5;  // pauses, each of which ends in a new ramp
  constexpr Nanoseconds kSpare = std::chrono::seconds(1);
  const auto time_s = [&params](double way_deg, double speed_deg_per_s) {
    return way_deg / speed_deg_per_s + speed_deg_per_s / params.acceleration_deg_per_s2;
  };
  const double homing = params.homing_speed_deg_per_s;
  const double home_s = time_s(off_switch_deg(params), homing) + time_s(search_deg(params), homing) +
                        time_s(params.home_overlap_deg / 2.0, homing);
  const double move_s = time_s(params.limits.max_deg, params.speed_deg_per_s);
  return seconds(kBusy * std::max(home_s, move_s)) + params.settling_time + kSpare;
}

StepperArm::StepperArm(StepperLines lines, Clock& clock, const StepperArmParams& params)
    : Arm("arm"), lines_(std::move(lines)), clock_(clock), params_(params) {}

std::int64_t StepperArm::steps_at(double angle_deg) const {
  return std::llround(angle_deg * params_.steps_per_deg);
}

DeviceStatus StepperArm::do_start() {
  set_detail({});
  const DeviceStatus status = open_lines();
  if (!status.ok()) {
    close_lines();
    return status;
  }
  must_end_ = false;
  must_halt_ = false;
  goal_ = Goal::none;
  worker_ = std::thread([this] { work(); });
  return DeviceCode::ok;
}

DeviceStatus StepperArm::open_lines() {
  DeviceStatus status = lines_.step->open_output(false);
  const GpioLine* last = lines_.step.get();
  const auto open_next = [&](GpioLine* line, bool is_input, bool active) {
    if (line == nullptr || !status.ok()) return;
    last = line;
    status = is_input ? line->open_input() : line->open_output(active);
  };
  open_next(lines_.direction.get(), false, false);
  open_next(lines_.home.get(), true, false);
  open_next(lines_.enable.get(), false, true);
  if (!status.ok()) set_detail(last->problem());
  return status;
}

void StepperArm::close_lines() const {
  if (lines_.enable) {
    lines_.enable->close();
  }
  lines_.home->close();
  lines_.direction->close();
  lines_.step->close();
}

void StepperArm::do_stop() {
  {
    const std::lock_guard lock(mutex_);
    must_end_ = true;
    must_halt_ = true;
  }
  changed_.notify_all();
  worker_.join();
  if (lines_.enable) static_cast<void>(lines_.enable->write(false));  // an error leaves nothing to do
  close_lines();
}

void StepperArm::begin(Goal goal, std::int64_t target) {
  {
    const std::lock_guard lock(mutex_);
    goal_ = goal;
    target_ = target;
    must_halt_ = false;
    problem_ = "";
  }
  changed_.notify_all();
}

bool StepperArm::is_busy() {
  const std::lock_guard lock(mutex_);
  return goal_ != Goal::none;
}

void StepperArm::halt() {
  must_halt_ = true;
  while (is_busy()) clock_.sleep_for(kWaitStep);
}

// Waits for the worker, and once it is done for the arm to stop swinging. Beyond the timeout it halts.
DeviceStatus StepperArm::finish(Nanoseconds timeout) {
  const Instant deadline = clock_.now() + timeout;
  while (is_busy() && clock_.now() < deadline) clock_.sleep_for(kWaitStep);
  if (is_busy() || deadline - clock_.now() < params_.settling_time) {
    halt();
    return DeviceCode::timed_out;
  }
  DeviceStatus result;
  {
    const std::lock_guard lock(mutex_);
    set_detail(problem_);
    result = result_;
  }
  if (result.ok()) clock_.sleep_for(params_.settling_time);
  return result;
}

DeviceStatus StepperArm::do_home(Nanoseconds timeout) {
  halt();
  begin(Goal::home, 0);
  return finish(timeout);
}

DeviceStatus StepperArm::do_begin_move_to(double angle_deg) {
  {
    const std::lock_guard lock(mutex_);
    if (goal_ != Goal::none) return DeviceCode::busy;
  }
  begin(Goal::position, steps_at(angle_deg));
  return DeviceCode::ok;
}

DeviceStatus StepperArm::do_wait_until_still(Nanoseconds timeout) {
  return finish(timeout);
}

DeviceStatus StepperArm::do_read_position(double& angle_deg) {
  angle_deg = static_cast<double>(position_) / params_.steps_per_deg;
  return DeviceCode::ok;
}

void StepperArm::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return must_end_ || goal_ != Goal::none; });
    if (must_end_) return;
    const Goal goal = goal_;
    const std::int64_t target = target_;
    lock.unlock();
    const DeviceStatus result = carry_out(goal, target);
    lock.lock();
    result_ = result;
    goal_ = Goal::none;
  }
}

DeviceStatus StepperArm::carry_out(Goal goal, std::int64_t target) {
  return goal == Goal::home ? go_home() : go_to(target);
}

// Off the switch when it is closed, then slowly onto it and a little further: that place is 0.
DeviceStatus StepperArm::go_home() {
  const double speed = params_.homing_speed_deg_per_s;
  bool is_closed = false;
  DeviceStatus status = lines_.home->read(is_closed);
  if (status.ok() && is_closed) {
    status = run(steps_at(off_switch_deg(params_)) + 1, true, speed);
    if (status.ok()) {
      status = expect_switch(false,
                             "the home switch stays closed: the arm does not move, or the switch hangs or is "
                             "inverted");
    }
  }
  if (status.ok()) status = run(steps_at(search_deg(params_)), false, speed, kNowhere);
  if (status.ok()) {
    status = expect_switch(true,
                           "the home switch did not close: check the switch, whether it is inverted, the "
                           "motor and what blocks it");
  }
  if (status.ok()) status = run(closing_step(), false, speed);
  if (status.ok()) {
    status = expect_switch(true, "the home switch opens behind where it closes: check how it is mounted");
  }
  if (status.ok()) position_ = 0;
  return status;
}

DeviceStatus StepperArm::go_to(std::int64_t target) {
  const std::int64_t from = position_;
  const std::int64_t overlap = steps_at(params_.home_overlap_deg);
  const bool comes_back = target < from && from > overlap;
  const auto open_until = closing_step() + steps_at(params_.home_tolerance_deg);
  const DeviceStatus status = run(std::abs(target - from), target > from, params_.speed_deg_per_s,
                                  comes_back ? std::optional(open_until) : std::nullopt);
  if (!status.ok() || must_halt_) return status;
  if (target < from) return check_return(comes_back, target);
  if (target <= overlap) return status;
  return expect_switch(false, "away from home the home switch is closed: the arm does not move");
}

DeviceStatus StepperArm::check_return(bool was_beyond_switch, std::int64_t target) {
  const std::int64_t tolerance = steps_at(params_.home_tolerance_deg);
  if (was_beyond_switch && closed_at_ && *closed_at_ > closing_step() + tolerance) {
    return stall(
        "on the way back the home switch closed too early: the arm had not gone as far as it was told");
  }
  if (target == 0 && was_beyond_switch && closed_at_ && *closed_at_ < closing_step() - tolerance) {
    return stall("on the way back the home switch closed too late: steps were lost");
  }
  if (target == 0) return expect_switch(true, "back at 0 the home switch is open: steps were lost");
  return DeviceCode::ok;
}

DeviceStatus StepperArm::expect_switch(bool closed, const char* otherwise) {
  bool is_closed = false;
  const DeviceStatus status = lines_.home->read(is_closed);
  if (!status.ok() || is_closed == closed || must_halt_) return status;
  return stall(otherwise);
}

DeviceStatus StepperArm::stall(const char* problem) {
  const std::lock_guard lock(mutex_);
  problem_ = problem;
  return DeviceCode::stalled;
}

DeviceStatus StepperArm::run(std::int64_t steps, bool away, double speed_deg_per_s,
                             std::optional<std::int64_t> open_until) {
  closed_at_.reset();
  DeviceStatus status = lines_.direction->write(away);
  clock_.sleep_for(kDirectionSetup);
  const double speed = speed_deg_per_s * params_.steps_per_deg;
  const double acceleration = params_.acceleration_deg_per_s2 * params_.steps_per_deg;
  StepProfile profile(steps, speed, acceleration);
  Instant begun_at = clock_.now();
  std::int64_t done = 0;  // before `profile` begins
  for (std::int64_t i = 1; status.ok() && i <= steps && !must_halt_; ++i) {
    const Instant due = begun_at + seconds(profile.time_s(i - done));
    clock_.sleep_until(due);
    const Nanoseconds late = clock_.now() - due;
    // Steps that are due all at once would be lost; after a pause the motor stands and has to begin anew.
    begun_at += late;
    if (late > kLongestPause) {
      done = i - 1;
      profile = StepProfile(steps - done, speed, acceleration);
      begun_at = clock_.now();
    }
    status = make_step(away);
    if (!status.ok() || !open_until || closed_at_) continue;
    bool is_closed = false;
    status = lines_.home->read(is_closed);
    if (!is_closed) continue;
    closed_at_ = position_;
    if (position_ > *open_until) break;
  }
  return status;
}

DeviceStatus StepperArm::make_step(bool away) {
  DeviceStatus status = lines_.step->write(true);
  clock_.sleep_for(params_.pulse);
  if (status.ok()) status = lines_.step->write(false);
  if (status.ok()) position_ += away ? 1 : -1;
  return status;
}

}  // namespace traygauge
