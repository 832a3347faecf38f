// A grey picture at full, half and quarter size.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/image/pyramid.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

inline constexpr std::size_t kPyramidLevels = 3;  // the stored picture, half and a quarter of its size

// Levels of one picture; level 0 is the caller's.
struct GrayPyramid {
  std::array<ImageView<const std::uint8_t>, kPyramidLevels> levels;
};

// Where a coordinate of the stored picture lies at a level: pixel centres lie at integers.
constexpr double to_level(double stored, std::size_t level) {
  return (stored + 0.5) / static_cast<double>(1U << level) - 0.5;
}
constexpr double from_level(double coordinate, std::size_t level) {
  return (coordinate + 0.5) * static_cast<double>(1U << level) - 0.5;
}

// The coarsest level at which `length_px` of the stored picture still has `least_px`.
constexpr std::size_t level_of(double length_px, double least_px) {
  std::size_t level = 0;
  while (level + 1 < kPyramidLevels && length_px >= least_px * static_cast<double>(2U << level)) ++level;
  return level;
}

struct PyramidWorkspace {
  std::array<std::span<std::uint8_t>, kPyramidLevels - 1> storage;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_width, int max_height) {
    for (std::span<std::uint8_t>& level : storage) {
      max_width = halved(max_width);
      max_height = halved(max_height);
      level = arena.template take<std::uint8_t>(static_cast<std::size_t>(max_width) *
                                                static_cast<std::size_t>(max_height));
    }
  }
};

// The levels of `gray`, which must be no larger than the workspace was made for.
inline GrayPyramid build_pyramid(ImageView<const std::uint8_t> gray, const PyramidWorkspace& workspace) {
  GrayPyramid pyramid;
  pyramid.levels[0] = gray;
  for (std::size_t level = 1; level < kPyramidLevels; ++level) {
    const ImageView<const std::uint8_t> finer = pyramid.levels[level - 1];
    const ImageView<std::uint8_t> coarser{workspace.storage[level - 1].data(), halved(finer.width),
                                          halved(finer.height)};
    halve(finer, coarser);
    pyramid.levels[level] = coarser;
  }
  return pyramid;
}

}  // namespace traygauge
