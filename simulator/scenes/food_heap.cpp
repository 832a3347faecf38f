#include "simulator/scenes/food_heap.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {

double Mound::at(double share) const {
  return share >= 1.0 ? 0.0 : height_mm * std::pow(1.0 - std::pow(share, steepness), rounding);
}

void paint_mound(FoodPainter& painter, const BlobOutline& outline, const Mound& mound, std::uint16_t part) {
  painter.piece({0.0, 0.0}, outline.reach_mm(), part, [&](double x_mm, double y_mm) {
    return PieceColumn{mound.at(outline.share(x_mm, y_mm)), outline.inside_mm(x_mm, y_mm)};
  });
}

std::vector<Eigen::Vector2d> scatter(Draws& draws, const BlobOutline& outline, int count, double spacing_mm,
                                     double largest_fraction) {
  std::vector<Eigen::Vector2d> places;
  const double reach = outline.reach_mm();
  for (int tries = 0; tries < count; ++tries) {
    const Eigen::Vector2d place(draws.between(-reach, reach), draws.between(-reach, reach));
    if (outline.share(place.x(), place.y()) > largest_fraction) continue;
    const auto is_near = [&](const Eigen::Vector2d& other) { return (other - place).norm() < spacing_mm; };
    if (spacing_mm > 0.0 && std::any_of(places.begin(), places.end(), is_near)) continue;
    places.push_back(place);
  }
  return places;
}

Eigen::Matrix3d random_rotation(Draws& draws, double tilt_rad) {
  const double direction = draws.angle_rad();
  const Eigen::Vector3d axis(std::cos(direction), std::sin(direction), 0.0);
  const double tilt = draws.between(-tilt_rad, tilt_rad);
  return Eigen::AngleAxisd(tilt, axis).toRotationMatrix() *
         Eigen::AngleAxisd(draws.angle_rad(), Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

void heap_pieces(FoodPainter& painter, Draws& draws, const BlobOutline& outline, const Mound& mound,
                 double filler_depth_mm, std::uint16_t filler_part, int count, double spacing_mm,
                 const PiecePainter& paint) {
  painter.piece({0.0, 0.0}, outline.reach_mm(), filler_part, [&](double x_mm, double y_mm) {
    const double share = outline.share(x_mm, y_mm);
    const double inside_mm = outline.inside_mm(x_mm, y_mm) - 1.0;
    return PieceColumn{std::max(mound.at(share) - filler_depth_mm, 0.0), inside_mm};
  });
  int piece = 0;
  for (const Eigen::Vector2d& place : scatter(draws, outline, count, spacing_mm, 0.96)) {
    paint({place.x(), place.y(), mound.at(outline.share(place.x(), place.y()))}, piece++);
  }
}

}  // namespace traygauge
