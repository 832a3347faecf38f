// Smooth foods, most of them white: what is hard to see on white glaze.
#include <algorithm>
#include <cmath>

#include "simulator/scenes/food_heap.hpp"
#include "simulator/scenes/food_shapes.hpp"
#include "simulator/scenes/noise.hpp"

namespace traygauge {
namespace {

// As many pieces side by side along x as have room: their places.
std::vector<Eigen::Vector2d> in_a_row(Draws& draws, double length_mm, double pitch_mm, double jitter_mm) {
  const int count = std::max(1, static_cast<int>(length_mm / pitch_mm));
  std::vector<Eigen::Vector2d> places;
  places.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double along_mm = pitch_mm * (i - 0.5 * (count - 1)) + draws.between(-0.5, 0.5) * jitter_mm;
    places.emplace_back(along_mm, draws.between(-1.0, 1.0) * jitter_mm);
  }
  return places;
}

// 0 at the border, 1 from `reach_mm` inside of it on, like a quarter of an ellipse.
double rounded_edge(double inside_mm, double reach_mm) {
  const double share = std::clamp(inside_mm / reach_mm, 0.0, 1.0);
  return std::sqrt(share * (2.0 - share));
}

void paint_balls(FoodPainter& painter, Draws& draws, const FoodSize& size, double flattening) {
  const double radius_mm = 0.5 * std::min(size.width_mm, size.height_mm / flattening);
  int piece = 0;
  for (const Eigen::Vector2d& place : in_a_row(draws, size.length_mm, 1.95 * radius_mm, 0.1 * radius_mm)) {
    const double r = radius_mm * draws.between(0.92, 1.0);
    Superquadric ball{{place.x(), place.y(), 0.95 * flattening * r}, {r, 0.97 * r, flattening * r}};
    ball.side_exponent = ball.height_exponent = draws.between(2.0, 2.3);
    painter.superquadric(ball, food_part(0, piece++));
  }
}

}  // namespace

void paint_fried_egg(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.3);
  const double sheet_mm = draws.between(2.0, 4.5);
  const Eigen::Vector2d yolk{draws.between(-0.12, 0.12) * size.length_mm,
                             draws.between(-0.12, 0.12) * size.width_mm};
  const double yolk_mm = draws.between(17.0, 21.0);
  const auto white_mm = [&](double x_mm, double y_mm, double inside_mm) {
    const double far = (Eigen::Vector2d(x_mm, y_mm) - yolk).norm() / (1.9 * yolk_mm);
    const double thick_mm = 0.12 * size.height_mm * std::max(0.0, 1.0 - far * far);  // about the yolk
    return (sheet_mm + thick_mm) * (0.35 + 0.65 * rounded_edge(inside_mm, 5.0));
  };
  painter.piece({0.0, 0.0}, outline.reach_mm(), food_part(0, 0), [&](double x_mm, double y_mm) {
    const double inside_mm = outline.inside_mm(x_mm, y_mm);
    return PieceColumn{white_mm(x_mm, y_mm, inside_mm), inside_mm};
  });
  if (draws.chance(0.5)) {  // fried brown in places along the border
    const std::uint32_t seed = draws.seed();
    painter.piece({0.0, 0.0}, outline.reach_mm(), food_part(2, 0), [&](double x_mm, double y_mm) {
      const Eigen::Vector3d at = Eigen::Vector3d(x_mm, y_mm, 0.0) / 22.0;
      const double reach_mm = 6.0 * static_cast<double>(fractal_noise(at.cast<float>(), seed, 3)) + 1.0;
      const double inside_mm = outline.inside_mm(x_mm, y_mm);
      if (inside_mm > reach_mm) return PieceColumn{0.0, inside_mm};
      return PieceColumn{white_mm(x_mm, y_mm, inside_mm) + 0.05, inside_mm};
    });
  }
  painter.roughen(0.8, 13.0, draws.seed(), 2);
  const double middle_mm = 0.5 * sheet_mm;
  Superquadric dome{{yolk.x(), yolk.y(), middle_mm},
                    {yolk_mm, yolk_mm * draws.between(0.92, 1.0), size.height_mm - middle_mm}};
  dome.height_exponent = draws.between(2.0, 2.6);
  painter.superquadric(dome, food_part(1, 1));
}

