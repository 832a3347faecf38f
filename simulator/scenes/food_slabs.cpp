// One flat piece.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "simulator/scenes/food_heap.hpp"
#include "simulator/scenes/food_shapes.hpp"

namespace traygauge {
namespace {

// Height of a slab `inside_mm` from its border, which is rounded and begins at a share of the height.
double slab_height(double height_mm, double inside_mm, double rounding_mm, double border_fraction) {
  const double t = std::clamp(inside_mm / rounding_mm, 0.0, 1.0);
  return height_mm * (border_fraction + (1.0 - border_fraction) * std::sqrt(t * (2.0 - t)));
}

// A convex polygon with corners counter-clockwise.
double polygon_inside(const std::vector<Eigen::Vector2d>& corners, double x_mm, double y_mm) {
  double inside_mm = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d along = (corners[(i + 1) % corners.size()] - from).normalized();
    inside_mm = std::min(inside_mm, along.x() * (y_mm - from.y()) - along.y() * (x_mm - from.x()));
  }
  return inside_mm;
}

void paint_slab(FoodPainter& painter, const BlobOutline& outline, double height_mm, double rounding_mm,
                double border_fraction, std::uint16_t part) {
  painter.piece({0.0, 0.0}, outline.reach_mm(), part, [&](double x_mm, double y_mm) {
    const double inside_mm = outline.inside_mm(x_mm, y_mm);
    return PieceColumn{slab_height(height_mm, inside_mm, rounding_mm, border_fraction), inside_mm};
  });
}

// A wedge of a round: its point towards -x, its back an arc.
PieceColumn wedge_column(const FoodSize& size, double x_mm, double y_mm, double height_mm,
                         double rounding_mm) {
  const double from_point = x_mm + 0.5 * size.length_mm;
  const double half_angle = std::atan2(0.5 * size.width_mm, size.length_mm);
  const double side_mm = from_point * std::sin(half_angle) - std::abs(y_mm) * std::cos(half_angle);
  const double back_mm = size.length_mm - std::hypot(from_point, y_mm);
  const double inside_mm = from_point <= 0.0 ? -std::hypot(from_point, y_mm) : std::min(side_mm, back_mm);
  return {slab_height(height_mm, inside_mm, rounding_mm, 0.8), inside_mm};
}

}  // namespace

void paint_schnitzel(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.32);
  paint_slab(painter, outline, size.height_mm, 9.0, 0.3, food_part(0, 0));
  painter.roughen(0.3 * size.height_mm, 26.0, draws.seed(), 2);
  painter.roughen(0.9, 3.5, draws.seed(), 3);
}

void paint_steak(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.18);
  paint_slab(painter, outline, size.height_mm, 5.0, 0.55, food_part(0, 0));
  painter.roughen(0.12 * size.height_mm, 18.0, draws.seed(), 2);
  painter.roughen(0.4, 2.5, draws.seed(), 2);
}

void paint_fish(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.12);
  paint_mound(painter, outline, {size.height_mm, 2.6, 0.55}, food_part(0, 0));
  // The flakes of the muscle lie across the fillet as chevrons.
  const double flake_mm = draws.between(6.0, 9.0);
  painter.displace([=](double x_mm, double y_mm, double height_mm) {
    const double phase = (x_mm + 0.5 * std::abs(y_mm)) / flake_mm;
    return 0.6 * std::min(1.0, height_mm / 6.0) * (phase - std::floor(phase) - 0.5);
  });
  painter.roughen(0.10 * size.height_mm, 15.0, draws.seed(), 3);
}

void paint_patty(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.07);
  paint_slab(painter, outline, size.height_mm, 6.0, 0.5, food_part(0, 0));
  painter.roughen(1.6, 5.0, draws.seed(), 3);
}

void paint_omelette(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  // Folded: a half round, higher at the fold.
  const BlobOutline outline(draws, size.length_mm, 2.0 * size.width_mm, 0.08);
  const double shift_mm = 0.5 * size.width_mm;
  painter.piece({0.0, 0.0}, outline.reach_mm() + shift_mm, food_part(0, 0), [&](double x_mm, double y_mm) {
    const double y = y_mm + shift_mm;
    const double inside_mm = std::min(outline.inside_mm(x_mm, y), y);
    const double fold = 1.0 - 0.35 * std::clamp(y / size.width_mm, 0.0, 1.0);
    return PieceColumn{slab_height(size.height_mm * fold, inside_mm, 7.0, 0.25), inside_mm};
  });
  painter.roughen(0.15 * size.height_mm, 20.0, draws.seed(), 2);
  painter.roughen(0.4, 4.0, draws.seed(), 2);
}

