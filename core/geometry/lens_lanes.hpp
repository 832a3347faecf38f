// The lens in single precision, for loops over pixels that run in SIMD lanes: error below 0.001 px.
#pragma once

#include "core/geometry/camera.hpp"

namespace traygauge {

// Samples of a row at a time, over which a lens is linear enough for one Jacobian.
inline constexpr int kLensRun = 64;

// As LensModel::distort and then PinholeCamera::pixel, its numbers converted once.
class LensLanes {
 public:
  struct Pixel {
    float x;
    float y;
  };

  explicit LensLanes(const LensModel& lens)
      : k1_(static_cast<float>(lens.k1)),
        k2_(static_cast<float>(lens.k2)),
        k3_(static_cast<float>(lens.k3)),
        p1_(static_cast<float>(lens.p1)),
        p2_(static_cast<float>(lens.p2)),
        fx_px_(static_cast<float>(lens.pinhole.fx_px)),
        fy_px_(static_cast<float>(lens.pinhole.fy_px)),
        cx_px_(static_cast<float>(lens.pinhole.cx_px)),
        cy_px_(static_cast<float>(lens.pinhole.cy_px)) {}

  // Where an ideal ray meets the stored picture.
  Pixel pixel(float x, float y) const {
    const float square = x * x + y * y;
    const float radial = 1.0F + square * (k1_ + square * (k2_ + square * k3_));
    return {fx_px_ * (x * radial + 2.0F * p1_ * x * y + p2_ * (square + 2.0F * x * x)) + cx_px_,
            fy_px_ * (y * radial + p1_ * (square + 2.0F * y * y) + 2.0F * p2_ * x * y) + cy_px_};
  }

 private:
  float k1_;
  float k2_;
  float k3_;
  float p1_;
  float p2_;
  float fx_px_;
  float fy_px_;
  float cx_px_;
  float cy_px_;
};

}  // namespace traygauge
