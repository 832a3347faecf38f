#include "simulator/scenes/food_painter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "simulator/scenes/noise.hpp"

namespace traygauge {
namespace {

constexpr int kSearchSteps = 28;  // golden section, for the least value along a line: to 1e-6 of its span
constexpr int kRootSteps = 30;
constexpr double kSurelyInside = 0.8;  // a gauge below needs no least value
constexpr double kToleranceMm = 1e-4;
constexpr double kMarginMm = 0.8;  // around a piece, where its border is interpolated

PieceColumn ellipsoid_column(const Superquadric& piece, const Eigen::Vector3d& at,
                             const Eigen::Vector3d& up) {
  const Eigen::Vector3d p = at.cwiseQuotient(piece.semi_mm);
  const Eigen::Vector3d v = up.cwiseQuotient(piece.semi_mm);
  const double a = v.squaredNorm();
  const double b = p.dot(v);
  const double nearest = p.squaredNorm() - b * b / a;  // squared, of the vertical line to the middle
  const double inside_mm = (1.0 - std::sqrt(std::max(nearest, 0.0))) * piece.semi_mm.minCoeff();
  if (nearest >= 1.0) return {0.0, inside_mm};
  return {(-b + std::sqrt(b * b - a * (p.squaredNorm() - 1.0))) / a, inside_mm};
}

// The gauge of a superquadric, how much larger the one through a point of its own axes is (1 on its surface),
// to the power of its height_exponent: in the same order, and a power less.
double gauge_power(const Superquadric& piece, const Eigen::Vector3d& at) {
  const Eigen::Vector3d p = at.cwiseQuotient(piece.semi_mm).cwiseAbs();
  const double n = piece.height_exponent;
  const double side =
      piece.side_exponent == n
          ? std::pow(p.x(), n) + std::pow(p.y(), n)
          : std::pow(std::pow(p.x(), piece.side_exponent) + std::pow(p.y(), piece.side_exponent),
                     n / piece.side_exponent);
  return side + std::pow(p.z(), n);
}

// The part of a vertical line, from its height above the piece's middle, within a box that is a little
// larger.
struct Span {
  double low = -1e9;
  double high = 1e9;
};
Span span_in_box(const Superquadric& piece, const Eigen::Vector3d& at, const Eigen::Vector3d& up) {
  Span span;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double half = piece.semi_mm[axis] + kMarginMm;
    if (std::abs(up[axis]) < 1e-9) {
      if (std::abs(at[axis]) > half) return {1.0, -1.0};
      continue;
    }
    const double one = (-half - at[axis]) / up[axis];
    const double other = (half - at[axis]) / up[axis];
    span.low = std::max(span.low, std::min(one, other));
    span.high = std::min(span.high, std::max(one, other));
  }
  return span;
}

struct Point {
  double at;
  double value;
};

// Golden section between `low` and `high`, until a value is below `enough`. The function falls and rises
// again.
template <class Function>
Point least_between(double low, double high, double enough, const Function& function) {
  constexpr double kKept = std::numbers::phi - 1.0;
  const auto point = [&](double at) { return Point{at, function(at)}; };
  Point left = point(high - kKept * (high - low));
  Point right = point(low + kKept * (high - low));
  for (int i = 0; i < kSearchSteps && std::min(left.value, right.value) >= enough; ++i) {
    if (left.value < right.value) {
      high = right.at;
      right = left;
      left = point(high - kKept * (high - low));
    } else {
      low = left.at;
      left = right;
      right = point(low + kKept * (high - low));
    }
  }
  return left.value < right.value ? left : right;
}

PieceColumn general_column(const Superquadric& piece, const Eigen::Vector3d& at, const Eigen::Vector3d& up) {
  const auto power = [&](double z) { return gauge_power(piece, at + z * up); };
  const auto gauge = [&](double of_power) { return std::pow(of_power, 1.0 / piece.height_exponent); };
  const auto value = [&](double z) { return gauge(power(z)); };
  const auto [bottom, top] = span_in_box(piece, at, up);
  if (bottom > top) return {0.0, -kMarginMm};
  // The body is convex: along the line the gauge falls to a least value and rises again.
  const double enough = std::pow(kSurelyInside, piece.height_exponent);
  const auto [deepest, least_power] = least_between(bottom, top, enough, power);
  const double least = gauge(least_power);
  const double inside_mm = (1.0 - least) * piece.semi_mm.minCoeff();
  if (least >= 1.0) return {0.0, inside_mm};
  // False position (Illinois) between a point inside and the top of the box.
  double below = deepest;
  double above = top;
  double below_value = least - 1.0;
  double above_value = value(above) - 1.0;
  for (int i = 0; i < kRootSteps && above - below > kToleranceMm; ++i) {
    const double middle = (below * above_value - above * below_value) / (above_value - below_value);
    const double middle_value = value(middle) - 1.0;
    if (std::abs(middle_value) < kToleranceMm / piece.semi_mm.maxCoeff()) return {middle, inside_mm};
    if (middle_value < 0.0) {
      below = middle;
      below_value = middle_value;
      above_value *= 0.5;
    } else {
      above = middle;
      above_value = middle_value;
      below_value *= 0.5;
    }
  }
  return {0.5 * (below + above), inside_mm};
}

}  // namespace

