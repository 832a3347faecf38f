// Matches by columns, for scoring many models.
#pragma once

#include <cstddef>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/geometry/triangulation.hpp"

namespace traygauge::paper {

class MatchTable {
 public:
  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t max_matches) {
    x1_ = arena.template take<double>(max_matches);
    y1_ = arena.template take<double>(max_matches);
    x2_ = arena.template take<double>(max_matches);
    y2_ = arena.template take<double>(max_matches);
    size_ = 0;
  }

  void clear() { size_ = 0; }
  // False when full.
  bool push_back(const RayMatch& match);

  std::size_t size() const { return size_; }
  std::size_t capacity() const { return x1_.size(); }
  RayMatch operator[](std::size_t i) const { return {{x1_[i], y1_[i]}, {x2_[i], y2_[i]}}; }

  // Writes the symmetric epipolar distance of every match, in pixels.
  void measure_distances(const Mat3& essential, double focal_px, std::span<double> distances) const;

  // Matches not farther than the threshold. Stops early, with a number not above `to_beat`, as soon as the
  // model can no longer have more than that.
  std::size_t count_inliers(const Mat3& essential, double focal_px, double threshold_px,
                            std::size_t to_beat) const;

  // Eq. (1). Stops early, with a value not above `to_beat`, as soon as the model can no longer exceed it.
  double fitness(const Mat3& essential, double focal_px, double threshold_px, double to_beat) const;

 private:
  std::span<double> x1_;
  std::span<double> y1_;
  std::span<double> x2_;
  std::span<double> y2_;
  std::size_t size_ = 0;
};

}  // namespace traygauge::paper
