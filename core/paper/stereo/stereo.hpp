// Dense matching of a rectified pair: census, square window, hierarchical dynamic programming with a
// smoothness that falls with the local variance, median (paper III-B-2; [32] census, [34] hierarchical
// dynamic programming).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/image/pyramid.hpp"
#include "core/image_view/image_view.hpp"
#include "core/paper/stereo/aggregation.hpp"
#include "core/paper/stereo/dynamic_programming.hpp"
#include "core/paper/stereo/hierarchy.hpp"
#include "core/paper/stereo/local_cost.hpp"
#include "core/paper/stereo/stereo_params.hpp"
#include "core/paper/stereo/zncc.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge::paper {

// A rectified pair at one level.
struct StereoPair {
  ImageView<const std::uint8_t> first;
  ImageView<const std::uint8_t> first_mask;
  ImageView<const std::uint8_t> second;
  ImageView<const std::uint8_t> second_mask;
};

struct StereoWorkspace {
  struct Level {
    ImageView<std::uint8_t> first, first_mask, second, second_mask;
    ImageView<Disparity> disparity;
  };
  std::array<Level, kMaxLevels> coarser{};  // [l] is level l; level 0 are the caller's pictures
  ImageView<Disparity> unfiltered;          // a level's disparities before the median
  MatchingBlock block;
  WindowSums sums;
  CorrelationWorkspace correlation;
  PathStates states;
  std::span<CostLanes> smoothness;
  std::span<CostLanes> paths;
  int max_columns = 0;
  int max_rows = 0;
  int max_disparities = 0;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int columns, int rows, int disparities,
                          const StereoParams& params) {
    max_columns = columns;
    max_rows = rows;
    max_disparities = disparities;
    int width = columns;
    int height = rows;
    for (int level = 1; level < params.levels && level < kMaxLevels; ++level) {
      width = halved(width);
      height = halved(height);
      Level& pictures = coarser[static_cast<std::size_t>(level)];
      pictures.first = arena.template take_image<std::uint8_t>(width, height);
      pictures.first_mask = arena.template take_image<std::uint8_t>(width, height);
      pictures.second = arena.template take_image<std::uint8_t>(width, height);
      pictures.second_mask = arena.template take_image<std::uint8_t>(width, height);
      pictures.disparity = arena.template take_image<Disparity>(width, height);
    }
    unfiltered = arena.template take_image<Disparity>(columns, rows);
    block.allocate(arena, columns, params);
    sums.allocate(arena, disparities);
    if (params.cost == MatchingCost::zncc) correlation.allocate(arena, columns);
    states.allocate(arena, columns, disparities);
    smoothness = arena.template take<CostLanes>(static_cast<std::size_t>(columns));
    paths = arena.template take<CostLanes>(static_cast<std::size_t>(columns));
  }
};

// Disparity of each pixel of `first` whose mask is set; kNoDisparity elsewhere, and where the whole range
// falls outside `second_mask`. Equal row counts; widths may differ. out_of_memory when the pictures exceed
// the workspace, disparity_range_too_large likewise.
Status match_dense(ImageView<const std::uint8_t> first, ImageView<const std::uint8_t> first_mask,
                   ImageView<const std::uint8_t> second, ImageView<const std::uint8_t> second_mask,
                   DisparityRange range, const StereoParams& params, StereoWorkspace& workspace,
                   ImageView<Disparity> disparity);

}  // namespace traygauge::paper
