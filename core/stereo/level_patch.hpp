// Does something lie at a height over a place of the table? There both pictures show the same small square,
// parallel to the table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/stereo/surface_view.hpp"

namespace traygauge {

struct LevelPatchParams {
  double side_mm = 16.0;            // 8 samples of 2 mm: finer ones see the noise, larger ones a dish's curve
  double min_contrast = 3.0;        // standard deviation in grey values; less is noise
  double max_contrast_ratio = 2.0;  // between the pictures; more are an edge in one and none in the other
};

class LevelPatch {
 public:
  // `middle_mm` of the scene; where both pictures are labelled `label`, a patch is bare.
  LevelPatch(const SurfaceView& first, const SurfaceView& second, std::uint8_t label, const Vec3& middle_mm,
             const LevelPatchParams& params);

  // Normalised cross-correlation of both pictures around `middle_mm`, in the table frame: -1 to 1. -1 also
  // where the patch is not bare or shows nothing.
  double correlation(const Vec3& middle_mm) const;

 private:
  static constexpr int kSide = 8;  // samples
  static constexpr std::size_t kSamples = static_cast<std::size_t>(kSide) * kSide;

  struct Samples {
    std::array<float, kSamples> gray{};
    double mean = 0.0;
    double deviation = 0.0;
  };

  bool read(std::size_t view, const Vec3& middle_mm, Samples& samples) const;

  LevelPatchParams params_;
  std::array<const SurfaceView*, 2> views_;
  std::array<std::size_t, 2> levels_;
  std::uint8_t label_;
};

}  // namespace traygauge