void paint_egg_halves(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const double half_width_mm = 0.36 * size.width_mm;
  const double half_length_mm = draws.between(1.25, 1.4) * half_width_mm;
  const bool shows_yolk = draws.chance(0.8);
  int piece = 0;
  for (const Eigen::Vector2d& place : in_a_row(draws, size.length_mm, 2.1 * half_width_mm, 3.0)) {
    const Eigen::Rotation2Dd turn(draws.between(-0.4, 0.4) + (draws.chance(0.5) ? 3.14159 : 0.0));
    const auto inside_of = [&](double x_mm, double y_mm) {
      const Eigen::Vector2d at = turn * (Eigen::Vector2d(x_mm, y_mm) - place);
      const double narrowing = 1.0 - 0.14 * at.y() / half_length_mm;  // to one end
      return (1.0 - std::hypot(at.x() / (half_width_mm * narrowing), at.y() / half_length_mm)) *
             half_width_mm;
    };
    painter.piece(place, half_length_mm * 1.2, food_part(0, piece), [&](double x_mm, double y_mm) {
      const double inside_mm = inside_of(x_mm, y_mm);
      const double edge_mm = shows_yolk ? 1.5 : half_width_mm;
      const double least = shows_yolk ? 0.75 : 0.05;
      return PieceColumn{size.height_mm * (least + (1.0 - least) * rounded_edge(inside_mm, edge_mm)),
                         inside_mm};
    });
    if (shows_yolk) {
      const double white_mm = draws.between(0.28, 0.4) * half_width_mm;
      painter.piece(place, half_length_mm * 1.2, food_part(1, piece), [&](double x_mm, double y_mm) {
        const double inside_mm = inside_of(x_mm, y_mm);
        if (inside_mm < white_mm) return PieceColumn{0.0, inside_mm};
        return PieceColumn{size.height_mm + 0.1 + 0.5 * rounded_edge(inside_mm - white_mm, 4.0), inside_mm};
      });
    }
    ++piece;
  }
}

void paint_mozzarella_slices(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const double radius_mm = 0.5 * size.width_mm;
  const double half_mm = 0.27 * size.height_mm;
  const double lean = draws.between(0.05, 0.18);
  const int count = draws.whole(2, 4);
  const double pitch_mm = count > 1 ? (size.length_mm - 2.0 * radius_mm) / (count - 1) : 0.0;
  for (int i = 0; i < count; ++i) {
    const double r = radius_mm * draws.between(0.88, 1.0);
    Superquadric slice{{}, {r, r * draws.between(0.9, 1.0), half_mm}};
    slice.height_exponent = 3.5;
    slice.rotation = Eigen::AngleAxisd(lean, Eigen::Vector3d::UnitY()).toRotationMatrix();
    slice.centre_mm = {pitch_mm * (i - 0.5 * (count - 1)), draws.between(-3.0, 3.0),
                       half_mm + 0.7 * r * std::sin(lean)};
    painter.superquadric(slice, food_part(0, i));
  }
  painter.roughen(0.4, 9.0, draws.seed(), 2);
}

void paint_mozzarella_ball(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  paint_balls(painter, draws, size, 0.85);
  painter.roughen(0.5, 12.0, draws.seed(), 2);
}

void paint_dumplings(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  paint_balls(painter, draws, size, 0.92);
  painter.roughen(0.9, 6.0, draws.seed(), 3);
}

void paint_cubes(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.15);
  const double half_mm = draws.between(5.0, 8.0);
  heap_pieces(painter, draws, outline, {0.75 * size.height_mm, 2.2, 0.8}, 5.0, food_part(1, 0), 400,
              1.9 * half_mm, [&](const Eigen::Vector3d& at, int piece) {
                const double r = half_mm * draws.between(0.9, 1.05);
                Superquadric cube{at, {r, r * draws.between(0.9, 1.1), r * draws.between(0.85, 1.0)}};
                cube.side_exponent = cube.height_exponent = 8.0;
                cube.rotation = random_rotation(draws, 0.35);
                cube.centre_mm.z() = std::max(at.z() - 0.5 * r, 0.9 * r);
                painter.superquadric(cube, food_part(0, piece));
              });
}

