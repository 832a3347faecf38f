// Heaps of soft food.
#include <algorithm>
#include <cmath>

#include "simulator/scenes/food_heap.hpp"
#include "simulator/scenes/food_shapes.hpp"
#include "simulator/scenes/noise.hpp"

namespace traygauge {

void paint_mash(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.18);
  paint_mound(painter, outline, {size.height_mm, draws.between(1.8, 2.4), draws.between(0.7, 1.0)},
              food_part(0, 0));
  painter.roughen(0.14 * size.height_mm, 22.0, draws.seed(), 2);
  // The furrows of a spoon.
  const double direction = draws.angle_rad();
  const double wave_mm = draws.between(9.0, 14.0);
  const std::uint32_t seed = draws.seed();
  painter.displace([=](double x_mm, double y_mm, double height_mm) {
    const Eigen::Vector3d at = Eigen::Vector3d(x_mm, y_mm, 0.0) / 18.0;
    const double bend = 5.0 * static_cast<double>(gradient_noise(at.cast<float>(), seed));
    const double along = x_mm * std::cos(direction) + y_mm * std::sin(direction) + bend;
    return 0.7 * std::min(1.0, height_mm / 8.0) * std::sin(6.28318 * along / wave_mm);
  });
  painter.roughen(0.6, 3.0, draws.seed(), 2);
}

void paint_spinach(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.25);
  paint_mound(painter, outline, {size.height_mm, 2.6, 0.7}, food_part(0, 0));
  painter.roughen(0.18 * size.height_mm, 12.0, draws.seed(), 3);
  painter.roughen(0.8, 2.5, draws.seed(), 2);
}

void paint_crumble(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.2);
  const Mound mound{size.height_mm, 1.7, 0.9};
  const int count = static_cast<int>(size.length_mm * size.width_mm * 0.6);
  heap_pieces(painter, draws, outline, mound, 1.5, food_part(0, 0), count, 0.0,
              [&](const Eigen::Vector3d& at, int piece) {
                const double r = draws.between(0.8, 4.0) * draws.between(0.5, 1.0);
                Superquadric lump{at, {r, r * draws.between(0.7, 1.0), r * draws.between(0.6, 0.9)}};
                lump.rotation = random_rotation(draws, 0.8);
                lump.centre_mm.z() = std::max(at.z() - 0.6 * r, 0.4 * r);
                painter.superquadric(lump, food_part(0, piece));
              });
  painter.roughen(0.5, 3.0, draws.seed(), 2);
}

void paint_sauce(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.25);
  paint_mound(painter, outline, {size.height_mm, 5.0, 0.8}, food_part(0, 0));
  painter.roughen(0.12 * size.height_mm, 14.0, draws.seed(), 2);
  for (const Eigen::Vector2d& place :
       scatter(draws, outline, static_cast<int>(size.length_mm * size.width_mm / 60.0), 6.0, 0.85)) {
    const double r = draws.between(2.5, 5.5);
    Superquadric lump{{place.x(), place.y(), size.height_mm - 0.45 * r}, {r, 0.8 * r, 0.7 * r}};
    lump.rotation = random_rotation(draws, 0.6);
    lump.height_exponent = 2.8;
    lump.side_exponent = 2.8;
    painter.superquadric(lump, food_part(draws.chance(0.7) ? 1 : 2, draws.whole(0, 4000)));
  }
}

void paint_smooth_liquid(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const double swirl_mm = draws.between(14.0, 26.0);
  const std::uint32_t seed = draws.seed();
  painter.displace([=](double x_mm, double y_mm, double) {
    const Eigen::Vector3d at = Eigen::Vector3d(x_mm, y_mm, 0.0) / swirl_mm;
    const double wave = static_cast<double>(fractal_noise(at.cast<float>(), seed, 2));
    return size.height_mm * std::max(0.0, wave + 0.3);
  });
}

}  // namespace traygauge
