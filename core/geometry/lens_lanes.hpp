// The lens in single precision, for loops over pixels that run in SIMD lanes: error below 0.001 px.
#pragma once

#include <array>

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

  // Where an ideal ray meets the stored picture; the further terms of the lens are left out.
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

// The same with the terms that few lenses need.
class FurtherLensLanes {
 public:
  explicit FurtherLensLanes(const LensModel& lens)
      : k_{static_cast<float>(lens.k1),         static_cast<float>(lens.k2),
           static_cast<float>(lens.k3),         static_cast<float>(lens.further.k4),
           static_cast<float>(lens.further.k5), static_cast<float>(lens.further.k6)},
        p1_(static_cast<float>(lens.p1)),
        p2_(static_cast<float>(lens.p2)),
        s_{static_cast<float>(lens.further.s1), static_cast<float>(lens.further.s2),
           static_cast<float>(lens.further.s3), static_cast<float>(lens.further.s4)},
        pixel_from_distorted_(pixel_from_distorted(lens)) {}

  LensLanes::Pixel pixel(float x, float y) const {
    const float square = x * x + y * y;
    const float radial = (1.0F + square * (k_[0] + square * (k_[1] + square * k_[2]))) /
                         (1.0F + square * (k_[3] + square * (k_[4] + square * k_[5])));
    const float u =
        x * radial + 2.0F * p1_ * x * y + p2_ * (square + 2.0F * x * x) + square * (s_[0] + square * s_[1]);
    const float v =
        y * radial + p1_ * (square + 2.0F * y * y) + 2.0F * p2_ * x * y + square * (s_[2] + square * s_[3]);
    const Eigen::Matrix3f& m = pixel_from_distorted_;
    const float inverse = 1.0F / (m(2, 0) * u + m(2, 1) * v + m(2, 2));
    return {(m(0, 0) * u + m(0, 1) * v + m(0, 2)) * inverse, (m(1, 0) * u + m(1, 1) * v + m(1, 2)) * inverse};
  }

 private:
  static Eigen::Matrix3f pixel_from_distorted(const LensModel& lens) {
    const PinholeCamera& pinhole = lens.pinhole;
    const SensorTilt& tilt = lens.further.tilt;
    Mat3 pixel_from_tilted;
    pixel_from_tilted << pinhole.fx_px, 0.0, pinhole.cx_px, 0.0, pinhole.fy_px, pinhole.cy_px, 0.0, 0.0, 1.0;
    Mat3 tilted_from_distorted;
    tilted_from_distorted << tilt[0], tilt[1], tilt[2], tilt[3], tilt[4], tilt[5], tilt[6], tilt[7], tilt[8];
    return (pixel_from_tilted * tilted_from_distorted).cast<float>();
  }

  std::array<float, 6> k_;
  float p1_;
  float p2_;
  std::array<float, 4> s_;
  Eigen::Matrix3f pixel_from_distorted_;
};

// Calls `work` with the lanes that the lens needs.
template <class Work>
void with_lens_lanes(const LensModel& lens, Work work) {
  if (lens.further.is_used) {
    work(FurtherLensLanes(lens));
  } else {
    work(LensLanes(lens));
  }
}

}  // namespace traygauge
