#include "core/dish/rim_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/image/resample.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kStrengths = 1024;  // of Sobel's gradient, largest component halved: at most 510 each
constexpr int kStrengthBits = kStrengths - 1;
constexpr std::uint16_t kCrestBit = kStrengths;

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

// Whether the edge is strongest here, looking across it.
bool is_crest(ImageView<const std::uint16_t> strength, int x, int y, const Gradient& gradient) {
  const int a = std::abs(gradient.x);
  const int b = std::abs(gradient.y);
  // Between 22.5 and 67.5 degrees the neighbours on the diagonal count.
  const int dx = 12 * a > 5 * b ? 1 : 0;
  int dy = 12 * b > 5 * a ? 1 : 0;
  if ((gradient.x < 0) != (gradient.y < 0)) dy = -dy;
  const int here = strength.at(x, y);
  return here > (strength.at(x - dx, y - dy) & kStrengthBits) &&
         here >= (strength.at(x + dx, y + dy) & kStrengthBits);
}

// About |gradient| / 2, without a square root: the larger component and three eighths of the smaller. 0 along
// the border. Written for the vectoriser.
void rate_row(ImageView<const std::uint8_t> picture, int y, std::uint16_t* __restrict strength) {
  const std::uint8_t* __restrict above = picture.row(y - 1);
  const std::uint8_t* __restrict row = picture.row(y);
  const std::uint8_t* __restrict below = picture.row(y + 1);
  for (int x = 1; x + 1 < picture.width; ++x) {
    const auto across = static_cast<std::int16_t>(
        (above[x + 1] - above[x - 1]) + 2 * (row[x + 1] - row[x - 1]) + (below[x + 1] - below[x - 1]));
    const auto down = static_cast<std::int16_t>((below[x - 1] - above[x - 1]) + 2 * (below[x] - above[x]) +
                                                (below[x + 1] - above[x + 1]));
    const auto a = static_cast<std::int16_t>(across < 0 ? -across : across);
    const auto b = static_cast<std::int16_t>(down < 0 ? -down : down);
    const std::int16_t larger = a > b ? a : b;
    const std::int16_t smaller = a > b ? b : a;
    strength[x] = static_cast<std::uint16_t>((8 * larger + 3 * smaller) >> 4);
  }
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
  for (int y = 1; y + 1 < height; ++y) rate_row(picture, y, strength.row(y));
  for (int y = 2; y + 2 < height; ++y) {
    for (int x = 2; x + 2 < width; ++x) {
      std::uint16_t& here = strength.at(x, y);
      if (here < params.min_difference || !is_crest(strength, x, y, gradient_at(picture, x, y))) continue;
      ++histogram[here];
      here |= kCrestBit;
    }
  }
  std::size_t least = kStrengths;
  for (int room = params.max_edges; least > 0 && room >= histogram[least - 1]; --least)
    room -= histogram[least - 1];
  const double shrink_x = static_cast<double>(gray.width) / width;
  const double shrink_y = static_cast<double>(gray.height) / height;
  const auto weakest = static_cast<std::uint16_t>(least + kCrestBit);
  for (int y = 2; y + 2 < height; ++y) {
    for (int x = 2; x + 2 < width; ++x) {
      if (strength.at(x, y) < weakest) continue;
      const Gradient gradient = gradient_at(picture, x, y);
      const Vec2 along = Vec2(-gradient.y, gradient.x).normalized();
      const Vec2 pixel(scale_coordinate(x, shrink_x), scale_coordinate(y, shrink_y));
      RimEdge edge;
      if (lens.undistort_pixel(pixel, edge.ray) && lens.undistort_pixel(pixel + along, edge.along))
        edges.push_back(edge);
    }
  }
}

}  // namespace traygauge
