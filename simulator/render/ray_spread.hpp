// How much a pixel's rays differ.
#pragma once

#include <algorithm>
#include <cmath>

namespace traygauge {

class RaySpread {
 public:
  // So many rays, each of this brightness.
  void add(float brightness, float rays = 1.0F) {
    rays_ += rays;
    sum_ += rays * brightness;
    square_sum_ += rays * brightness * brightness;
  }

  // Standard deviation in shares of the mean; of two rays or more.
  float share() const {
    const float mean = sum_ / rays_;
    if (!(mean > 0.0F)) return 0.0F;
    const float variance = (square_sum_ / rays_ - mean * mean) * (rays_ / (rays_ - 1.0F));
    return std::sqrt(std::max(variance, 0.0F)) / mean;
  }

 private:
  float rays_ = 0.0F;
  float sum_ = 0.0F;
  float square_sum_ = 0.0F;
};

}  // namespace traygauge
