// Heaps of rods and leaves.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulator/scenes/food_heap.hpp"
#include "simulator/scenes/food_shapes.hpp"

namespace traygauge {
namespace {

struct Strand {
  double radius_mm = 1.0;
  double length_mm = 60.0;
  double step_mm = 5.0;
  double bend_rad = 0.3;  // largest change of direction a step
  double lift_mm = 2.0;   // above or below the heap's surface
};

// A strand that wanders over the heap and ends at its edge.
void paint_strand(FoodPainter& painter, Draws& draws, const BlobOutline& outline, const Mound& mound,
                  const Strand& strand, const Eigen::Vector2d& start, std::uint16_t part) {
  double direction = draws.angle_rad();
  double bend = draws.between(-strand.bend_rad, strand.bend_rad);
  const double lift_mm = draws.between(-strand.lift_mm, strand.lift_mm);
  const auto on_heap = [&](const Eigen::Vector2d& at) {
    const double surface_mm = mound.at(outline.share(at.x(), at.y())) + lift_mm;
    return Eigen::Vector3d(at.x(), at.y(), std::max(surface_mm, strand.radius_mm));
  };
  Eigen::Vector3d from = on_heap(start);
  double done_mm = 0.0;
  while (done_mm < strand.length_mm) {
    const Eigen::Vector2d at =
        from.head<2>() + strand.step_mm * Eigen::Vector2d(std::cos(direction), std::sin(direction));
    const Eigen::Vector3d to = on_heap(at);
    painter.rod({from, to, strand.radius_mm}, part);
    from = to;
    bend = std::clamp(bend + draws.between(-0.5, 0.5) * strand.bend_rad, -strand.bend_rad, strand.bend_rad);
    if (outline.share(at.x(), at.y()) > 0.97) return;
    direction += bend;
    done_mm += strand.step_mm;
  }
}

struct Stick {
  double length_mm = 60.0;
  double half_mm = 4.0;
  double exponent = 9.0;
  double irregularity = 0.15;
  double spread_rad = 0.7;  // of their directions, about the heap's length
};

// Straight sticks, crossing, the later above the earlier.
void paint_sticks(FoodPainter& painter, Draws& draws, const FoodSize& size, int count, const Stick& kind) {
  for (int piece = 0; piece < count; ++piece) {
    const double layer = static_cast<double>(piece) / count;
    const double half_length_mm = 0.5 * kind.length_mm * draws.between(0.6, 1.0);
    const double angle = kind.spread_rad * draws.normal();
    const double thick_mm = kind.half_mm * draws.between(1.0 - kind.irregularity, 1.0 + kind.irregularity);
    const double tilt = draws.between(-0.22, 0.22) * layer;
    Superquadric stick{{}, {half_length_mm, thick_mm, thick_mm * draws.between(0.9, 1.05)}};
    stick.side_exponent = stick.height_exponent = kind.exponent;
    stick.rotation = (Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()))
                         .toRotationMatrix();
    const double narrowing = 1.0 - 0.45 * layer;
    const double room_x = std::max(6.0, 0.5 * size.length_mm - half_length_mm * std::abs(std::cos(angle)));
    const double room_y =
        std::max(6.0, 0.5 * size.width_mm - half_length_mm * std::abs(std::sin(angle)) - thick_mm);
    const double u = draws.between(-1.0, 1.0) * narrowing;
    const double v = draws.between(-1.0, 1.0) * narrowing;
    const double height_mm =
        kind.half_mm + layer * (size.height_mm - 2.0 * kind.half_mm) * (1.0 - 0.4 * std::max(u * u, v * v));
    stick.centre_mm = {room_x * u, room_y * v,
                       std::max(height_mm, kind.half_mm + std::abs(std::sin(tilt)) * half_length_mm)};
    painter.superquadric(stick, food_part(0, piece));
  }
}

}  // namespace

void paint_fries(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const int count = static_cast<int>(size.length_mm * size.width_mm * size.height_mm / 4200.0);
  paint_sticks(painter, draws, size, count, {66.0, 4.3, 9.0, 0.15, 0.8});
}

void paint_green_beans(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const int count = static_cast<int>(size.length_mm * size.width_mm * size.height_mm / 2600.0);
  paint_sticks(painter, draws, size, count, {74.0, 3.6, 2.3, 0.2, 0.3});
}

void paint_penne(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.15);
  heap_pieces(
      painter, draws, outline, {size.height_mm, 2.4, 0.75}, 6.0, food_part(1, 0),
      static_cast<int>(size.length_mm * size.width_mm / 25.0), 8.0,
      [&](const Eigen::Vector3d& at, int piece) {
        const double angle = draws.angle_rad();
        const double half_mm = draws.between(14.0, 19.0);
        const double rise_mm = draws.between(-5.0, 5.0);
        const Eigen::Vector3d along(half_mm * std::cos(angle), half_mm * std::sin(angle), rise_mm);
        Eigen::Vector3d middle = at;
        middle.z() = std::max(at.z() - draws.between(0.0, 4.0), 4.2 + std::abs(rise_mm));
        painter.rod({middle - along, middle + along, draws.between(4.0, 4.6), false}, food_part(0, piece));
      });
}

