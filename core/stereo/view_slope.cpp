#include "core/stereo/view_slope.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace traygauge {
namespace {

constexpr int kRowsAround = 3;           // of a line through an outline
constexpr int kFarthestColumn = 30;      // beyond, the outline of another row is another piece's
constexpr std::size_t kLeastPoints = 3;  // a line, and one that contradicts it

// Where the label of (column, row) in `labels` ends in row `at`, going from `column` to that `side`.
std::optional<int> outline_column(ImageView<const std::uint8_t> labels, std::uint8_t label, int at,
                                  int column, int side) {
  const bool inside = labels.at(column, at) == label;
  const int step = inside ? side : -side;
  for (int i = 0; i < kFarthestColumn; ++i) {
    const int next = column + step;
    if (next < 0 || next >= labels.width) return inside ? std::optional(column) : std::nullopt;
    if ((labels.at(next, at) == label) != inside) return inside ? column : next;
    column = next;
  }
  return {};
}

}  // namespace

Vec2 RectifiedViewSlope::plane_mm(int row, int column) const {
  return grid_.plane_point(row, column).head<2>();
}

Vec2 RectifiedViewSlope::normal(int column, int side) const {
  const std::uint8_t label = labels_.at(column, row_);
  std::array<Vec2, 2 * kRowsAround + 1> points;
  std::size_t count = 0;
  Vec2 mean = Vec2::Zero();
  for (int y = std::max(row_ - kRowsAround, 0); y <= std::min(row_ + kRowsAround, labels_.height - 1); ++y) {
    const auto at = outline_column(labels_, label, y, column, side);
    if (!at) continue;
    points[count] = plane_mm(y, *at);
    mean += points[count++];
  }
  Vec2 outwards = side * grid_.row(row_).direction;
  if (count < kLeastPoints) return outwards;
  mean /= static_cast<double>(count);
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < count; ++i) scatter += (points[i] - mean) * (points[i] - mean).transpose();
  const double along = 0.5 * std::atan2(2.0 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
  const Vec2 across(-std::sin(along), std::cos(along));
  return across.dot(outwards) < 0.0 ? Vec2(-across) : across;
}

double RectifiedViewSlope::at(int column, int side) const {
  const Vec2 run = plane_mm(row_, column) - grid_.camera_mm(view_).head<2>();
  return normal(column, side).dot(run) / grid_.camera_height_mm(view_);
}

}  // namespace traygauge
