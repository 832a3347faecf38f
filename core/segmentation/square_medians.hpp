// Medians of bytes over squares: T. S. Huang et al., A fast two-dimensional median filtering algorithm, IEEE
// Trans. ASSP 27 (1979). From one square to the next the histogram loses a column and gains one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace traygauge {

// Counts of bytes, whose median follows what is added and removed.
class RunningMedian {
 public:
  void clear() { *this = {}; }
  void add(std::uint8_t value) { change(value, 1); }
  void remove(std::uint8_t value) { change(value, -1); }

  // The least value with half of the counts at or below it. 0 without any.
  std::uint8_t value() {
    while (2 * below_ > total_ || (2 * below_ == total_ && median_ > 0)) below_ -= counts_[--median_];
    while (median_ < 255 && 2 * (below_ + counts_[median_]) < total_) below_ += counts_[median_++];
    return static_cast<std::uint8_t>(median_);
  }

 private:
  void change(std::uint8_t value, int count) {
    counts_[value] += count;
    total_ += count;
    if (value < median_) below_ += count;
  }

  std::array<int, 256> counts_{};
  std::size_t median_ = 0;
  int below_ = 0;  // of the counts, below median_
  int total_ = 0;
};

// Calls take(x, y, median) for the squares of 2 radius + 1 about each place of a field, cut off at its
// borders; value(x, y) gives its bytes.
template <class Value, class Take>
void for_each_square_median(int width, int height, int radius, Value&& value, Take&& take) {
  RunningMedian median;
  for (int y = 0; y < height; ++y) {
    const int top = std::max(0, y - radius);
    const int bottom = std::min(height - 1, y + radius);
    median.clear();
    const auto add_column = [&](int x) {
      for (int j = top; j <= bottom; ++j) median.add(value(x, j));
    };
    for (int x = 0; x < std::min(radius, width); ++x) add_column(x);
    for (int x = 0; x < width; ++x) {
      if (x + radius < width) add_column(x + radius);
      if (x > radius) {
        for (int j = top; j <= bottom; ++j) median.remove(value(x - radius - 1, j));
      }
      take(x, y, median.value());
    }
  }
}

}  // namespace traygauge
