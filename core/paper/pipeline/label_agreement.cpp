#include "core/paper/pipeline/label_agreement.hpp"

#include <cmath>

#include "core/labels/label_regions.hpp"

namespace traygauge::paper {

double measure_label_agreement(ImageView<const std::uint8_t> reference_labels,
                               ImageView<const std::uint8_t> other_labels, ImageView<const float> depth_mm,
                               const CameraPair& cameras, const LabelAgreementParams& params) {
  int looked_at = 0;
  int agreeing = 0;
  for (int y = 0; y < reference_labels.height; y += params.step_px) {
    for (int x = 0; x < reference_labels.width; x += params.step_px) {
      const std::uint8_t label = reference_labels.at(x, y);
      const auto depth = static_cast<double>(depth_mm.at(x, y));
      if (!is_item(label) || std::isnan(depth)) continue;
      const Vec2 ray = cameras.first.ray(Vec2(x, y));
      const Vec3 point = cameras.second_from_first * Vec3(ray.x() * depth, ray.y() * depth, depth);
      ++looked_at;
      if (point.z() <= 0.0) continue;
      const Vec2 pixel = cameras.second.pixel(point.head<2>() / point.z());
      const auto column = static_cast<int>(std::lround(pixel.x()));
      const auto row = static_cast<int>(std::lround(pixel.y()));
      if (other_labels.contains(column, row) && other_labels.at(column, row) == label) ++agreeing;
    }
  }
  return looked_at == 0 ? 0.0 : static_cast<double>(agreeing) / looked_at;
}

}  // namespace traygauge::paper
