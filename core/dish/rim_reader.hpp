// Grey values across the rim of a dish, as one view shows them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/dish/dish_search.hpp"
#include "core/image/gray_weights.hpp"

namespace traygauge {

// Grey values of a frame between its pixels.
class GraySampler {
 public:
  explicit GraySampler(const FrameView& frame)
      : frame_(frame), weights_(gray_weights(frame.format)), bytes_(bytes_per_pixel(frame.format)) {}

  bool sample(const Vec2& pixel, float& gray) const {
    if (!(pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < frame_.width - 1 &&
          pixel.y() < frame_.height - 1))
      return false;
    const int x = static_cast<int>(pixel.x());
    const int y = static_cast<int>(pixel.y());
    const auto fx = static_cast<float>(pixel.x() - x);
    const auto fy = static_cast<float>(pixel.y() - y);
    const std::uint8_t* at = frame_.data + y * frame_.stride_bytes + static_cast<std::ptrdiff_t>(x) * bytes_;
    const std::uint8_t* below = at + frame_.stride_bytes;
    const float upper = value(at) * (1.0F - fx) + value(at + bytes_) * fx;
    const float lower = value(below) * (1.0F - fx) + value(below + bytes_) * fx;
    gray = upper * (1.0F - fy) + lower * fy;
    return true;
  }

 private:
  float value(const std::uint8_t* pixel) const {
    if (bytes_ == 1) return pixel[0];
    return static_cast<float>(weights_.first * pixel[0] + weights_.second * pixel[1] +
                              weights_.third * pixel[2]) /
           static_cast<float>(kGrayOne);
  }

  FrameView frame_;
  GrayWeights weights_;
  int bytes_;
};

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
    const Vec2 slope = 0.5 * (pixels[2] - pixels[0]);
    const Vec2 bend = 0.5 * (pixels[2] + pixels[0]) - pixels[1];
    for (std::size_t i = 0; i < size; ++i) {
      float gray = 0.0F;
      const double t = 2.0 * static_cast<double>(i) / static_cast<double>(size - 1) - 1.0;
      if (!gray_.sample(pixels[1] + t * slope + t * t * bend, gray)) return false;
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
