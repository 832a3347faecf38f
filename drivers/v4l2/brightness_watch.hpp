// Whether a camera's automatics have come to rest, by the brightness of its frames.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace traygauge {

class BrightnessWatch {
 public:
  // A frame's mean, 0 to 255.
  void add(double mean) { means_[count_++ % kFrames] = mean; }
  bool is_steady() const {
    if (count_ < kFrames) return false;
    const auto [least, most] = std::minmax_element(means_.begin(), means_.end());
    return *most - *least <= kSteady;
  }

 private:
  // Automatics take steps every frame or two; over five frames even a slow one moves by more than the means
  // of frames alike differ, which noise and flicker leave below one.
  static constexpr std::size_t kFrames = 5;
  static constexpr double kSteady = 1.5;

  std::array<double, kFrames> means_{};
  std::size_t count_ = 0;
};

}  // namespace traygauge
