// Heaps of pieces.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "simulator/scenes/food_heap.hpp"
#include "simulator/scenes/food_shapes.hpp"

namespace traygauge {
namespace {

// Tries for a heap of pieces with this footprint until hardly any more fit.
int tries_for(const FoodSize& size, double piece_mm2, double density) {
  return static_cast<int>(density * size.length_mm * size.width_mm / piece_mm2);
}

// The piece stands half above the heap's surface, and on the dish at the heap's edge.
void rest(Superquadric& piece, const Eigen::Vector3d& at, double sunk_fraction) {
  const double half_mm = (piece.rotation.row(2).transpose().cwiseProduct(piece.semi_mm)).norm();
  piece.centre_mm = at;
  piece.centre_mm.z() = std::max(at.z() - sunk_fraction * half_mm, 0.85 * half_mm);
}

void paint_round_heap(FoodPainter& painter, Draws& draws, const FoodSize& size, double radius_mm,
                      double spread, const Mound& mound) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.16);
  heap_pieces(painter, draws, outline, mound, 0.9 * radius_mm, food_part(1, 0),
              tries_for(size, radius_mm * radius_mm, 12.0), 1.3 * radius_mm,
              [&](const Eigen::Vector3d& at, int piece) {
                const double r = radius_mm * draws.between(1.0 - spread, 1.0 + spread);
                Superquadric pea{at, {r, r * draws.between(0.92, 1.0), r * draws.between(0.9, 1.0)}};
                pea.rotation = random_rotation(draws, 1.5);
                rest(pea, at, draws.between(0.3, 0.9));
                painter.superquadric(pea, food_part(0, piece));
              });
}

}  // namespace

void paint_peas(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  paint_round_heap(painter, draws, size, 4.0, 0.1, {size.height_mm, 2.2, 0.8});
}

void paint_rice(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.12);
  const Mound mound{size.height_mm, 2.2, 0.75};
  heap_pieces(painter, draws, outline, mound, 1.0, food_part(1, 0), tries_for(size, 1.2, 1.0), 0.0,
              [&](const Eigen::Vector3d& at, int piece) {
                Superquadric grain{at, {draws.between(2.6, 3.6), 0.95, 0.9}};
                grain.rotation = random_rotation(draws, 0.45);
                rest(grain, at, draws.between(-0.3, 1.0));
                painter.superquadric(grain, food_part(0, piece));
              });
}

void paint_diced_vegetables(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.18);
  heap_pieces(painter, draws, outline, {size.height_mm, 2.2, 0.8}, 3.0, food_part(3, 0),
              tries_for(size, 25.0, 6.0), 5.0, [&](const Eigen::Vector3d& at, int piece) {
                const int texture = draws.whole(0, 2);
                const double r = draws.between(3.4, 4.6);
                Superquadric die{at, {r, r * draws.between(0.8, 1.1), r * draws.between(0.8, 1.0)}};
                if (texture != 1) die.side_exponent = die.height_exponent = 5.0;  // 1: peas
                die.rotation = random_rotation(draws, 1.2);
                rest(die, at, draws.between(0.2, 0.9));
                painter.superquadric(die, food_part(texture, piece));
              });
}

void paint_carrot_slices(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.15);
  heap_pieces(painter, draws, outline, {size.height_mm, 2.4, 0.8}, 3.0, food_part(1, 0),
              tries_for(size, 120.0, 9.0), 9.0, [&](const Eigen::Vector3d& at, int piece) {
                const double r = draws.between(7.5, 12.5);
                Superquadric slice{at, {r, r * draws.between(0.9, 1.0), draws.between(2.0, 2.9)}};
                slice.height_exponent = 5.0;
                slice.rotation = random_rotation(draws, 0.5);
                rest(slice, at, draws.between(0.0, 0.8));
                painter.superquadric(slice, food_part(0, piece));
              });
}

void paint_meatballs(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline puddle(draws, size.length_mm, size.width_mm, 0.1);
  paint_mound(painter, puddle, {0.15 * size.height_mm, 6.0, 0.7}, food_part(1, 0));
  int piece = 0;
  for (const Eigen::Vector2d& place : scatter(draws, puddle, 400, 0.8 * size.height_mm, 0.72)) {
    const double r = 0.5 * size.height_mm * draws.between(0.88, 1.0);
    Superquadric ball{{place.x(), place.y(), 0.95 * r}, {r, r * draws.between(0.9, 1.0), r * 0.97}};
    ball.rotation = random_rotation(draws, 0.5);
    painter.superquadric(ball, food_part(0, piece++));
  }
  painter.roughen(1.0, 6.0, draws.seed(), 3);
}

void paint_potatoes(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.08);
  int piece = 0;
  for (const Eigen::Vector2d& place : scatter(draws, outline, 600, 0.84 * size.height_mm, 0.7)) {
    const double r = 0.5 * size.height_mm * draws.between(0.85, 1.0);
    Superquadric potato{{place.x(), place.y(), 0.95 * r}, {r * draws.between(1.1, 1.45), r * 1.02, r}};
    potato.rotation = random_rotation(draws, 0.25);
    potato.side_exponent = potato.height_exponent = draws.between(2.0, 2.5);
    painter.superquadric(potato, food_part(0, piece++));
  }
  painter.roughen(1.6, 14.0, draws.seed(), 2);
}