void paint_spaghetti(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, 0.94 * size.length_mm, 0.94 * size.width_mm, 0.12);
  const Mound mound{size.height_mm - 2.0, 2.0, 0.8};
  heap_pieces(painter, draws, outline, mound, 2.5, food_part(1, 0),
              static_cast<int>(size.length_mm * size.width_mm / 32.0), 0.0,
              [&](const Eigen::Vector3d& at, int piece) {
                const Strand strand{draws.between(0.9, 1.15), draws.between(60.0, 140.0), 5.0, 0.32, 2.0};
                paint_strand(painter, draws, outline, mound, strand, at.head<2>(), food_part(0, piece));
              });
}

void paint_slaw(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, 0.92 * size.length_mm, 0.92 * size.width_mm, 0.18);
  const Mound mound{size.height_mm - 1.5, 2.0, 0.85};
  heap_pieces(painter, draws, outline, mound, 3.0, food_part(0, 0),
              static_cast<int>(size.length_mm * size.width_mm / 18.0), 0.0,
              [&](const Eigen::Vector3d& at, int piece) {
                const Strand strand{draws.between(0.7, 1.5), draws.between(14.0, 32.0), 4.0, 0.2, 2.5};
                const int texture = draws.chance(0.2) ? 2 : draws.whole(0, 1);
                paint_strand(painter, draws, outline, mound, strand, at.head<2>(), food_part(texture, piece));
              });
}

void paint_salad(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, 0.9 * size.length_mm, 0.9 * size.width_mm, 0.15);
  heap_pieces(painter, draws, outline, {size.height_mm - 3.0, 2.2, 0.8}, 5.0, food_part(1, 0),
              static_cast<int>(size.length_mm * size.width_mm / 28.0), 6.0,
              [&](const Eigen::Vector3d& at, int piece) {
                const bool is_tomato = draws.chance(0.08);
                const double r = is_tomato ? draws.between(9.0, 11.0) : draws.between(9.0, 19.0);
                Superquadric leaf{at, {r, r * draws.between(0.45, 0.8), draws.between(0.9, 1.8)}};
                if (is_tomato) leaf.semi_mm = {r, r, 3.0};
                leaf.rotation = random_rotation(draws, is_tomato ? 0.3 : 0.7);
                leaf.centre_mm.z() = std::max(at.z() - draws.between(0.0, 3.0), 2.0);
                painter.superquadric(leaf, food_part(is_tomato ? 2 : draws.whole(0, 1), piece));
              });
  painter.roughen(1.8, 7.0, draws.seed(), 3);
}

void paint_broccoli(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.08);
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  int piece = 0;
  for (const Eigen::Vector2d& place : scatter(draws, outline, 500, 0.56 * size.height_mm, 0.72)) {
    const double r = 0.48 * size.height_mm * draws.between(0.7, 1.0);
    const Eigen::Vector3d middle(place.x(), place.y(), 1.05 * r * draws.between(0.75, 1.0));
    painter.superquadric({middle, {0.92 * r, 0.92 * r, 0.9 * r}}, food_part(1, piece));
    const double bud_mm = draws.between(1.9, 2.5);
    const int buds = static_cast<int>(5.0 * r * r / (bud_mm * bud_mm));
    for (int i = 0; i < buds; ++i) {  // evenly over the upper part of the sphere
      const double height = 1.0 - 1.25 * (i + 0.5) / buds;
      const double ring = std::sqrt(1.0 - height * height);
      const double angle = golden * i + draws.between(-0.2, 0.2);
      const Eigen::Vector3d out(ring * std::cos(angle), ring * std::sin(angle), height);
      const double size_mm = bud_mm * draws.between(0.8, 1.15);
      painter.superquadric({middle + r * draws.between(0.88, 1.0) * out, Eigen::Vector3d::Constant(size_mm)},
                           food_part(0, piece * 7 + i % 7));
    }
    ++piece;
  }
  painter.roughen(0.5, 2.2, draws.seed(), 2);
}

void paint_sausage(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const double radius_mm = 0.5 * size.height_mm;
  const double half_mm = 0.5 * size.length_mm - radius_mm;
  const double bow_mm = draws.between(0.05, 0.14) * size.length_mm;
  constexpr int kRods = 14;
  const auto at = [&](int i) {
    const double share = 2.0 * i / kRods - 1.0;
    return Eigen::Vector3d(half_mm * share, bow_mm * (share * share - 0.5), radius_mm);
  };
  for (int i = 0; i < kRods; ++i) painter.rod({at(i), at(i + 1), radius_mm}, food_part(0, 0));
  painter.roughen(0.5, 9.0, draws.seed(), 2);
}

}  // namespace traygauge
