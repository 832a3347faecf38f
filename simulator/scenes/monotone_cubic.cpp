#include "simulator/scenes/monotone_cubic.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace traygauge {
namespace {

// The slope at the first of three points, one-sided, kept within what monotone pieces allow.
double end_slope(double h0, double h1, double secant0, double secant1) {
  const double slope = ((2.0 * h0 + h1) * secant0 - h0 * secant1) / (h0 + h1);
  if (slope * secant0 <= 0.0) return 0.0;
  if (secant0 * secant1 < 0.0 && std::abs(slope) > 3.0 * std::abs(secant0)) return 3.0 * secant0;
  return slope;
}

}  // namespace

MonotoneCubic::MonotoneCubic(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)), slopes_(x_.size(), 0.0) {
  const std::size_t count = x_.size();
  if (count < 2) return;
  std::vector<double> width(count - 1);
  std::vector<double> secant(count - 1);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    width[i] = x_[i + 1] - x_[i];
    secant[i] = (y_[i + 1] - y_[i]) / width[i];
  }
  if (count == 2) {
    slopes_.assign(2, secant[0]);
    return;
  }
  for (std::size_t i = 1; i + 1 < count; ++i) {
    if (secant[i - 1] * secant[i] <= 0.0) continue;
    const double before = 2.0 * width[i] + width[i - 1];
    const double after = width[i] + 2.0 * width[i - 1];
    slopes_[i] = (before + after) / (before / secant[i - 1] + after / secant[i]);
  }
  slopes_.front() = end_slope(width[0], width[1], secant[0], secant[1]);
  slopes_.back() = end_slope(width[count - 2], width[count - 3], secant[count - 2], secant[count - 3]);
}

MonotoneCubic::Place MonotoneCubic::find(double x) const {
  if (x_.size() < 2 || x <= x_.front()) return {0, 0.0, 1.0, true};
  if (x >= x_.back()) return {x_.size() - 1, 0.0, 1.0, true};
  const auto after = std::upper_bound(x_.begin(), x_.end(), x);
  const auto piece = static_cast<std::size_t>(after - x_.begin()) - 1;
  const double width = x_[piece + 1] - x_[piece];
  return {piece, (x - x_[piece]) / width, width, false};
}

double MonotoneCubic::value(double x) const {
  const Place at = find(x);
  if (at.is_outside) return y_[at.piece];
  const double t = at.share;
  const double s = 1.0 - t;
  return s * s * ((1.0 + 2.0 * t) * y_[at.piece] + t * at.width * slopes_[at.piece]) +
         t * t * ((3.0 - 2.0 * t) * y_[at.piece + 1] - s * at.width * slopes_[at.piece + 1]);
}

double MonotoneCubic::slope(double x) const {
  const Place at = find(x);
  if (at.is_outside) return 0.0;
  const double t = at.share;
  const double s = 1.0 - t;
  return 6.0 * s * t * (y_[at.piece + 1] - y_[at.piece]) / at.width + s * (s - 2.0 * t) * slopes_[at.piece] +
         t * (t - 2.0 * s) * slopes_[at.piece + 1];
}

}  // namespace traygauge
