// Food as heights over a grid: what every kind is painted on, meshed from and integrated over.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace traygauge {

// Nodes of a square grid in the dish's coordinates; node (0, 0) lies at x0, y0.
struct GridFrame {
  double x0_mm = 0.0;
  double y0_mm = 0.0;
  double step_mm = 0.3;
  int columns = 0;
  int rows = 0;

  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  Eigen::Vector2d node(int column, int row) const {
    return {x0_mm + step_mm * column, y0_mm + step_mm * row};
  }
};

// A square about the origin that holds every point within `reach_mm`.
GridFrame frame_around(double reach_mm, double step_mm);

struct HeightField {
  HeightField() = default;  // without nodes
  explicit HeightField(const GridFrame& frame_)
      : frame(frame_),
        height_mm(frame_.size(), 0.0F),
        inside_mm(frame_.size(), kFarOutside),
        part(frame_.size(), 0) {}

  static constexpr float kFarOutside = -100.0F;

  GridFrame frame;
  std::vector<float> height_mm;     // above what the food stands on
  std::vector<float> inside_mm;     // how far inside the footprint, about; below 0 outside
  std::vector<std::uint16_t> part;  // which of the food's textures and pieces is on top
};

// Gives nodes outside, next to the footprint, the mean height and a part of their neighbours inside, so that
// heights can be interpolated up to the edge of the footprint.
void extend_outward(HeightField& field);

// Takes from the footprint of `field` what lies in that of `other`, over the same frame.
void cut_away(HeightField& field, const HeightField& other);

// Sum of the heights of nodes in the footprint, each for a square of the grid; mm^3.
double quadrature_mm3(const HeightField& field);

}  // namespace traygauge
