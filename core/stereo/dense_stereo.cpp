#include "core/stereo/dense_stereo.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/stereo/median.hpp"
#include "core/stereo/outline_height.hpp"
#include "core/stereo/symmetric_census.hpp"
#include "core/stereo/view_slope.hpp"

namespace traygauge {
namespace {

using View = DenseStereoWorkspace::View;

template <class T>
ImageView<T> as_picture(std::span<T> storage, ImageView<const std::uint8_t> like) {
  return {storage.data(), like.width, like.height};
}

// The disparities of the heights searched, over the whole grid.
DisparityRange height_range(const PlaneRectification& grid, double low_mm, double high_mm) {
  double least = 0.0;
  double most = 0.0;
  for (const int row : {0, grid.rows() / 2, grid.rows() - 1}) {
    for (const int column : {0, grid.columns() - 1}) {
      least = std::min(least, grid.disparity(row, column, low_mm));
      most = std::max(most, grid.disparity(row, column, high_mm));
    }
  }
  return {static_cast<int>(std::floor(least)), static_cast<int>(std::ceil(most))};
}

// The coarsest level searches all heights within one band, which range_at widens by up to three disparities.
int most_disparities(const DenseStereoParams& params) {
  return (kMaxBandLanes - 3) << (params.levels - 1);
}

// Coarser where views far apart would displace the highest food by more samples than can be searched.
Status build_grid(const std::array<StoredView, 2>& views, const LabelTable& kept, double bottom_height_mm,
                  double highest_mm, const DenseStereoParams& params, std::span<PlaneRow> rows,
                  PlaneRectification& grid, DisparityRange& range) {
  PlaneRectificationParams rectification = params.rectification;
  const int most = most_disparities(params);
  const auto build = [&]() -> Status {
    const Status built = grid.build(views, kept, bottom_height_mm, rectification, rows);
    if (!built.ok()) return built;
    if (grid.columns() > params.max_columns) return StatusCode::rectification_failed;
    range = height_range(grid, params.min_height_mm, highest_mm);
    return range.count() < most ? StatusCode::ok : StatusCode::disparity_range_too_large;
  };
  const Status status = build();
  if (status.code() != StatusCode::disparity_range_too_large) return status;
  constexpr double kSlack = 0.95;  // the margin around the food takes its share of the samples
  const double coarser = kSlack * most / range.count();
  rectification.max_samples = static_cast<int>(coarser * coarser * grid.rows() * grid.columns());
  return build();
}

// The label that two of four samples share.
void halve_labels(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target) {
  for (int y = 0; y < target.height; ++y) {
    const std::uint8_t* upper = source.row(2 * y);
    const std::uint8_t* lower = source.row(std::min(2 * y + 1, source.height - 1));
    for (int x = 0; x < target.width; ++x) {
      const int left = 2 * x;
      const int right = std::min(left + 1, source.width - 1);
      const std::uint8_t a = upper[left];
      const std::uint8_t b = upper[right];
      const std::uint8_t c = lower[left];
      const std::uint8_t d = lower[right];
      target.at(x, y) = a == b || a == c || a == d ? a : b == c || b == d ? b : c;
    }
  }
}

void sample_view(const PlaneRectification& grid, const StoredView& stored, const LabelTable& kept, int levels,
                 View& view) {
  std::uint8_t* gray = view.gray_storage.data();
  std::uint8_t* labels = view.label_storage.data();
  int width = grid.columns();
  int height = grid.rows();
  for (std::size_t level = 0; level < static_cast<std::size_t>(levels); ++level) {
    view.gray[level] = {gray, width, height};
    view.labels[level] = {labels, width, height};
    if (level == 0) {
      grid.sample_gray(stored, view.gray[0]);
      grid.sample_labels(stored, kept, view.labels[0]);
    } else {
      halve(view.gray[level - 1], view.gray[level]);
      halve_labels(view.labels[level - 1], view.labels[level]);
    }
    gray += static_cast<std::ptrdiff_t>(width) * height;
    labels += static_cast<std::ptrdiff_t>(width) * height;
    width = halved(width);
    height = halved(height);
  }
}

// A row's unknown disparities take the nearest known one; a row without any takes the one before.
void extend_known(ImageView<Disparity> disparity) {
  const Disparity* before = nullptr;
  for (int y = 0; y < disparity.height; ++y) {
    Disparity* row = disparity.row(y);
    int last = -1;
    for (int x = 0; x < disparity.width; ++x) {
      if (row[x] == kNoDisparity) continue;
      const int middle = last < 0 ? 0 : (last + x + 1) / 2;
      for (int i = last + 1; i < x; ++i) row[i] = last >= 0 && i < middle ? row[last] : row[x];
      last = x;
    }
    for (int i = last + 1; i < disparity.width; ++i) {
      row[i] = last >= 0 ? row[last] : before != nullptr ? before[i] : Disparity{0};
    }
    before = row;
  }
}

// Bands of `lanes` about twice the disparity of the coarser level, counted from the reference view.
void centre_bands(ImageView<const Disparity> coarse, int sign, DisparityRange range, int lanes,
                  ImageView<std::int16_t> first) {
  const int last = std::max(range.min_px, range.max_px + 1 - lanes);
  for (int y = 0; y < first.height; ++y) {
    const Disparity* row = coarse.row(y / 2);
    for (int x = 0; x < first.width; ++x) {
      const int twice = sign * ((row[x / 2] + kDisparityScale / 4) >> 3);
      first.at(x, y) = static_cast<std::int16_t>(std::clamp(twice - lanes / 2, range.min_px, last));
    }
  }
}
static_assert(kDisparityScale == 16);

// The range of a level, counted from the reference view, and one more at either end.
DisparityRange range_at(DisparityRange range, std::size_t level, int sign) {
  const auto scale = static_cast<double>(1 << level);
  const DisparityRange reduced{static_cast<int>(std::floor(range.min_px / scale)) - 1,
                               static_cast<int>(std::ceil(range.max_px / scale)) + 1};
  return sign > 0 ? reduced : DisparityRange{-reduced.max_px, -reduced.min_px};
}

// Matches view `v` against the other one.
void match_reference(DenseStereoWorkspace& workspace, std::size_t level, std::size_t v, DisparityRange range,
                     bool coarsest, const DenseStereoParams& params) {
  std::array<View, 2>& views = workspace.views;
  const ImageView<const std::uint8_t> like = views[0].gray[level];
  const ImageView<std::int16_t> first = as_picture(workspace.first_disparity, like);
  const int sign = v == 0 ? 1 : -1;
  const DisparityRange searched = range_at(range, level, sign);
  int lanes = kBandLanes;
  if (coarsest) {
    lanes = std::min((searched.count() + kBandLanes - 1) / kBandLanes * kBandLanes, kMaxBandLanes);
    std::fill_n(first.data, static_cast<std::size_t>(like.width) * static_cast<std::size_t>(like.height),
                static_cast<std::int16_t>(searched.min_px));
  } else {
    const ImageView<Disparity> coarse =
        as_picture(views[v].consistent, ImageView<const std::uint8_t>(views[0].gray[level + 1]));
    extend_known(coarse);
    centre_bands(coarse, sign, searched, lanes, first);
  }
  BandedPair pair;
  for (std::size_t i = 0; i < 2; ++i) {
    const View& view = views[i == 0 ? v : 1 - v];
    pair.gray[i] = view.gray[level];
    pair.labels[i] = view.labels[level];
    pair.codes[i] = as_picture(view.codes, like);
  }
  const ImageView<std::uint32_t> mask = as_picture(workspace.census_mask, like);
  mask_symmetric_census(views[v].labels[level], mask);
  pair.mask = mask;
  const ImageView<Disparity> found = as_picture(views[v].disparity, like);
  match_sgm(pair, first, lanes, params.sgm, workspace.sgm, found);
  if (sign > 0) return;
  for (int y = 0; y < found.height; ++y) {
    for (int x = 0; x < found.width; ++x) {
      Disparity& d = found.at(x, y);
      if (d != kNoDisparity) d = static_cast<Disparity>(-d);
    }
  }
}

void match_level(DenseStereoWorkspace& workspace, std::size_t level, DisparityRange range, bool coarsest,
                 const DenseStereoParams& params) {
  for (View& view : workspace.views) {
    transform_symmetric_census(view.gray[level],
                               as_picture(view.codes, ImageView<const std::uint8_t>(view.gray[level])));
  }
  for (std::size_t v = 0; v < 2; ++v) match_reference(workspace, level, v, range, coarsest, params);
}

// The 3 × 3 median.
void filter_level(DenseStereoWorkspace& workspace, std::size_t level) {
  const ImageView<const std::uint8_t> like = workspace.views[0].gray[level];
  for (const View& view : workspace.views) {
    filter_median(as_picture(view.disparity, like), 1, as_picture(view.consistent, like));
  }
}

// Where view `v`'s camera stands over a row.
CameraOverRow camera_over(const PlaneRectification& grid, std::size_t v, int row) {
  const double per_mm = 1.0 / grid.column_step_mm();
  return {grid.row(row).foot_mm[v] * per_mm, grid.camera_height_mm(static_cast<int>(v)) * per_mm};
}

void fill_view(const std::array<View, 2>& views, const PlaneRectification& grid, std::size_t v,
               const OcclusionParams& params, ImageView<Disparity> disparity) {
  const ImageView<const std::uint8_t> labels = views[v].labels[0];
  const auto width = static_cast<std::size_t>(disparity.width);
  for (int y = 0; y < disparity.height; ++y) {
    const RowOfViews row{{labels.row(y), width},
                         {views[1 - v].labels[0].row(y), width},
                         v == 0 ? 1 : -1,
                         camera_over(grid, v, y),
                         camera_over(grid, 1 - v, y)};
    const RectifiedViewSlope outline(grid, labels, static_cast<int>(v), y);
    fill_occlusions(row, outline, params, {disparity.row(y), width});
  }
}

// Disparities that both views agree on, gaps filled, as real numbers for the refinement.
void prepare_surfaces(DenseStereoWorkspace& workspace, const PlaneRectification& grid,
                      const DenseStereoParams& params) {
  std::array<View, 2>& views = workspace.views;
  const ImageView<const std::uint8_t> like = views[0].gray[0];
  for (std::size_t v = 0; v < 2; ++v) {
    keep_consistent(as_picture(views[v].disparity, like), as_picture(views[1 - v].disparity, like),
                    v == 0 ? 1 : -1, as_picture(views[v].consistent, like));
  }
  for (std::size_t v = 0; v < 2; ++v) {
    const ImageView<Disparity> filtered = as_picture(views[v].disparity, like);
    filter_median(as_picture(views[v].consistent, like), 1, filtered);
    const auto samples = static_cast<std::size_t>(like.width) * static_cast<std::size_t>(like.height);
    for (std::size_t i = 0; i < samples; ++i) views[v].trusted[i] = filtered.data[i] == kNoDisparity ? 0 : 1;
    fill_view(views, grid, v, params.gaps, filtered);
    extend_known(filtered);
    for (std::size_t i = 0; i < samples; ++i) {
      const bool is_labelled = views[v].labels[0].data[i] != 0;
      views[v].surface[i] =
          is_labelled ? static_cast<float>(filtered.data[i] * (1.0 / kDisparityScale)) : 0.0F;
    }
  }
}

void refine_surfaces(DenseStereoWorkspace& workspace, const DenseStereoParams& params) {
  std::array<View, 2>& views = workspace.views;
  for (std::size_t v = 0; v < 2; ++v) {
    const RefinementPair pair{views[v].gray[0], views[v].labels[0], views[1 - v].gray[0],
                              views[1 - v].labels[0], v == 0 ? 1 : -1};
    refine_surface(pair, as_picture(views[v].trusted, pair.gray), params.refinement, workspace.refinement,
                   as_picture(views[v].surface, pair.gray));
  }
}

// Where both views' refined disparities agree within a pixel, they confirm each other.
void rate_evidence(std::array<View, 2>& views, std::size_t v, double& confirmed_fraction) {
  const ImageView<const std::uint8_t> labels = views[v].labels[0];
  const ImageView<const float> own = as_picture(views[v].surface, labels);
  const ImageView<const float> other = as_picture(views[1 - v].surface, labels);
  const ImageView<const std::uint8_t> trusted = as_picture(views[v].trusted, labels);
  const ImageView<SurfaceEvidence> evidence = as_picture(views[v].evidence, labels);
  const float sign = v == 0 ? 1.0F : -1.0F;
  std::size_t samples = 0;
  std::size_t confirmed = 0;
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      evidence.at(x, y) = SurfaceEvidence::none;
      if (labels.at(x, y) == 0) continue;
      ++samples;
      const float d = own.at(x, y);
      const float partner = static_cast<float>(x) + sign * d + 0.5F;
      const bool inside = partner >= 0.0F && partner < static_cast<float>(labels.width);
      const int at = inside ? static_cast<int>(partner) : 0;
      const bool agrees =
          inside && views[1 - v].labels[0].at(at, y) != 0 && std::abs(other.at(at, y) - d) <= 1.0F;
      evidence.at(x, y) = trusted.at(x, y) == 0 ? SurfaceEvidence::filled
                          : agrees              ? SurfaceEvidence::both
                                                : SurfaceEvidence::single;
      confirmed += evidence.at(x, y) == SurfaceEvidence::both ? 1U : 0U;
    }
  }
  confirmed_fraction = samples == 0 ? 0.0 : static_cast<double>(confirmed) / static_cast<double>(samples);
}

