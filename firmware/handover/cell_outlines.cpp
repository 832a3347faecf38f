#include "firmware/handover/cell_outlines.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace traygauge {
namespace {

// Sides of cells; a square of three by three cells, which no eye sees as food, has 12.
constexpr std::size_t kShortestWay = 13;

// Between corners of cells; corner (x, y) is the lower left one of cell (x, y).
enum Direction : std::uint8_t { right, up, left, down };
constexpr int kDirections = 4;
constexpr std::array<std::array<int, 2>, kDirections> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

constexpr Direction turned(Direction direction, int quarters) {
  return static_cast<Direction>((direction + quarters + kDirections) % kDirections);
}

class BorderWalk {
 public:
  BorderWalk(const HeightMap& map, std::uint8_t label)
      : map_(map),
        label_(label),
        columns_(map.cells.width + 1),
        was_here_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(map.cells.height + 1)) {}

  std::vector<Outline> walk() {
    std::vector<Outline> outlines;
    for (int y = 0; y < map_.cells.height; ++y) {
      for (int x = 0; x < map_.cells.width; ++x) {
        // Every border has a side along which it goes right.
        if (!is_border(x, y, right) || mark(x, y)) continue;
        Outline outline = walk_from(x, y);
        if (outline.size() >= kShortestWay) outlines.push_back(std::move(outline));
      }
    }
    return outlines;
  }

 private:
  bool has_label(int x, int y) const {
    return x >= 0 && y >= 0 && x < map_.cells.width && y < map_.cells.height &&
           map_.cells.at(x, y).label == label_;
  }

  // Whether the side that leaves the corner in that direction has the label on its left alone.
  bool is_border(int x, int y, Direction direction) const {
    switch (direction) {
      case right:
        return has_label(x, y) && !has_label(x, y - 1);
      case up:
        return has_label(x - 1, y) && !has_label(x, y);
      case left:
        return has_label(x - 1, y - 1) && !has_label(x - 1, y);
      case down:
        return has_label(x, y - 1) && !has_label(x - 1, y - 1);
    }
    return false;
  }

  // Of the side that leaves the corner to the right; true where it was walked before.
  bool mark(int x, int y) {
    const auto index =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
    const bool was_here = was_here_[index];
    was_here_[index] = true;
    return was_here;
  }

  // The middles of the sides: a staircase becomes a slope.
  Outline walk_from(int begin_x, int begin_y) {
    Outline outline;
    int x = begin_x;
    int y = begin_y;
    Direction direction = right;
    do {
      if (direction == right) mark(x, y);
      const auto [step_x, step_y] = kSteps[direction];
      outline.push_back(map_.origin_mm + map_.cell_mm * Vec2(x + 0.5 * step_x - 0.5, y + 0.5 * step_y - 0.5));
      x += step_x;
      y += step_y;
      // To the left first: cells that touch at a corner alone are apart.
      direction = turned(direction, 1);
      while (!is_border(x, y, direction)) direction = turned(direction, -1);
    } while (x != begin_x || y != begin_y || direction != right);
    return outline;
  }

  const HeightMap& map_;
  std::uint8_t label_;
  int columns_;
  std::vector<bool> was_here_;
};

double distance_mm(const Vec2& point, const Vec2& begin, const Vec2& end) {
  const Vec2 way = end - begin;
  const double length = way.norm();
  if (length == 0.0) return (point - begin).norm();
  return std::abs(way.x() * (point - begin).y() - way.y() * (point - begin).x()) / length;
}

// Leaves out points that lie so near to the line between those that stay (Douglas & Peucker 1973).
Outline simplified(const Outline& outline, double tolerance_mm) {
  std::vector<bool> stays(outline.size());
  const std::size_t middle = outline.size() / 2;
  const std::size_t last = outline.size() - 1;
  stays[0] = stays[middle] = stays[last] = true;
  std::vector<std::pair<std::size_t, std::size_t>> pieces{{0, middle}, {middle, last}};
  while (!pieces.empty()) {
    const auto [begin, end] = pieces.back();
    pieces.pop_back();
    double farthest_mm = tolerance_mm;
    std::size_t farthest = begin;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double d = distance_mm(outline[i], outline[begin], outline[end]);
      if (d <= farthest_mm) continue;
      farthest_mm = d;
      farthest = i;
    }
    if (farthest == begin) continue;
    stays[farthest] = true;
    pieces.emplace_back(begin, farthest);
    pieces.emplace_back(farthest, end);
  }
  Outline kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (stays[i]) kept.push_back(outline[i]);
  }
  return kept;
}

}  // namespace

std::vector<Outline> outline_label(const HeightMap& map, std::uint8_t label, double tolerance_mm) {
  std::vector<Outline> outlines = BorderWalk(map, label).walk();
  for (Outline& outline : outlines) outline = simplified(outline, tolerance_mm);
  return outlines;
}

}  // namespace traygauge