// Spooned out: smooth, with the spoon's spiral.
void paint_smooth_heap(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.12);
  paint_mound(painter, outline, {size.height_mm, draws.between(2.0, 3.0), draws.between(0.6, 0.9)},
              food_part(0, 0));
  painter.roughen(0.09 * size.height_mm, 26.0, draws.seed(), 2);
  const double wave_mm = draws.between(14.0, 22.0);
  const double depth_mm = draws.between(0.0, 0.05) * size.height_mm;
  const double phase = draws.angle_rad();
  painter.displace([=](double x_mm, double y_mm, double height_mm) {
    const double spiral = 6.28318 * std::hypot(x_mm, y_mm) / wave_mm + std::atan2(y_mm, x_mm) + phase;
    return depth_mm * std::min(1.0, height_mm / 8.0) * std::sin(spiral);
  });
}

// Turned out of a mould, some with a sauce about it and over it.
void paint_panna_cotta(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const double foot_mm = 0.38 * size.width_mm;
  const double top_mm = foot_mm * draws.between(0.7, 0.88);
  if (draws.chance(0.6)) {
    const BlobOutline puddle(draws, size.length_mm, size.width_mm, 0.25);
    paint_mound(painter, puddle, {draws.between(1.2, 2.2), 6.0, 0.6}, food_part(1, 0));
  }
  const auto body_mm = [&](double from_middle_mm) {
    const double wall = std::clamp((foot_mm - from_middle_mm) / (foot_mm - top_mm), 0.0, 1.0);
    return size.height_mm * (0.1 + 0.85 * wall + 0.05 * rounded_edge(top_mm - from_middle_mm, 6.0));
  };
  painter.piece({0.0, 0.0}, foot_mm, food_part(0, 0), [&](double x_mm, double y_mm) {
    const double from_middle_mm = std::hypot(x_mm, y_mm);
    return PieceColumn{body_mm(from_middle_mm), foot_mm - from_middle_mm};
  });
  if (!draws.chance(0.5)) return;
  const BlobOutline cap(draws, 1.7 * top_mm, 1.6 * top_mm, 0.3);
  painter.piece({0.0, 0.0}, cap.reach_mm(), food_part(1, 1), [&](double x_mm, double y_mm) {
    const double inside_mm = cap.inside_mm(x_mm, y_mm);
    const double from_middle_mm = std::hypot(x_mm, y_mm);
    if (inside_mm <= 0.0 || from_middle_mm >= foot_mm) return PieceColumn{};
    return PieceColumn{body_mm(from_middle_mm) + 0.9 * rounded_edge(inside_mm, 2.0), inside_mm};
  });
}

// Spears side by side, and some across on top.
void paint_asparagus(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const double radius_mm = 0.26 * size.height_mm;
  const int below = std::max(2, static_cast<int>(size.width_mm / (2.05 * radius_mm)));
  for (int i = 0; i < 2 * below - 1; ++i) {
    const bool is_above = i >= below;
    const double r = radius_mm * draws.between(0.85, 1.0);
    const double y = 2.05 * radius_mm * ((is_above ? i - below + 0.5 : i) - 0.5 * (below - 1));
    const double half_mm = 0.5 * size.length_mm * draws.between(0.85, 1.0) - r;
    const double slant = draws.between(-0.04, 0.04) * half_mm;
    const double z = is_above ? 2.55 * radius_mm : r;
    const Eigen::Vector3d from(-half_mm, y - slant, z);
    const Eigen::Vector3d to(half_mm, y + slant, z);
    painter.rod({from, from + 0.85 * (to - from), r, true}, food_part(0, i));
    Superquadric tip{from + 0.85 * (to - from), {0.3 * half_mm, 1.12 * r, 1.05 * r}};
    painter.superquadric(tip, food_part(1, i));
  }
  painter.roughen(0.4, 5.0, draws.seed(), 2);
}

// A roll with the cut of the baker's knife along it.
void paint_roll(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  Superquadric loaf{{0.0, 0.0, 0.3 * size.height_mm},
                    {0.5 * size.length_mm, 0.5 * size.width_mm, 0.7 * size.height_mm}};
  loaf.side_exponent = draws.between(2.0, 2.4);
  loaf.height_exponent = draws.between(2.0, 2.5);
  painter.superquadric(loaf, food_part(0, 0));
  const double depth_mm = draws.between(0.0, 0.12) * size.height_mm;
  const double half_mm = 0.36 * size.length_mm;
  painter.displace([=](double x_mm, double y_mm, double) {
    const double ends = std::clamp((half_mm - std::abs(x_mm)) / 8.0, 0.0, 1.0);
    return -depth_mm * ends * std::exp(-y_mm * y_mm / 18.0);
  });
  painter.roughen(0.6, 7.0, draws.seed(), 3);
}

}  // namespace traygauge
