#include "drivers/gpio/step_profile.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {

StepProfile::StepProfile(std::int64_t steps, double speed_per_s, double acceleration_per_s2)
    : steps_(static_cast<double>(steps)),
      speed_per_s_(speed_per_s),
      acceleration_per_s2_(acceleration_per_s2),
      ramp_steps_(std::min(speed_per_s * speed_per_s / (2.0 * acceleration_per_s2), steps_ / 2.0)),
      ramp_s_(std::sqrt(2.0 * ramp_steps_ / acceleration_per_s2)),
      duration_s_(2.0 * ramp_s_ + (steps_ - 2.0 * ramp_steps_) / speed_per_s) {}

double StepProfile::time_s(std::int64_t index) const {
  const auto step = static_cast<double>(index);
  if (step <= ramp_steps_) return std::sqrt(2.0 * step / acceleration_per_s2_);
  const double left = steps_ - step;
  if (left < ramp_steps_) return duration_s_ - std::sqrt(2.0 * left / acceleration_per_s2_);
  return ramp_s_ + (step - ramp_steps_) / speed_per_s_;
}

}  // namespace traygauge
