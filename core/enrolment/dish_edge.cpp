#include "core/enrolment/dish_edge.hpp"

#include <algorithm>

namespace traygauge {
namespace {

// Of a dish that nothing is known of: these keep the problem regular, no more.
constexpr double kFreeHeightSigmaMm = 100.0;
constexpr double kFreeSizeSigmaMm = 500.0;
constexpr int kLeastViewPoints = 3;  // times those of placement: both views are needed to tell a height

PlacePrior free_prior(const DishPose& place, const DishPoseParams& params) {
  PlacePrior prior = loose_prior(place, kFreeHeightSigmaMm, kFreeSizeSigmaMm, params);
  prior.mean[kPlaceDrop] = params.edge_drop_mm;
  return prior;
}

class EdgeSearch {
 public:
  EdgeSearch(const DishOutlines& outlines, const TableCameras& cameras, const FocalsPx& focals_px,
             const DishPoseParams& placement, DishPoseWorkspace& workspace)
      : outlines_(outlines),
        cameras_(cameras),
        focals_px_(focals_px),
        placement_(placement),
        workspace_(workspace),
        step_(outline_step(outlines, placement.max_view_points)) {}

  // The level on which both outlines agree best.
  bool find_level(const DishEdgeParams& params, DishPose& best) const {
    double least = kUnseenPlace;
    const double step_mm = std::max(params.level_step_mm, 0.1);
    const int levels = static_cast<int>((params.highest_mm - params.lowest_mm) / step_mm) + 1;
    for (int i = 0; i < levels; ++i) {
      const double level_mm = params.lowest_mm + i * step_mm;
      DishPose place;
      if (!guess_place(outlines_, cameras_, level_mm, step_, workspace_, place)) continue;
      place.edge_drop_mm = placement_.edge_drop_mm;
      const PlacePrior prior = free_prior(place, placement_);
      const double cost = problem(prior, placement_.first_robust_scales_px[1]).cost(place);
      if (!(cost < least)) continue;
      least = cost;
      best = place;
    }
    return least < kUnseenPlace;
  }

  // Robust least squares over all that the outlines fix.
  void refine(DishPose& place) const {
    for (const double scale_px : placement_.first_robust_scales_px) fit(scale_px, place);
    OutlineFit unused;
    fit(robust_scale_px(outlines_, cameras_, focals_px_, place, placement_, workspace_, unused), place);
  }

 private:
  DishPoseProblem problem(const PlacePrior& prior, double scale_px) const {
    return {outlines_, cameras_, focals_px_, prior, scale_px, step_};
  }
  void fit(double scale_px, DishPose& place) const {
    const PlacePrior prior = free_prior(place, placement_);
    minimise<kPlaceParameters>(problem(prior, scale_px), {}, place);
  }

  const DishOutlines& outlines_;
  const TableCameras& cameras_;
  const FocalsPx& focals_px_;
  const DishPoseParams& placement_;
  DishPoseWorkspace& workspace_;
  std::size_t step_;
};

}  // namespace

Status measure_dish_edge(const DishOutlines& outlines, const TableCameras& cameras, const FocalsPx& focals_px,
                         const DishPoseParams& placement, const DishEdgeParams& params,
                         DishPoseWorkspace& workspace, DishPose& place) {
  place = {};
  const auto least = static_cast<std::size_t>(std::max(placement.min_view_points, 1) * kLeastViewPoints);
  if (outlines[0].size() < least || outlines[1].size() < least) return StatusCode::rim_not_found;
  const EdgeSearch search(outlines, cameras, focals_px, placement, workspace);
  if (!search.find_level(params, place)) return StatusCode::rim_not_found;
  search.refine(place);
  if (!as_vector(place).allFinite()) return StatusCode::rim_not_found;
  return contradicts(outlines, cameras, focals_px, place, placement, workspace)
             ? StatusCode::labels_inconsistent
             : StatusCode::ok;
}

}  // namespace traygauge
