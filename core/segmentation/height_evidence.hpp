// How high what either view shows stands over the dish's own surface, by dense matching of the two views: the
// one cue that shadows, highlights, decoration and tinted glaze do not share with food.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/dish/dish_profile.hpp"
#include "core/segmentation/dish_raster.hpp"
#include "core/segmentation/height_sample.hpp"
#include "core/stereo/dense_stereo.hpp"

namespace traygauge {

// What is asked of it is a step of some millimetres, not a volume: a coarse grid, and no refinement.
constexpr DenseStereoParams coarse_surface_params() {
  DenseStereoParams params;
  params.rectification.max_samples = 40'000;
  params.rectification.max_rows = 384;
  params.max_columns = 448;
  params.levels = 2;
  params.refinement.iterations = 0;
  return params;
}

// Half or twice of any number here moves the MAPE of six pairs of the captures with found outlines by 0.19
// points at most (tests/evaluation/numbers.tsv).
struct HeightEvidenceParams {
  DenseStereoParams surface = coarse_surface_params();
  double highest_mm = 60.0;  // over the bottom, that is looked for
  int node_step = 4;         // samples between those at which the dish's own disparity is worked out
};

// What a HeightEvidence refers to.
struct HeightEvidenceStorage {
  std::array<std::span<HeightSample>, 2> samples;
  std::span<PlaneRow> rows;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const HeightEvidenceParams& params) {
    for (auto& view : samples)
      view = arena.template take<HeightSample>(
          static_cast<std::size_t>(params.surface.rectification.max_samples));
    rows = arena.template take<PlaneRow>(static_cast<std::size_t>(params.surface.rectification.max_rows));
  }
};

// Scratch of measure_height_evidence.
struct HeightEvidenceWorkspace {
  DenseStereoWorkspace surface;
  std::array<std::span<std::uint32_t>, 2> codes;
  std::array<std::span<std::uint8_t>, 2> costs;  // on the surface found and on the dish's own
  std::span<std::uint16_t> sums;
  std::span<std::int32_t> column_sums;
  std::span<float> nodes;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const HeightEvidenceParams& params) {
    const auto count = static_cast<std::size_t>(params.surface.rectification.max_samples);
    surface.allocate(arena, params.surface);
    for (auto& view : codes) view = arena.template take<std::uint32_t>(count);
    for (auto& cost : costs) cost = arena.template take<std::uint8_t>(count);
    sums = arena.template take<std::uint16_t>(count);
    column_sums = arena.template take<std::int32_t>(static_cast<std::size_t>(params.surface.max_columns));
    nodes = arena.template take<float>(static_cast<std::size_t>(params.surface.max_columns) + 2);
  }
};

// Both views' samples over the dish; they and the grid's rows live in the storage.
struct HeightEvidence {
  PlaneRectification grid;
  std::array<ImageView<HeightSample>, 2> views;
};

// Fails where run_dense_stereo does.
Status measure_height_evidence(const std::array<StoredView, 2>& views, const LabelTable& kept,
                               const InnerSurface& dish, const HeightEvidenceParams& params,
                               HeightEvidenceStorage& storage, HeightEvidenceWorkspace& workspace,
                               HeightEvidence& relief);

// Lays one view's samples into the cells of its raster; cells without any are not known.
void lay_height_evidence(const HeightEvidence& relief, std::size_t view, const StoredView& stored,
                         const DishRaster& raster, ImageView<HeightSample> cells);

}  // namespace traygauge