void paint_bread(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const double bulge = draws.between(0.9, 1.15);
  const double half_x = 0.5 * size.length_mm;
  const double half_y = 0.5 * size.width_mm;
  painter.piece({0.0, 0.0}, std::hypot(half_x, half_y), food_part(0, 0), [&](double x_mm, double y_mm) {
    const double x = x_mm / half_x;
    const double y = y_mm / half_y * (1.0 + (bulge - 1.0) * x * x);
    const double share = std::pow(std::pow(std::abs(x), 4.0) + std::pow(std::abs(y), 4.0), 0.25);
    const double inside_mm = (1.0 - share) * std::min(half_x, half_y);
    return PieceColumn{slab_height(size.height_mm, inside_mm, 1.5, 0.8), inside_mm};
  });
  painter.roughen(0.7, 4.0, draws.seed(), 3);
}

void paint_chicken(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  // A leg: slices of the thigh, which narrows to the shank, and the end of the bone.
  constexpr int kSlices = 26;
  const double half_mm = 0.5 * size.length_mm;
  const double bend_mm = draws.between(-0.1, 0.1) * size.length_mm;
  const double waist = draws.between(0.35, 0.5);
  const auto bent = [&](double share) { return bend_mm * share * share; };  // -1 to 1 along the leg
  for (int i = 0; i < kSlices; ++i) {
    const double share = -0.55 + 1.2 * i / (kSlices - 1);
    const double narrowing = std::clamp((share + 0.35) / 0.8, 0.0, 1.0);
    const double width = 1.0 - (1.0 - waist) * narrowing * narrowing * (3.0 - 2.0 * narrowing);
    const Eigen::Vector3d semi(0.42 * half_mm * width, 0.5 * size.width_mm * width,
                               0.5 * size.height_mm * width);
    painter.superquadric({{share * half_mm, bent(share), 0.9 * semi.z()}, semi}, food_part(0, 0));
  }
  const double bone_mm = 0.16 * size.height_mm;
  painter.rod(
      {{0.6 * half_mm, bent(0.6), 1.3 * bone_mm}, {0.92 * half_mm, bent(0.92), 1.1 * bone_mm}, bone_mm},
      food_part(1, 2));
  painter.roughen(1.6, 13.0, draws.seed(), 3);
}

void paint_pizza(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const double crust_mm = draws.between(12.0, 16.0);
  const double base_mm = 0.5 * size.height_mm;
  const double reach_mm = std::hypot(size.length_mm, size.width_mm);
  painter.piece({0.0, 0.0}, reach_mm, food_part(0, 0),
                [&](double x_mm, double y_mm) { return wedge_column(size, x_mm, y_mm, base_mm, 1.5); });
  painter.piece({0.0, 0.0}, reach_mm, food_part(1, 0), [&](double x_mm, double y_mm) {
    PieceColumn column = wedge_column(size, x_mm, y_mm, base_mm, 1.5);
    const double from_back = size.length_mm - std::hypot(x_mm + 0.5 * size.length_mm, y_mm);
    const double across = 2.0 * from_back / crust_mm - 1.0;
    if (std::abs(across) >= 1.0) return PieceColumn{0.0, column.inside_mm};
    column.top_mm += (size.height_mm - base_mm) * std::sqrt(1.0 - across * across);
    return column;
  });
  for (int i = 0; i < 5; ++i) {  // slices of salami, within the wedge
    const double x = size.length_mm * draws.between(-0.2, 0.28);
    const double half_width = 0.5 * size.width_mm * (x / size.length_mm + 0.5);
    const double y = draws.between(-0.6, 0.6) * half_width;
    const double r = std::min(draws.between(9.0, 12.0), 0.75 * (half_width - std::abs(y)));
    if (r < 4.0) continue;
    Superquadric slice{{x, y, base_mm + 0.3}, {r, r, 1.4}};
    slice.height_exponent = 4.0;
    painter.superquadric(slice, food_part(2, i));
  }
  painter.roughen(0.9, 8.0, draws.seed(), 3);
}

void paint_cake(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  painter.piece(
      {0.0, 0.0}, std::hypot(size.length_mm, size.width_mm), food_part(0, 0),
      [&](double x_mm, double y_mm) { return wedge_column(size, x_mm, y_mm, size.height_mm, 2.0); });
  painter.roughen(0.5, 5.0, draws.seed(), 3);
}

void paint_lasagne(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const double a = 0.5 * size.length_mm;
  const double b = 0.5 * size.width_mm;
  const auto jitter = [&] { return draws.between(0.9, 1.0); };
  const std::vector<Eigen::Vector2d> corners = {{-a * jitter(), -b * jitter()},
                                                {a * jitter(), -b * jitter()},
                                                {a * jitter(), b * jitter()},
                                                {-a * jitter(), b * jitter()}};
  painter.piece({0.0, 0.0}, std::hypot(a, b), food_part(0, 0), [&](double x_mm, double y_mm) {
    const double inside_mm = polygon_inside(corners, x_mm, y_mm);
    return PieceColumn{slab_height(size.height_mm, inside_mm, 4.0, 0.7), inside_mm};
  });
  painter.roughen(0.1 * size.height_mm, 16.0, draws.seed(), 3);
}

}  // namespace traygauge
