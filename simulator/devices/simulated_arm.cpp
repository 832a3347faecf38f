#include "simulator/devices/simulated_arm.hpp"

#include <cmath>

namespace traygauge {

SimulatedArm::SimulatedArm(Clock& clock, const TrayPlayer* player, const SimulatedArmParams& params)
    : Arm("simulated arm"),
      clock_(clock),
      player_(player),
      params_(params),
      from_deg_(params.power_on_deg),
      to_deg_(params.power_on_deg) {}

double SimulatedArm::true_position_deg() const {
  const Instant now = clock_.now();
  if (now >= arrives_at_) return to_deg_;
  const double share = std::chrono::duration<double>(now - left_at_) / (arrives_at_ - left_at_);
  return from_deg_ + share * (to_deg_ - from_deg_);
}

DeviceStatus SimulatedArm::do_start() {
  return faults_.next();
}

void SimulatedArm::do_stop() {
  halt();
}

DeviceStatus SimulatedArm::do_home(Nanoseconds timeout) {
  begin_motion(0.0);
  return do_wait_until_still(timeout);
}

DeviceStatus SimulatedArm::do_begin_move_to(double angle_deg) {
  if (clock_.now() < arrives_at_) return DeviceCode::busy;
  const DeviceStatus status = faults_.next();
  if (!status.ok()) return status;
  const auto recorded_deg = player_ != nullptr ? player_->second_view_angle_deg() : std::nullopt;
  begin_motion(angle_deg == 0.0 ? 0.0 : recorded_deg.value_or(angle_deg));
  return DeviceCode::ok;
}

DeviceStatus SimulatedArm::do_wait_until_still(Nanoseconds timeout) {
  const Instant deadline = clock_.now() + timeout;
  const DeviceStatus status = faults_.next();
  if (!status.ok()) {
    clock_.sleep_for((arrives_at_ - clock_.now()) / 2);
    halt();
    clock_.sleep_until(deadline);
    return status;
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
  angle_deg = true_position_deg();
  return DeviceCode::ok;
}

void SimulatedArm::begin_motion(double target_deg) {
  from_deg_ = true_position_deg();
  to_deg_ = target_deg;
  left_at_ = clock_.now();
  const std::chrono::duration<double> seconds(std::abs(to_deg_ - from_deg_) / params_.speed_deg_per_s);
  arrives_at_ = left_at_ + std::chrono::round<Nanoseconds>(seconds);
}

void SimulatedArm::halt() {
  from_deg_ = to_deg_ = true_position_deg();
  left_at_ = arrives_at_ = clock_.now();
}

}  // namespace traygauge
