// Heaps: a soft mound, and pieces strewn over one.
#pragma once

#include <functional>

#include "simulator/scenes/food_painter.hpp"

namespace traygauge {

// Height of a heap by the share of the way from its middle to its outline: H (1 - share^steepness)^rounding.
struct Mound {
  double height_mm = 0.0;
  double steepness = 2.0;
  double rounding = 1.0;

  double at(double share) const;
};

void paint_mound(FoodPainter& painter, const BlobOutline& outline, const Mound& mound, std::uint16_t part);

// Places in an outline, `spacing_mm` apart in plan where there is room; `count` tries.
std::vector<Eigen::Vector2d> scatter(Draws& draws, const BlobOutline& outline, int count, double spacing_mm,
                                     double largest_fraction);

// A rotation about z by any angle after a tilt of up to `tilt_rad` about a random level axis.
Eigen::Matrix3d random_rotation(Draws& draws, double tilt_rad);

// Pieces resting on a mound: `paint` gets where the mound's surface is there, and which piece it is.
using PiecePainter = std::function<void(const Eigen::Vector3d& at_mm, int piece)>;
void heap_pieces(FoodPainter& painter, Draws& draws, const BlobOutline& outline, const Mound& mound,
                 double filler_depth_mm, std::uint16_t filler_part, int count, double spacing_mm,
                 const PiecePainter& paint);

}  // namespace traygauge