void paint_stew(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.15);
  paint_mound(painter, outline, {0.5 * size.height_mm, 3.5, 0.7}, food_part(0, 0));
  int piece = 0;
  for (const Eigen::Vector2d& place : scatter(draws, outline, 300, 12.0, 0.8)) {
    const double share = outline.share(place.x(), place.y());
    const double r = draws.between(7.0, 11.0);
    Superquadric chunk{{}, {r, r * draws.between(0.7, 1.0), r * draws.between(0.6, 0.9)}};
    chunk.side_exponent = chunk.height_exponent = draws.between(2.5, 4.0);
    chunk.rotation = random_rotation(draws, 0.7);
    chunk.centre_mm = {place.x(), place.y(), size.height_mm * (0.75 - 0.45 * share * share) - 0.5 * r};
    painter.superquadric(chunk, food_part(draws.chance(0.75) ? 1 : 2, piece++));
  }
  painter.roughen(0.9, 5.0, draws.seed(), 3);
}

void paint_beans(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.2);
  heap_pieces(painter, draws, outline, {size.height_mm, 2.6, 0.7}, 2.0, food_part(1, 0),
              tries_for(size, 30.0, 5.0), 4.5, [&](const Eigen::Vector3d& at, int piece) {
                Superquadric bean{at, {draws.between(5.5, 7.5), 3.6, 3.2}};
                bean.rotation = random_rotation(draws, 0.5);
                rest(bean, at, draws.between(0.2, 0.9));
                painter.superquadric(bean, food_part(0, piece));
              });
}

void paint_gnocchi(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.15);
  heap_pieces(painter, draws, outline, {size.height_mm, 2.4, 0.75}, 6.0, food_part(1, 0),
              tries_for(size, 150.0, 8.0), 13.0, [&](const Eigen::Vector3d& at, int piece) {
                Superquadric piece_shape{at, {draws.between(10.0, 13.0), 7.5, 7.0}};
                piece_shape.side_exponent = piece_shape.height_exponent = 2.4;
                piece_shape.rotation = random_rotation(draws, 0.5);
                rest(piece_shape, at, draws.between(0.2, 0.8));
                painter.superquadric(piece_shape, food_part(0, piece));
              });
  painter.displace([phase = draws.angle_rad()](double x_mm, double y_mm, double height_mm) {
    return 0.35 * std::min(1.0, height_mm / 6.0) * std::sin(2.6 * (0.8 * x_mm + 0.6 * y_mm) + phase);
  });
}

void paint_nuggets(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  const BlobOutline outline(draws, size.length_mm, size.width_mm, 0.1);
  heap_pieces(painter, draws, outline, {0.8 * size.height_mm, 3.0, 0.7}, 8.0, food_part(1, 0), 300, 21.0,
              [&](const Eigen::Vector3d& at, int piece) {
                Superquadric nugget{at, {draws.between(15.0, 21.0), draws.between(12.0, 15.0), 8.0}};
                nugget.side_exponent = draws.between(2.2, 3.0);
                nugget.height_exponent = 2.6;
                nugget.rotation = random_rotation(draws, 0.35);
                rest(nugget, at, draws.between(0.0, 0.5));
                painter.superquadric(nugget, food_part(0, piece));
              });
  painter.roughen(1.3, 6.0, draws.seed(), 3);
}

namespace {

// Pieces that float: their middles lie near the level of the liquid.
void float_pieces(FoodPainter& painter, Draws& draws, const FoodSize& size, int count, double radius_mm,
                  double exponent) {
  const double reach_mm = 0.5 * std::max(size.length_mm, size.width_mm);
  for (int piece = 0; piece < count; ++piece) {
    const double r = radius_mm * draws.between(0.6, 1.0);
    const double distance_mm = reach_mm * std::sqrt(draws.between(0.0, 1.0));
    const double angle = draws.angle_rad();
    Superquadric solid{{}, {r, r * draws.between(0.7, 1.0), r * draws.between(0.6, 0.95)}};
    solid.rotation = random_rotation(draws, 0.9);
    solid.side_exponent = solid.height_exponent = draws.chance(0.3) ? 2.0 : exponent;
    solid.centre_mm = {distance_mm * std::cos(angle), distance_mm * std::sin(angle),
                       size.height_mm - draws.between(0.1, 0.95) * r};
    painter.superquadric(solid, food_part(draws.whole(1, 3), piece));
  }
}

}  // namespace

void paint_vegetable_soup(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  float_pieces(painter, draws, size, static_cast<int>(size.length_mm * size.width_mm / 130.0), 5.0, 5.0);
}

void paint_chunky_soup(FoodPainter& painter, Draws& draws, const FoodSize& size) {
  float_pieces(painter, draws, size, static_cast<int>(size.length_mm * size.width_mm / 330.0), 10.0, 3.2);
}

}  // namespace traygauge
