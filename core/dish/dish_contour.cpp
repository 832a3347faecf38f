#include "core/dish/dish_contour.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

namespace traygauge {
namespace {

struct ContourStep {
  int x = 0;
  int y = 0;
};

// Clockwise: up, right, down, left.
constexpr std::array<ContourStep, 4> kSteps{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
// The pixels right and left of a step that leaves the corner (x, y), which is the top left one of pixel (x,
// y).
constexpr std::array<ContourStep, 4> kRightPixels{{{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};
constexpr std::array<ContourStep, 4> kLeftPixels{{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};

class BorderWalk {
 public:
  BorderWalk(ImageView<const std::uint8_t> labels, const LabelSet& on_dish, DishContour& contour)
      : labels_(labels), on_dish_(on_dish), contour_(contour) {}

  bool is_dish(int x, int y) const { return labels_.contains(x, y) && on_dish_.contains(labels_.at(x, y)); }

  // Walks around the region from the left side of a dish pixel. Returns the enclosed area in pixels, negative
  // around a hole. Pixels that touch at a corner only count as separate.
  double walk_around(int start_x, int start_y) {
    contour_.sides.clear();
    int x = start_x;
    int y = start_y + 1;
    std::size_t heading = 0;
    double twice_area = 0.0;
    do {
      const ContourStep step = kSteps[heading];
      if (!add_side(x, y, heading)) return 0.0;
      twice_area += x * step.y - y * step.x;
      x += step.x;
      y += step.y;
      heading = turn(x, y, heading);
    } while (x != start_x || y != start_y + 1 || heading != 0);
    return 0.5 * twice_area;
  }

 private:
  bool add_side(int x, int y, std::size_t heading) {
    const ContourStep step = kSteps[heading];
    const ContourStep outside{x + kLeftPixels[heading].x, y + kLeftPixels[heading].y};
    const ContourStep inside{x + kRightPixels[heading].x, y + kRightPixels[heading].y};
    const bool against_table =
        labels_.contains(outside.x, outside.y) && labels_.at(outside.x, outside.y) == kBackgroundLabel;
    return contour_.sides.push_back({static_cast<float>(x) - 0.5F + 0.5F * static_cast<float>(step.x),
                                     static_cast<float>(y) - 0.5F + 0.5F * static_cast<float>(step.y),
                                     against_table, labels_.at(inside.x, inside.y)});
  }

  std::size_t turn(int x, int y, std::size_t heading) const {
    if (!is_dish(x + kRightPixels[heading].x, y + kRightPixels[heading].y)) return (heading + 1) % 4;
    if (is_dish(x + kLeftPixels[heading].x, y + kLeftPixels[heading].y)) return (heading + 3) % 4;
    return heading;
  }

  ImageView<const std::uint8_t> labels_;
  const LabelSet& on_dish_;
  DishContour& contour_;
};

int count_in_row(ImageView<const std::uint8_t> labels, const LabelSet& on_dish, int y, int step) {
  const std::uint8_t* row = labels.row(y);
  int count = 0;
  for (int x = 0; x < labels.width; x += step) count += on_dish.contains(row[x]) ? 1 : 0;
  return count;
}

struct DishPixels {
  double count = 0.0;
  int median_row = 0;
};

DishPixels measure_pixels(ImageView<const std::uint8_t> labels, const LabelSet& on_dish, int step) {
  int sampled = 0;
  for (int y = 0; y < labels.height; y += step) sampled += count_in_row(labels, on_dish, y, step);
  int above = 0;
  int y = 0;
  for (; y < labels.height; y += step) {
    above += count_in_row(labels, on_dish, y, step);
    if (2 * above >= sampled) break;
  }
  return {static_cast<double>(sampled) * step * step, y};
}

}  // namespace

Status trace_dish_contour(ImageView<const std::uint8_t> labels, const LabelSet& on_dish, int search_step,
                          DishContour& contour) {
  contour.sides.clear();
  const DishPixels dish = measure_pixels(labels, on_dish, search_step);
  if (dish.count == 0.0) return StatusCode::no_dish_label;
  BorderWalk walk(labels, on_dish, contour);
  bool is_list_full = false;
  // A connected region that holds most of the pixels has some on both sides of their median row.
  for (int x = 0; x < labels.width; ++x) {
    if (!walk.is_dish(x, dish.median_row) || walk.is_dish(x - 1, dish.median_row)) continue;
    const double area = walk.walk_around(x, dish.median_row);
    if (area > 0.5 * dish.count) return StatusCode::ok;
    is_list_full = is_list_full || contour.sides.full();
  }
  contour.sides.clear();
  return is_list_full ? StatusCode::out_of_memory : StatusCode::no_dish_label;
}

Status trace_dish_contour(ImageView<const std::uint8_t> labels, DishContour& contour) {
  return trace_dish_contour(labels, labels_of_single_dish(), 1, contour);
}

bool fit_contour_curve(const DishContour& contour, std::size_t index, const ContourFitParams& params,
                       ContourCurve& curve) {
  const std::size_t size = contour.sides.size();
  const auto radius = static_cast<std::size_t>(params.radius_sides);
  if (size < 4 * radius) return false;
  const auto neighbour = [&](std::size_t k) { return (index + size + k - radius) % size; };
  curve.origin = contour.place(index);
  curve.tangent = (contour.place(neighbour(2 * radius)) - contour.place(neighbour(0))).normalized();
  curve.inward = Vec2(-curve.tangent.y(), curve.tangent.x());

  Mat3 normal_matrix = Mat3::Zero();
  Vec3 right_side = Vec3::Zero();
  double squares = 0.0;
  for (std::size_t k = 0; k <= 2 * radius; ++k) {
    if (!contour.sides[neighbour(k)].against_table) return false;
    const Vec2 offset = contour.place(neighbour(k)) - curve.origin;
    const double u = curve.tangent.dot(offset);
    const double v = curve.inward.dot(offset);
    const Vec3 powers(1.0, u, u * u);
    normal_matrix += powers * powers.transpose();
    right_side += v * powers;
    squares += v * v;
  }
  curve.coefficients = normal_matrix.ldlt().solve(right_side);
  const double rest = squares - curve.coefficients.dot(right_side);
  curve.rms_px = std::sqrt(std::fmax(0.0, rest) / static_cast<double>(2 * radius + 1));
  return curve.rms_px <= params.max_rms_px;
}

}  // namespace traygauge
