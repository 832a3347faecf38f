// When each step of a move is due: constant acceleration, constant speed, constant deceleration.
#pragma once

#include <cstdint>

namespace traygauge {

class StepProfile {
 public:
  // `steps` ≥ 0, speed and acceleration > 0. A short move never reaches its speed.
  StepProfile(std::int64_t steps, double speed_per_s, double acceleration_per_s2);

  // Seconds from the start of the move to the end of step `index`, from 1 to steps.
  double time_s(std::int64_t index) const;
  double duration_s() const { return duration_s_; }

 private:
  double steps_;
  double speed_per_s_;
  double acceleration_per_s2_;
  double ramp_steps_;  // from standing to the highest speed
  double ramp_s_;
  double duration_s_;
};

}  // namespace traygauge
