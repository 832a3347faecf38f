#include "simulator/scenes/height_field.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

constexpr int kRings = 2;  // of nodes to extend by

// One ring of nodes; those that were filled are inside from then on.
void extend_once(HeightField& field, std::vector<std::uint8_t>& is_filled) {
  const GridFrame& frame = field.frame;
  std::vector<std::size_t> filled;
  for (int row = 1; row + 1 < frame.rows; ++row) {
    for (int column = 1; column + 1 < frame.columns; ++column) {
      const std::size_t here = frame.index(column, row);
      if (is_filled[here] != 0) continue;
      float sum = 0.0F;
      int count = 0;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const std::size_t there = frame.index(column + dx, row + dy);
          if (is_filled[there] == 0) continue;
          sum += field.height_mm[there];
          field.part[here] = field.part[there];
          ++count;
        }
      }
      if (count == 0) continue;
      field.height_mm[here] = sum / static_cast<float>(count);
      filled.push_back(here);
    }
  }
  for (const std::size_t node : filled) is_filled[node] = 1;
}

}  // namespace

GridFrame frame_around(double reach_mm, double step_mm) {
  const int half = static_cast<int>(std::ceil(reach_mm / step_mm)) + kRings + 1;
  return {-half * step_mm, -half * step_mm, step_mm, 2 * half + 1, 2 * half + 1};
}

void extend_outward(HeightField& field) {
  std::vector<std::uint8_t> is_filled(field.frame.size());
  std::transform(field.inside_mm.begin(), field.inside_mm.end(), is_filled.begin(),
                 [](float inside) { return static_cast<std::uint8_t>(inside > 0.0F); });
  for (int ring = 0; ring < kRings; ++ring) extend_once(field, is_filled);
}

void cut_away(HeightField& field, const HeightField& other) {
  for (std::size_t i = 0; i < field.inside_mm.size(); ++i)
    field.inside_mm[i] = std::min(field.inside_mm[i], -other.inside_mm[i]);
}

double quadrature_mm3(const HeightField& field) {
  double sum = 0.0;
  for (std::size_t i = 0; i < field.height_mm.size(); ++i) {
    if (field.inside_mm[i] > 0.0F) sum += static_cast<double>(field.height_mm[i]);
  }
  return sum * field.frame.step_mm * field.frame.step_mm;
}

}  // namespace traygauge