void triangulate(const PlaneRectification& grid, std::size_t v, View& view) {
  const ImageView<const std::uint8_t> labels = view.labels[0];
  const ImageView<const float> surface = as_picture(view.surface, labels);
  const ImageView<SurfacePoint> points = as_picture(view.points, labels);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      points.at(x, y) = {};
      if (labels.at(x, y) == 0) continue;
      const double d = surface.at(x, y);
      points.at(x, y) = v == 0 ? grid.point(y, x, x + d, 0) : grid.point(y, x - d, x, 1);
    }
  }
}

}  // namespace

Status run_dense_stereo(const std::array<StoredView, 2>& views, const LabelTable& kept,
                        double bottom_height_mm, double top_height_mm, const DenseStereoParams& params,
                        DenseStereoWorkspace& workspace, std::array<SurfaceGrid, 2>& grids,
                        DenseStereoReport& report) {
  PlaneRectification grid;
  DisparityRange range;
  std::array<View, 2>& sampled = workspace.views;
  assert(params.levels >= 1 && params.levels <= kMaxSurfaceLevels);
  const auto sample_up_to = [&](double highest_mm) {
    const Status built =
        build_grid(views, kept, bottom_height_mm, highest_mm, params, workspace.rows, grid, range);
    if (!built.ok()) return built;
    for (std::size_t v = 0; v < 2; ++v) sample_view(grid, views[v], kept, params.levels, sampled[v]);
    return built;
  };
  const double highest_mm = std::clamp(top_height_mm - bottom_height_mm, 5.0, params.highest_mm);
  Status status = sample_up_to(highest_mm);
  if (!status.ok()) return status;
  const double by_outlines_mm = height_by_outlines_mm(grid, {sampled[0].labels[0], sampled[1].labels[0]});
  if (by_outlines_mm > highest_mm) status = sample_up_to(std::min(by_outlines_mm, params.highest_mm));
  if (!status.ok()) return status;
  report = {grid.rows(), grid.columns(), grid.column_step_mm(), range, {}};

  for (int level = params.levels - 1; level >= 0; --level) {
    match_level(workspace, static_cast<std::size_t>(level), range, level == params.levels - 1, params);
    if (level > 0) filter_level(workspace, static_cast<std::size_t>(level));
  }
  prepare_surfaces(workspace, grid, params);
  refine_surfaces(workspace, params);
  for (std::size_t v = 0; v < 2; ++v) {
    rate_evidence(workspace.views, v, report.confirmed[v]);
  }
  for (std::size_t v = 0; v < 2; ++v) {
    View& view = workspace.views[v];
    triangulate(grid, v, view);
    const ImageView<const std::uint8_t> labels = view.labels[0];
    grids[v] = {as_picture(std::span<const SurfacePoint>(view.points), labels),
                as_picture(std::span<const SurfaceEvidence>(view.evidence), labels), labels,
                grid.camera_mm(static_cast<int>(v))};
  }
  return StatusCode::ok;
}

}  // namespace traygauge
