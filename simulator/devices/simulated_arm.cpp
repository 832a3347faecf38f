#include "simulator/devices/simulated_arm.hpp"

#include <cmath>

namespace traygauge {

SimulatedArm::SimulatedArm(Clock& clock, const TrayPlayer* player, const SimulatedArmParams& params)
    : Arm("simulated arm"),
      clock_(clock),
      player_(player),
      params_(params),
      from_{params.power_on_deg},
      to_{params.power_on_deg} {}

SimulatedArm::Place SimulatedArm::at_now() const {
  const Instant now = clock_.now();
  if (now >= arrives_at_) return to_;
  const double share = std::chrono::duration<double>(now - left_at_) / (arrives_at_ - left_at_);
  return {from_.counted_deg + share * (to_.counted_deg - from_.counted_deg),
          from_.lost_deg + share * (to_.lost_deg - from_.lost_deg)};
}

DeviceStatus SimulatedArm::do_home(Nanoseconds timeout) {
  from_ = to_ = {true_position_deg(), 0.0};
  begin_motion({}, 1.0);
  return do_wait_until_still(timeout);
}

DeviceStatus SimulatedArm::do_begin_move_to(double angle_deg) {
  using enum FaultKind;
  if (clock_.now() < arrives_at_) return DeviceCode::busy;
  const FaultAction fault = faults_.next(clock_.now(), set_of({off, stuck, wrong_angle, silent_stall, slow}));
  if (fault.code() != DeviceCode::ok) return fault.code();
  const auto recorded_deg = player_ != nullptr ? player_->second_view_angle_deg() : std::nullopt;
  Place target{angle_deg == 0.0 ? 0.0 : recorded_deg.value_or(angle_deg), to_.lost_deg};
  if (angle_deg != 0.0) aimed_deg_ = target.counted_deg;
  const double way_deg = target.counted_deg - to_.counted_deg;
  if (fault.is(stuck)) target.lost_deg -= way_deg;
  if (fault.is(silent_stall)) target.lost_deg -= way_deg / 2;
  if (fault.is(wrong_angle)) target.lost_deg += fault.amount;
  begin_motion(target, fault.is(slow) ? fault.amount : 1.0);
  return DeviceCode::ok;
}

DeviceStatus SimulatedArm::do_wait_until_still(Nanoseconds timeout) {
  const Instant deadline = clock_.now() + timeout;
  const FaultAction fault = faults_.next(clock_.now(), set_of({FaultKind::off, FaultKind::stall}));
  if (fault.is(FaultKind::off)) {
    halt();
    return fault.code();
  }
  if (fault.code() != DeviceCode::ok) {
    clock_.sleep_for((arrives_at_ - clock_.now()) / 2);
    halt();
    clock_.sleep_until(deadline);
    return fault.code();
  }
  if (still_at() > deadline) {
    clock_.sleep_until(deadline);
    halt();
    return DeviceCode::timed_out;
  }
  clock_.sleep_until(still_at());
  return DeviceCode::ok;
}

DeviceStatus SimulatedArm::do_read_position(double& angle_deg) {
  if (faults_.is_off()) return DeviceCode::device_gone;
  angle_deg = at_now().counted_deg;
  return DeviceCode::ok;
}

void SimulatedArm::begin_motion(const Place& target, double slowness) {
  from_ = at_now();
  to_ = target;
  left_at_ = clock_.now();
  const std::chrono::duration<double> seconds(slowness * std::abs(to_.counted_deg - from_.counted_deg) /
                                              params_.speed_deg_per_s);
  arrives_at_ = left_at_ + std::chrono::round<Nanoseconds>(seconds);
}

void SimulatedArm::halt() {
  from_ = to_ = at_now();
  left_at_ = arrives_at_ = clock_.now();
}

}  // namespace traygauge
