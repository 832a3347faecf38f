// One estimator on its own block, and the synthetic tray through it.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "core/base/arena.hpp"
#include "core/pipeline/tray_estimator.hpp"
#include "tests/core/pipeline/tray_scene.hpp"

namespace traygauge {

struct AlignedDelete {
  void operator()(std::byte* bytes) const {
    ::operator delete (bytes, std::align_val_t{kArenaAlignmentBytes});
  }
};

// Memory for an estimator, filled with a pattern that no measurement relies on.
class TestBlock {
 public:
  explicit TestBlock(std::size_t size)
      : bytes_(static_cast<std::byte*>(::operator new (size, std::align_val_t{kArenaAlignmentBytes}))),
        size_(size) {
    std::memset(bytes_.get(), 0xA5, size);
  }
  std::span<std::byte> bytes() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<std::byte, AlignedDelete> bytes_;
  std::size_t size_ = 0;
};

// `Estimator` of either profile with its `Config`.
template <class Estimator, class Config>
class BenchOf {
 public:
  explicit BenchOf(const Config& configuration)
      : block(required_bytes(configuration)), estimator(block.bytes(), configuration) {}

  // Stops at the first view that is refused, as the station does.
  const Measurement& measure(const ViewInput& first, const ViewInput& second, std::uint64_t seed = 1) {
    estimator.reset();
    if (estimator.add_view(first).ok()) static_cast<void>(estimator.add_view(second));
    return estimator.estimate(seed);
  }
  const Measurement& measure(const TrayScene& scene, std::uint64_t seed = 1) {
    return measure(scene.view(0), scene.view(1), seed);
  }

  TestBlock block;
  Estimator estimator;
};

using MeasuringBench = BenchOf<TrayEstimator, Configuration>;

// Everything that a measurement says, times apart, as numbers to be compared bit by bit.
inline std::vector<double> numbers_of(const Measurement& measurement) {
  std::vector<double> numbers = {static_cast<double>(measurement.status.code()),
                                 measurement.relative_angle_deg,
                                 measurement.rotation_angle_deg,
                                 measurement.report.inlier_threshold_px,
                                 static_cast<double>(measurement.report.inliers),
                                 static_cast<double>(measurement.report.pose_iterations),
                                 measurement.report.mm_per_baseline,
                                 measurement.report.rim_height_mm,
                                 measurement.report.matched_fraction,
                                 measurement.report.label_agreement};
  const Pose& pose = measurement.second_from_first;
  numbers.insert(numbers.end(), pose.rotation.data(), pose.rotation.data() + 9);
  numbers.insert(numbers.end(), pose.translation.data(), pose.translation.data() + 3);
  for (const ItemResult& item : measurement.items) {
    numbers.insert(numbers.end(), {static_cast<double>(item.label), static_cast<double>(item.status),
                                   item.volume_ml, item.area_mm2, item.mean_height_mm, item.max_height_mm});
  }
  return numbers;
}

inline bool have_equal_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace traygauge
