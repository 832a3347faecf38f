// The visible surface of one dish from two views whose poses in the table frame are known: both views sampled
// over the dish's bottom, matched from coarse to fine, each as reference, refined on the surface found, and
// triangulated.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/image/pyramid.hpp"
#include "core/stereo/consistency.hpp"
#include "core/stereo/occlusion_filling.hpp"
#include "core/stereo/plane_rectification.hpp"
#include "core/stereo/sgm.hpp"
#include "core/stereo/subpixel_refinement.hpp"
#include "core/stereo/surface_grid.hpp"

namespace traygauge {

inline constexpr int kMaxSurfaceLevels =
    3;  // kMaxBandLanes disparities of the coarsest are 256 of the finest

struct DenseStereoParams {
  PlaneRectificationParams rectification;
  int max_columns = 896;           // of the grid, that row buffers are kept for
  int levels = kMaxSurfaceLevels;  // or fewer; the coarsest searches all heights, finer ones a band of
                                   // kBandLanes disparities about the level before
  double min_height_mm = -2.0;     // below the bottom: the pose's error, and the table beside the dish
  double highest_mm = 150.0;       // above the bottom; what is higher comes out low
  SgmParams sgm;
  OcclusionParams gaps;
  SubpixelRefinementParams refinement;
};

// Of a level at most; halving rounds up.
constexpr int max_level_samples(const DenseStereoParams& params, int level) {
  const int samples = params.rectification.max_samples >> (2 * level);
  return level == 0 ? samples : samples + ((params.max_columns + params.rectification.max_rows) >> level) + 2;
}

struct DenseStereoWorkspace {
  struct View {
    std::array<ImageView<std::uint8_t>, kMaxSurfaceLevels> gray;  // memory of the caps; sizes as sampled
    std::array<ImageView<std::uint8_t>, kMaxSurfaceLevels> labels;
    std::span<std::uint8_t> gray_storage;
    std::span<std::uint8_t> label_storage;
    std::span<std::uint32_t> codes;
    std::span<Disparity> disparity;
    std::span<Disparity> consistent;
    std::span<float> surface;
    std::span<std::uint8_t> trusted;
    std::span<SurfaceEvidence> evidence;
    std::span<SurfacePoint> points;
  };
  std::array<View, 2> views;
  std::span<PlaneRow> rows;
  std::span<std::int16_t> first_disparity;
  std::span<std::uint32_t> census_mask;
  SgmWorkspace sgm;
  SubpixelRefinementWorkspace refinement;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const DenseStereoParams& params) {
    allocate(arena, params, [] {});
  }
  // `later` takes from the same arena what works on the grids: it lies where the matching has lain.
  template <class Allocator, class Later>
  constexpr void allocate(Allocator& arena, const DenseStereoParams& params, const Later& later) {
    const auto samples = static_cast<std::size_t>(params.rectification.max_samples);
    std::size_t pyramid = 0;
    for (int level = 0; level < params.levels; ++level)
      pyramid += static_cast<std::size_t>(max_level_samples(params, level));
    for (View& view : views) {
      view.gray_storage = arena.template take<std::uint8_t>(pyramid);
      view.label_storage = arena.template take<std::uint8_t>(pyramid);
      view.disparity = arena.template take<Disparity>(samples);
      view.surface = arena.template take<float>(samples);
      view.trusted = arena.template take<std::uint8_t>(samples);
      view.evidence = arena.template take<SurfaceEvidence>(samples);
    }
    rows = arena.template take<PlaneRow>(static_cast<std::size_t>(params.rectification.max_rows));
    const int of_bands = max_level_samples(params, 0) * kBandLanes;
    const int of_coarsest = max_level_samples(params, params.levels - 1) * kMaxBandLanes;
    arena.overlay(
        [&] {  // matching
          for (View& view : views) {
            view.codes = arena.template take<std::uint32_t>(samples);
            view.consistent = arena.template take<Disparity>(samples);
          }
          census_mask = arena.template take<std::uint32_t>(samples);
          first_disparity = arena.template take<std::int16_t>(samples);
          sgm.allocate(arena, params.max_columns, of_bands > of_coarsest ? of_bands : of_coarsest);
        },
        [&] { refinement.allocate(arena, params.max_columns, params.rectification.max_samples); },
        [&] {  // triangulation
          for (View& view : views) view.points = arena.template take<SurfacePoint>(samples);
          later();
        });
  }
};

struct DenseStereoReport {
  int rows = 0;
  int columns = 0;
  double column_step_mm = 0.0;
  DisparityRange disparity_range;     // that was searched, at level 0
  std::array<double, 2> confirmed{};  // share of the dish's samples that either view matched the same way
};

// The grids live in `workspace` until the next call. `bottom_height_mm` is the dish's bottom; heights are
// searched up to `top_height_mm` (the tallest sparse track and a margin), or further where the items'
// outlines reach higher. Both are above the table.
Status run_dense_stereo(const std::array<StoredView, 2>& views, const LabelTable& kept,
                        double bottom_height_mm, double top_height_mm, const DenseStereoParams& params,
                        DenseStereoWorkspace& workspace, std::array<SurfaceGrid, 2>& grids,
                        DenseStereoReport& report);

}  // namespace traygauge