BlobOutline::BlobOutline(Draws& draws, double length_mm, double width_mm, double irregularity)
    : semi_x_mm_(0.5 * length_mm), semi_y_mm_(0.5 * width_mm) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kWaves; ++i) {
    const auto wave = static_cast<double>(i + 2);
    size_[i] = irregularity * draws.between(-1.0, 1.0) / wave;
    phase_rad_[i] = draws.angle_rad();
    sum += std::abs(size_[i]);
  }
  reach_mm_ = std::max(semi_x_mm_, semi_y_mm_) * (1.0 + sum);
}

double BlobOutline::radius_mm(double angle_rad) const {
  const double c = std::cos(angle_rad) / semi_x_mm_;
  const double s = std::sin(angle_rad) / semi_y_mm_;
  double factor = 1.0;
  for (std::size_t i = 0; i < kWaves; ++i)
    factor += size_[i] * std::cos(static_cast<double>(i + 2) * angle_rad + phase_rad_[i]);
  return factor / std::hypot(c, s);
}

double BlobOutline::share(double x_mm, double y_mm) const {
  return std::hypot(x_mm, y_mm) / radius_mm(std::atan2(y_mm, x_mm));
}

double BlobOutline::inside_mm(double x_mm, double y_mm) const {
  return radius_mm(std::atan2(y_mm, x_mm)) - std::hypot(x_mm, y_mm);
}

FoodPainter::FoodPainter(HeightField& field, Eigen::Vector2d centre_mm, double rotation_deg)
    : field_(field), centre_mm_(std::move(centre_mm)) {
  turn_ = Eigen::Rotation2Dd(rotation_deg * std::numbers::pi / 180.0).toRotationMatrix();
}

void FoodPainter::superquadric(const Superquadric& piece, std::uint16_t part) {
  const Eigen::Matrix3d to_own = piece.rotation.transpose();
  const Eigen::Vector3d up = to_own.col(2);
  const bool is_ellipsoid = piece.side_exponent == 2.0 && piece.height_exponent == 2.0;
  // How far the corners of its box stand from its middle in plan.
  const Eigen::Vector3d extent = piece.rotation.cwiseAbs() * piece.semi_mm;
  const double reach_mm = std::max(extent.x(), extent.y());
  this->piece(piece.centre_mm.head<2>(), reach_mm * std::numbers::sqrt2, part, [&](double x_mm, double y_mm) {
    const Eigen::Vector3d at =
        to_own * Eigen::Vector3d(x_mm - piece.centre_mm.x(), y_mm - piece.centre_mm.y(), 0.0);
    PieceColumn column = is_ellipsoid ? ellipsoid_column(piece, at, up) : general_column(piece, at, up);
    column.top_mm += piece.centre_mm.z();
    return column;
  });
}

void FoodPainter::rod(const Rod& rod, std::uint16_t part) {
  const Eigen::Vector2d from = rod.from_mm.head<2>();
  const Eigen::Vector2d along = rod.to_mm.head<2>() - from;
  const double length_mm = std::max(along.norm(), 1e-6);
  const double rise = (rod.to_mm.z() - rod.from_mm.z()) / length_mm;
  const double upright = std::sqrt(1.0 + rise * rise);  // a section that is not level is taller
  piece(from + 0.5 * along, 0.5 * length_mm + rod.radius_mm, part, [&](double x_mm, double y_mm) {
    const Eigen::Vector2d offset = Eigen::Vector2d(x_mm, y_mm) - from;
    const double at_mm = offset.dot(along) / length_mm;
    const double kept_mm = std::clamp(at_mm, 0.0, length_mm);
    const double beyond_mm = at_mm - kept_mm;
    const double beside_mm = (offset.x() * along.y() - offset.y() * along.x()) / length_mm;
    const double off_mm = rod.has_round_ends ? std::hypot(beside_mm, beyond_mm) : std::abs(beside_mm);
    double inside_mm = rod.radius_mm - off_mm;
    if (!rod.has_round_ends)
      inside_mm = std::min(inside_mm, -std::abs(beyond_mm) + std::min(at_mm, length_mm - at_mm));
    const double bulge_mm = std::sqrt(std::max(0.0, rod.radius_mm * rod.radius_mm - off_mm * off_mm));
    return PieceColumn{rod.from_mm.z() + rise * kept_mm + upright * bulge_mm, inside_mm};
  });
}

void FoodPainter::roughen(double amplitude_mm, double size_mm, std::uint32_t seed, int octaves) {
  displace([&](double x_mm, double y_mm, double height_mm) {
    const Eigen::Vector3d at = Eigen::Vector3d(x_mm, y_mm, height_mm) / size_mm;
    const double share = std::min(1.0, height_mm / (2.0 * amplitude_mm));
    return share * amplitude_mm * static_cast<double>(fractal_noise(at.cast<float>(), seed, octaves));
  });
}

}  // namespace traygauge
