#include "tests/bench/best_data.hpp"

#include <algorithm>

#include "core/image/resample.hpp"
#include "core/quality/exposure.hpp"
#include "tests/bench/stage_data.hpp"

namespace traygauge::bench {
namespace {

double highest_mm(std::span<const MeasuredSurface> surfaces) {
  float highest = 0.0F;
  for (const MeasuredSurface& surface : surfaces) {
    for (int y = 0; y < surface.heights.cells.height; ++y) {
      for (int x = 0; x < surface.heights.cells.width; ++x)
        highest = std::max(highest, surface.heights.cells.at(x, y).z_mm);
    }
  }
  return highest;
}

}  // namespace

BestData::BestData(const Scene& scene_)
    : scene(scene_),
      configuration(scene_.configuration<Configuration>()),
      pattern(configuration.card_alignment.pattern),
      pyramids{OwnedWorkspace<PyramidWorkspace>(scene_.lens.width, scene_.lens.height),
               OwnedWorkspace<PyramidWorkspace>(scene_.lens.width, scene_.lens.height)} {
  Session session(scene);
  const Measurement& measurement = session.measure();
  if (!measurement.status.ok()) return;
  const ReferenceCard& card = configuration.card;
  if (!prepare_card_pattern(card.pattern, {card.width_mm, card.height_mm, card.thickness_mm},
                            configuration.card_alignment.pattern, *pattern)
           .ok()) {
    return;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    views[i].index = measurement.views.reference_view == 1 ? 1 - i : i;
    views[i].camera_from_table = measurement.views.camera_from_table[views[i].index];
    if (!prepare_view(i)) return;
  }
  top_mm = highest_mm(measurement.views.surfaces) + configuration.pipeline.summit_margin_mm;
  is_complete = sample_views();
}

bool BestData::prepare_view(std::size_t i) {
  BestDataView& view = views[i];
  const Picture& labels = scene.labels[view.index];
  view.gray.create(scene.lens.height, scene.lens.width, CV_8U);
  convert_to_gray(scene.frames[view.index].frame(), target_of(view.gray));
  view.labels =
      cv::Mat(labels.size.height, labels.size.width, CV_8U, const_cast<std::uint8_t*>(labels.pixels.data()));
  view.regions = measure_regions(labels.gray());
  view.pyramid = build_pyramid(view_of(view.gray), *pyramids[i]);
  OwnedWorkspace<CardAlignmentWorkspace> workspace(configuration.card_alignment);
  const Result<CardAlignment> alignment =
      align_card(view_of(view.gray), view_of(view.labels), view.regions.card, scene.lens, *pattern,
                 configuration.card_alignment, *workspace);
  if (alignment.ok()) view.from_card = alignment->camera_from_table;
  return alignment.ok();
}

TrackedView BestData::tracked(std::size_t i) const {
  return {views[i].pyramid, view_of(views[i].labels), scene.lens};
}

std::array<StoredView, 2> BestData::stored() const {
  std::array<StoredView, 2> stored;
  for (std::size_t i = 0; i < 2; ++i) {
    stored[i] = {view_of(views[i].gray), view_of(views[i].labels), views[i].regions.dish, scene.lens,
                 views[i].camera_from_table};
  }
  return stored;
}

bool BestData::sample_views() {
  const DenseStereoParams& params = configuration.surface;
  OwnedWorkspace<DenseStereoWorkspace> workspace(params);
  std::array<SurfaceGrid, 2> grids;
  DenseStereoReport report;
  if (!run_dense_stereo(stored(), labels_on_dish(labels_of_single_dish()), scene.dish.bottom_height_mm,
                        top_mm, params, *workspace, grids, report)
           .ok()) {
    return false;
  }
  range = report.disparity_range;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto copy = [](ImageView<const std::uint8_t> view) {
      return cv::Mat(view.height, view.width, CV_8U, const_cast<std::uint8_t*>(view.data)).clone();
    };
    views[i].sampled = copy((*workspace).views[i].gray[0]);
    views[i].sampled_labels = copy((*workspace).views[i].labels[0]);
  }
  return true;
}

}  // namespace traygauge::bench
