// What foods are made of: pieces, rods and heaps, painted on a height field; where they meet, the highest
// counts.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/height_field.hpp"

namespace traygauge {

// A piece's height at a place, and how far inside of the piece's outline the place is, mm.
struct PieceColumn {
  double top_mm = 0.0;
  double inside_mm = -1.0;
};

// Which texture of the food (0 to 3) and which piece of it, in one number.
constexpr std::uint16_t food_part(int texture, int piece) {
  return static_cast<std::uint16_t>((piece << 2) | texture);
}

// ((|x/a|^e + |y/b|^e)^(n/e) + |z/c|^n = 1: an ellipsoid with exponents 2, a box with rounded edges above 5.
struct Superquadric {
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d semi_mm = Eigen::Vector3d::Ones();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // from its own axes
  double side_exponent = 2.0;
  double height_exponent = 2.0;
};

// A straight rod; its ends are round or cut off.
struct Rod {
  Eigen::Vector3d from_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_mm = Eigen::Vector3d::Zero();
  double radius_mm = 1.0;
  bool has_round_ends = true;
};

// A closed curve about the origin: an ellipse whose radius swells and shrinks by waves.
class BlobOutline {
 public:
  BlobOutline(Draws& draws, double length_mm, double width_mm, double irregularity);
  // Distance from the origin as a share of the curve's in that direction.
  double share(double x_mm, double y_mm) const;
  double inside_mm(double x_mm, double y_mm) const;
  double reach_mm() const { return reach_mm_; }
  double semi_x_mm() const { return semi_x_mm_; }
  double semi_y_mm() const { return semi_y_mm_; }

 private:
  static constexpr std::size_t kWaves = 6;
  double radius_mm(double angle_rad) const;

  double semi_x_mm_;
  double semi_y_mm_;
  double reach_mm_ = 0.0;
  std::array<double, kWaves> size_{};
  std::array<double, kWaves> phase_rad_{};
};

// Paints in the food's coordinates: origin in its middle, turned by its rotation, z up from what it stands
// on.
class FoodPainter {
 public:
  FoodPainter(HeightField& field, Eigen::Vector2d centre_mm, double rotation_deg);

  void superquadric(const Superquadric& piece, std::uint16_t part);
  void rod(const Rod& rod, std::uint16_t part);

  // Any other piece that lies within `reach_mm` of `middle`: PieceColumn column(x_mm, y_mm).
  template <class Column>
  void piece(const Eigen::Vector2d& middle_mm, double reach_mm, std::uint16_t part, const Column& column) {
    visit(middle_mm, reach_mm, [&](std::size_t node, double x_mm, double y_mm) {
      const PieceColumn at = column(x_mm, y_mm);
      field_.inside_mm[node] = std::max(field_.inside_mm[node], static_cast<float>(at.inside_mm));
      if (at.inside_mm <= 0.0 || at.top_mm <= static_cast<double>(field_.height_mm[node])) return;
      field_.height_mm[node] = static_cast<float>(at.top_mm);
      field_.part[node] = part;
    });
  }

  // Adds displacement_mm(x, y, height) to what is painted already; heights stay above 0.
  template <class Displacement>
  void displace(const Displacement& displacement_mm) {
    for (int row = 0; row < field_.frame.rows; ++row) {
      for (int column = 0; column < field_.frame.columns; ++column) {
        const std::size_t node = field_.frame.index(column, row);
        if (field_.inside_mm[node] <= 0.0F) continue;
        const Eigen::Vector2d at = local(field_.frame.node(column, row));
        const auto height_mm = static_cast<double>(field_.height_mm[node]);
        const double moved_mm = height_mm + displacement_mm(at.x(), at.y(), height_mm);
        field_.height_mm[node] = static_cast<float>(std::max(0.0, moved_mm));
      }
    }
  }

  // By fractal noise with features of `size_mm`; edges, lower than the amplitude, move less.
  void roughen(double amplitude_mm, double size_mm, std::uint32_t seed, int octaves);

 private:
  template <class Visitor>
  void visit(const Eigen::Vector2d& middle_mm, double reach_mm, const Visitor& visitor) {
    const GridFrame& frame = field_.frame;
    const Eigen::Vector2d middle = centre_mm_ + turn_ * middle_mm;
    const double margin_mm = reach_mm + 2.0 * frame.step_mm;
    const auto first = [&](double at, double origin) {
      return std::max(0, static_cast<int>(std::ceil((at - margin_mm - origin) / frame.step_mm)));
    };
    const auto last = [&](double at, double origin, int count) {
      return std::min(count - 1, static_cast<int>(std::floor((at + margin_mm - origin) / frame.step_mm)));
    };
    const int column_end = last(middle.x(), frame.x0_mm, frame.columns);
    const int row_end = last(middle.y(), frame.y0_mm, frame.rows);
    for (int row = first(middle.y(), frame.y0_mm); row <= row_end; ++row) {
      for (int column = first(middle.x(), frame.x0_mm); column <= column_end; ++column) {
        const Eigen::Vector2d at = local(frame.node(column, row));
        visitor(frame.index(column, row), at.x(), at.y());
      }
    }
  }

  Eigen::Vector2d local(const Eigen::Vector2d& at_mm) const {
    return turn_.transpose() * (at_mm - centre_mm_);
  }

  HeightField& field_;
  Eigen::Vector2d centre_mm_;
  Eigen::Matrix2d turn_;
};

}  // namespace traygauge
