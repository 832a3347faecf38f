// Volumes from a sparse cloud and shape templates, as DietCam by F. Kong and J. Tan (paper [23]), here from
// two views: SIFT matches, the motion and scale by our profile paper, and for each item the template that
// fits its points.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "tests/evaluation/methods/pair_features.hpp"
#include "tests/evaluation/methods/solid.hpp"
#include "tests/evaluation/methods/tray_geometry.hpp"

namespace traygauge::tables {

struct TemplateParams {
  int min_points = 8;  // of an item; fewer carry no template
  double max_deviations =
      3;           // of a point's height from the item's median, in deviations by the median: an outlier
  int rounds = 3;  // silhouette by height, then height by points
  double min_relative_height =
      0.2;  // of a point's place on the template: lower ones say little about the height
};

// The template nearest to the points (mm, in the dish frame) among those that fit the silhouette; nothing
// when the points are too few, or none lies above the dish.
std::optional<Solid> fit_template(const ItemView& item, std::span<const Vec3> points,
                                  const TemplateParams& params);

// `matches`: of SIFT, with its card matches.
Run measure_sparse_views(CaptureSession& session, const PairMatches& matches, std::uint64_t seed,
                         const TemplateParams& params = {});

}  // namespace traygauge::tables
