// What every RANSAC loop shares (Fischler & Bolles 1981): samples, and the number of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/random.hpp"

namespace traygauge {

// Fills `sample` with different indices below `count` (Floyd's method); count >= sample.size().
inline void sample_distinct(Random& random, std::size_t count, std::span<std::size_t> sample) {
  for (std::size_t k = 0; k < sample.size(); ++k) {
    const std::size_t last = count - sample.size() + k;
    const std::size_t drawn = random.below(static_cast<std::uint32_t>(last + 1));
    const auto end = sample.begin() + static_cast<std::ptrdiff_t>(k);
    sample[k] = std::find(sample.begin(), end, drawn) == end ? drawn : last;
  }
}

template <std::size_t N>
std::array<std::size_t, N> sample_distinct(Random& random, std::size_t count) {
  std::array<std::size_t, N> sample{};
  sample_distinct(random, count, sample);
  return sample;
}

// Ends the search once an outlier-free sample was drawn with the wanted confidence. Products instead of
// logarithms: the number of iterations does not depend on a mathematical library.
class IterationBound {
 public:
  IterationBound(double confidence, int min_iterations, int max_iterations)
      : allowed_miss_(1.0 - confidence), min_(min_iterations), max_(max_iterations) {}

  bool proceed() const { return done_ < max_ && (done_ < min_ || miss_ > allowed_miss_); }
  void count_iteration() {
    ++done_;
    miss_ *= contaminated_;
  }
  // A better model was found: `inlier_rate` of all data agree with it.
  void update(double inlier_rate, std::size_t sample_size) {
    double clean = 1.0;
    for (std::size_t i = 0; i < sample_size; ++i) clean *= inlier_rate;
    contaminated_ = 1.0 - clean;
    miss_ = 1.0;
    for (int i = 0; i < done_; ++i) miss_ *= contaminated_;
  }
  int iterations() const { return done_; }

 private:
  double allowed_miss_;
  int min_;
  int max_;
  int done_ = 0;
  double contaminated_ = 1.0;  // chance that a sample holds an outlier
  double miss_ = 1.0;          // chance that all samples so far did
};

}  // namespace traygauge
