// The depth map of the reference picture: every dish pixel's match is unprojected (paper III-B-3).
#pragma once

#include <cstdint>
#include <limits>

#include "core/geometry/geometry.hpp"
#include "core/geometry/triangulation.hpp"  // IWYU pragma: export
#include "core/image_view/image_view.hpp"
#include "core/labels/label_regions.hpp"
#include "core/paper/surface/disparity_lookup.hpp"  // IWYU pragma: export

namespace traygauge::paper {

struct DepthMapReport {
  std::uint32_t dish_pixels = 0;
  std::uint32_t known_pixels = 0;  // of those, with a depth

  double known_fraction() const {
    return dish_pixels == 0 ? 0.0 : static_cast<double>(known_pixels) / dish_pixels;
  }
};

// Fills `depth_mm` (size of `labels`, the first working picture) with z along the first camera's axis for
// every pixel of dish and food; NaN elsewhere and where the match is unknown or lies behind a camera.
// `correspondence` is `bool (const Vec2& first_pixel, Vec2& second_pixel)`, false where there is no match.
template <class Correspondence>
DepthMapReport fill_depth_map(ImageView<const std::uint8_t> labels, const CameraPair& cameras,
                              Correspondence&& correspondence, ImageView<float> depth_mm) {
  const Mat3& rotation = cameras.second_from_first.rotation;
  const Vec3 column_step = rotation.col(0) / cameras.first.fx_px;
  DepthMapReport report;
  for (int y = 0; y < labels.height; ++y) {
    const Vec2 row_ray = cameras.first.ray(Vec2(0.0, y));
    const Vec3 row_start = rotation * Vec3(row_ray.x(), row_ray.y(), 1.0);
    for (int x = 0; x < labels.width; ++x) {
      float& depth = depth_mm.at(x, y);
      depth = std::numeric_limits<float>::quiet_NaN();
      if (!is_on_dish(labels.at(x, y))) continue;
      ++report.dish_pixels;
      Vec2 second_pixel;
      if (!correspondence(Vec2(x, y), second_pixel)) continue;
      const Vec2 second_ray = cameras.second.ray(second_pixel);
      double z = 0.0;
      if (!triangulate_depth(row_start + x * column_step, Vec3(second_ray.x(), second_ray.y(), 1.0),
                             cameras.second_from_first.translation, z)) {
        continue;
      }
      depth = static_cast<float>(z);
      ++report.known_pixels;
    }
  }
  return report;
}

}  // namespace traygauge::paper
