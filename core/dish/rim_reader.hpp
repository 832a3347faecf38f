// Grey values across the rim of a dish, as one view shows them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/dish/dish_search.hpp"
#include "core/geometry/parabola.hpp"
#include "core/image/gray_sampler.hpp"

namespace traygauge {

// Where the dish's edge shows in one view, looking across the rim that `place` predicts.
class RimReader {
 public:
  RimReader(const DishSearchView& view, const DishSearchParams& params)
      : view_(view), gray_(view.frame), params_(params) {}

  // How many offsets there are within `reach_mm` on either side, the rim included.
  int offsets(double reach_mm) const {
    const int most = (static_cast<int>(kMaxRimOffsets) - 2 * band() - 2) / 2;
    return 2 * std::min(static_cast<int>(std::lround(reach_mm / params_.sample_mm)), most) + 1;
  }
  double offset_mm(double index, int count) const {
    const int centre = count / 2;
    return (index - centre) * params_.sample_mm;
  }

  // Fills `steps` along the normal: how much brighter (or darker, sign −1) the picture is inside than outside
  // of each offset from the rim, inward first. False where it leaves the picture.
  bool read_steps(const RimNormal& rim, int inside_sign, std::span<float> steps) const {
    const auto width = static_cast<std::size_t>(band());
    std::array<float, kMaxRimOffsets + 1> sums{};  // running
    const std::size_t size = steps.size() + 2 * width;
    // Perspective and lens bend a line of some centimetres by less than a parabola leaves over.
    const double reach_mm = offset_mm(static_cast<double>(size - 1), static_cast<int>(size));
    std::array<Vec2, 3> pixels;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      const Vec3 in_camera = view_.camera_from_table * rim.beyond((static_cast<double>(k) - 1.0) * reach_mm);
      if (!(in_camera.z() > 0.0)) return false;
      pixels[k] = view_.lens.pixel(in_camera.hnormalized());
    }
    const PixelParabola line(pixels);
    for (std::size_t i = 0; i < size; ++i) {
      float gray = 0.0F;
      const double t = 2.0 * static_cast<double>(i) / static_cast<double>(size - 1) - 1.0;
      if (!gray_.sample(line.at(t), gray)) return false;
      sums[i + 1] = sums[i] + gray;
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const float inside = sums[i + width] - sums[i];
      const float outside = sums[i + 2 * width + 1] - sums[i + width + 1];
      steps[i] = static_cast<float>(inside_sign) * (inside - outside) / static_cast<float>(width);
    }
    return true;
  }

 private:
  int band() const { return static_cast<int>(std::lround(params_.band_mm / params_.sample_mm)); }

  const DishSearchView& view_;
  GraySampler gray_;
  const DishSearchParams& params_;
};

}  // namespace traygauge
