#include "core/dish/dish_profile.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

// Newton's steps towards the inset double the correct digits; 1e-6 mm after five from anywhere on the wall.
constexpr double kInsetToleranceMm = 1e-6;

// One-sided slope at an end, kept monotone (Moler 3.4).
double end_slope(double h0, double h1, double delta0, double delta1) {
  const double slope = ((2.0 * h0 + h1) * delta0 - h0 * delta1) / (h0 + h1);
  if (slope * delta0 <= 0.0) return 0.0;
  if (delta0 * delta1 <= 0.0 && std::abs(slope) > 3.0 * std::abs(delta0)) return 3.0 * delta0;
  return slope;
}

}  // namespace

Status DishProfile::set(const DishModel& model) {
  *this = DishProfile{};
  semi_axes_mm_ = {0.5 * model.outer_size_mm[0], 0.5 * model.outer_size_mm[1]};
  if (!(semi_axes_mm_.minCoeff() > 0.0) || !semi_axes_mm_.allFinite() ||
      !std::isfinite(model.bottom_height_mm) || model.profile_size > kMaxDishProfilePoints) {
    return StatusCode::invalid_configuration;
  }
  bottom_height_mm_ = model.bottom_height_mm;
  crest_height_mm_ = std::max(model.rim_height_mm, bottom_height_mm_);
  double previous = -1e-9;
  for (const DishProfilePoint& point : model.profile()) {
    if (!(point.inset_mm > previous) || !(point.inset_mm < semi_axes_mm_.minCoeff()) ||
        !std::isfinite(point.height_mm)) {
      size_ = 0;
      last_inset_mm_ = 0.0;
      return StatusCode::invalid_configuration;
    }
    previous = point.inset_mm;
    knots_[size_++] = {point.inset_mm, point.height_mm, 0.0};
  }
  if (size_ == 0) return StatusCode::ok;
  crest_height_mm_ = bottom_height_mm_;
  for (std::size_t i = 0; i < size_; ++i) crest_height_mm_ = std::max(crest_height_mm_, knots_[i].height_mm);
  last_inset_mm_ = knots_[size_ - 1].inset_mm;
  set_slopes();
  return StatusCode::ok;
}

void DishProfile::set_slopes() {
  if (size_ < 2) return;
  const auto step = [this](std::size_t i) { return knots_[i + 1].inset_mm - knots_[i].inset_mm; };
  const auto chord = [&](std::size_t i) { return (knots_[i + 1].height_mm - knots_[i].height_mm) / step(i); };
  if (size_ == 2) {
    knots_[0].slope = knots_[1].slope = chord(0);
    return;
  }
  for (std::size_t i = 1; i + 1 < size_; ++i) {
    const double before = chord(i - 1);
    const double after = chord(i);
    if (before * after <= 0.0) continue;
    const double w1 = 2.0 * step(i) + step(i - 1);
    const double w2 = step(i) + 2.0 * step(i - 1);
    knots_[i].slope = (w1 + w2) / (w1 / before + w2 / after);
  }
  knots_[0].slope = end_slope(step(0), step(1), chord(0), chord(1));
  knots_[size_ - 1].slope = end_slope(step(size_ - 2), step(size_ - 3), chord(size_ - 2), chord(size_ - 3));
}

double DishProfile::inset_mm(const Vec2& dish_mm) const {
  const double x = std::abs(dish_mm.x());
  const double y = std::abs(dish_mm.y());
  const double a = semi_axes_mm_.x();
  const double b = semi_axes_mm_.y();
  if (a == b) return std::min(a - std::sqrt(x * x + y * y), last_inset_mm_);
  const double bottom_x = x / (a - last_inset_mm_);
  const double bottom_y = y / (b - last_inset_mm_);
  if (bottom_x * bottom_x + bottom_y * bottom_y <= 1.0) return last_inset_mm_;
  // The left side grows and is convex in d, so Newton's steps come down to the root from where one term alone
  // makes up the sum. The root lies below the bottom's inset, hence below both semi-axes.
  double d = std::min(a - x, b - y);
  if (d >= last_inset_mm_) d = last_inset_mm_;
  for (int i = 0; i < kMaxNewtonSteps; ++i) {
    const double u = x / (a - d);
    const double v = y / (b - d);
    const double step = (u * u + v * v - 1.0) / (2.0 * (u * u / (a - d) + v * v / (b - d)));
    d -= step;
    if (std::abs(step) < kInsetToleranceMm) break;
  }
  return d;
}

double DishProfile::height_at_inset_mm(double inset_mm) const {
  if (size_ == 0) return bottom_height_mm_;
  if (!(inset_mm > knots_[0].inset_mm)) return knots_[0].height_mm;
  std::size_t i = 1;
  while (i < size_ && knots_[i].inset_mm < inset_mm) ++i;
  if (i == size_) return knots_[size_ - 1].height_mm;
  const Knot& from = knots_[i - 1];
  const Knot& to = knots_[i];
  const double h = to.inset_mm - from.inset_mm;
  const double s = inset_mm - from.inset_mm;
  const double chord = (to.height_mm - from.height_mm) / h;
  const double square = (3.0 * chord - 2.0 * from.slope - to.slope) / h;
  const double cube = (from.slope - 2.0 * chord + to.slope) / (h * h);
  return from.height_mm + s * (from.slope + s * (square + s * cube));
}

}  // namespace traygauge
