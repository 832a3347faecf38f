#include "core/segmentation/components.hpp"

#include "core/segmentation/neighbours.hpp"

namespace traygauge {

std::span<const std::int32_t> Components::repaint(int start, std::uint8_t value) {
  const std::uint8_t old = cells_.data[start];
  const int width = cells_.width;
  const int count = width * cells_.height;
  std::size_t size = 0;
  const auto take = [&](int cell) {
    if (cells_.data[cell] != old) return;
    cells_.data[cell] = value;
    queue_[size++] = cell;
  };
  if (old == value) return {};
  take(start);
  for (std::size_t i = 0; i < size; ++i) for_each_neighbour(queue_[i], width, count, take);
  return queue_.first(size);
}

bool drop_small(ImageView<std::uint8_t> cells, std::uint8_t from, std::uint8_t to, double min_cells,
                std::span<std::int32_t> queue) {
  Components components(cells, queue);
  const int count = cells.width * cells.height;
  bool is_any_left = false;
  for (int cell = 0; cell < count; ++cell) {
    if (cells.data[cell] != from) continue;
    const auto visited = components.repaint(cell, kVisited);
    if (static_cast<double>(visited.size()) >= min_cells) {
      is_any_left = true;
      continue;
    }
    for (const std::int32_t i : visited) cells.data[i] = to;
  }
  for (int cell = 0; cell < count; ++cell) {
    if (cells.data[cell] == kVisited) cells.data[cell] = from;
  }
  return is_any_left;
}

void spread_through(ImageView<std::uint8_t> cells, std::uint8_t from, std::uint8_t through,
                    std::span<std::int32_t> queue) {
  const int count = cells.width * cells.height;
  std::size_t size = 0;
  for (int cell = 0; cell < count; ++cell) {
    if (cells.data[cell] == from) queue[size++] = cell;
  }
  for (std::size_t i = 0; i < size; ++i) {
    for_each_neighbour(queue[i], cells.width, count, [&](int cell) {
      if (cells.data[cell] != through) return;
      cells.data[cell] = from;
      queue[size++] = cell;
    });
  }
}

}  // namespace traygauge
