#include "core/surface/rim_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/image/resample.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kStrengths = 1024;  // of Sobel's gradient, largest component halved: at most 510 each

struct Gradient {
  int x = 0;
  int y = 0;
};

// Sobel's, on a picture that has the pixel's eight neighbours.
Gradient gradient_at(ImageView<const std::uint8_t> picture, int x, int y) {
  const std::uint8_t* above = picture.row(y - 1) + x;
  const std::uint8_t* row = picture.row(y) + x;
  const std::uint8_t* below = picture.row(y + 1) + x;
  return {above[1] + 2 * row[1] + below[1] - above[-1] - 2 * row[-1] - below[-1],
          below[-1] + 2 * below[0] + below[1] - above[-1] - 2 * above[0] - above[1]};
}

// About |gradient| / 2, without a square root: the larger component and three eighths of the smaller.
std::uint16_t strength_of(const Gradient& gradient) {
  const int a = std::abs(gradient.x);
  const int b = std::abs(gradient.y);
  return static_cast<std::uint16_t>((8 * std::max(a, b) + 3 * std::min(a, b)) / 16);
}

// Whether the edge is strongest here, looking across it.
bool is_crest(ImageView<const std::uint16_t> strength, int x, int y, const Gradient& gradient) {
  const int a = std::abs(gradient.x);
  const int b = std::abs(gradient.y);
  // Between 22.5 and 67.5 degrees the neighbours on the diagonal count.
  const int dx = 12 * a > 5 * b ? 1 : 0;
  int dy = 12 * b > 5 * a ? 1 : 0;
  if ((gradient.x < 0) != (gradient.y < 0)) dy = -dy;
  const std::uint16_t here = strength.at(x, y);
  return here > strength.at(x - dx, y - dy) && here >= strength.at(x + dx, y + dy);
}

}  // namespace

void collect_rim_edges(ImageView<const std::uint8_t> gray, const LensModel& lens, const RimEdgeParams& params,
                       RimEdgeWorkspace& workspace, BoundedList<RimEdge>& edges) {
  edges.clear();
  const double scale =
      std::min(1.0, std::sqrt(params.max_px / (static_cast<double>(gray.width) * gray.height)));
  const int width = static_cast<int>(gray.width * scale);
  const int height = static_cast<int>(gray.height * scale);
  const ImageView<std::uint8_t> picture{workspace.picture.data(), width, height};
  const ImageView<std::uint16_t> strength{workspace.strength.data(), width, height};
  if (width < 8 || height < 8) return;
  reduce_area(gray, picture);
  std::array<int, kStrengths> histogram{};
  std::fill_n(strength.data, static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
              std::uint16_t{0});
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) strength.at(x, y) = strength_of(gradient_at(picture, x, y));
  }
  const auto for_each_crest = [&](auto&& take) {
    for (int y = 2; y + 2 < height; ++y) {
      for (int x = 2; x + 2 < width; ++x) {
        if (strength.at(x, y) < params.min_difference) continue;
        const Gradient gradient = gradient_at(picture, x, y);
        if (is_crest(strength, x, y, gradient)) take(x, y, gradient);
      }
    }
  };
  for_each_crest([&](int x, int y, const Gradient&) { ++histogram[strength.at(x, y)]; });
  std::size_t least = kStrengths;
  for (int room = params.max_edges; least > 0 && room >= histogram[least - 1]; --least)
    room -= histogram[least - 1];
  const double shrink_x = static_cast<double>(gray.width) / width;
  const double shrink_y = static_cast<double>(gray.height) / height;
  for_each_crest([&](int x, int y, const Gradient& gradient) {
    if (strength.at(x, y) < least) return;
    const Vec2 along = Vec2(-gradient.y, gradient.x).normalized();
    const Vec2 pixel(scale_coordinate(x, shrink_x), scale_coordinate(y, shrink_y));
    RimEdge edge;
    if (lens.undistort_pixel(pixel, edge.ray) && lens.undistort_pixel(pixel + along, edge.along))
      edges.push_back(edge);
  });
}

}  // namespace traygauge
