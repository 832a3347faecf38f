#include "core/dish/dish_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/units.hpp"
#include "core/dish/rim_tracer.hpp"
#include "core/dish/rim_votes.hpp"

namespace traygauge {
namespace {

constexpr std::array<std::size_t, 2> kBothViews = {0, 1};

class DishSearch {
 public:
  DishSearch(const DishSearchViews& views, const RimEdges& edges, std::span<const FoundDish> taken,
             const DishSearchParams& params, DishSearchWorkspace& workspace)
      : views_(views),
        edges_(edges),
        taken_(taken),
        params_(params),
        workspace_(workspace),
        tracer_(views, params, workspace) {
    for (std::size_t v = 0; v < 2; ++v) {
      cameras_[v] = views[v].camera_from_table;
      focals_px_[v] = views[v].lens.pinhole.mean_focal_px();
    }
  }

  Result<FoundDish> run(std::span<const DishModel> candidates) {
    const std::size_t count =
        vote_for_places(views_, edges_, candidates, taken_, params_, workspace_, peaks_);
    FoundDish best;
    for (RimPeak& peak : std::span(peaks_).first(count)) {
      peak.place.edge_drop_mm = params_.placement.edge_drop_mm;
      tracer_.shift_to_edges(kBothViews, peak.inside_sign, peak.place);
      if (is_repeated(peak)) continue;
      const Result<FoundDish> confirmed = confirm(peak);
      if (!confirmed.ok() || !(confirmed->support > best.support)) continue;
      best = *confirmed;
      best.candidate = static_cast<int>(peak.dish - candidates.data());
    }
    if (best.candidate < 0) return StatusCode::rim_not_found;
    return best;
  }

 private:
  // Whether one of the peaks before was moved to the same place.
  bool is_repeated(const RimPeak& peak) const {
    return std::any_of(peaks_.data(), &peak, [&](const RimPeak& other) {
      return other.dish == peak.dish && other.inside_sign == peak.inside_sign &&
             (other.place.centre_mm - peak.place.centre_mm).norm() < params_.same_place_mm &&
             std::abs(std::remainder(other.place.azimuth_rad - peak.place.azimuth_rad, std::numbers::pi)) *
                     peak.place.size_mm[0] <
                 2.0 * params_.same_place_mm;
    });
  }

  // Only place and azimuth are free. Whatever else stands parallel to the rim, a band of its decoration or
  // the foot of its shadow, has another size.
  Result<FoundDish> confirm(const RimPeak& peak) {
    DishPose place = peak.place;
    PlacePrior prior = prior_of(*peak.dish, place.azimuth_rad, params_.placement);
    prior.information.tail<kPlaceParameters - kPlaceHeight>().setConstant(kHeldInformation);
    LevenbergMarquardtParams search;
    search.max_iterations = params_.iterations;
    double unused = 0.0;
    trace(place, peak.inside_sign, params_.min_step, unused);
    const DishOutlines outlines = {workspace_.outlines[0].items(), workspace_.outlines[1].items()};
    if (outlines[0].size() + outlines[1].size() < static_cast<std::size_t>(params_.placement.min_points))
      return StatusCode::rim_not_found;
    const DishPoseProblem problem(outlines, cameras_, focals_px_, prior, params_.scale_px, 1);
    minimise<kPlaceParameters>(problem, search, place);
    if (!as_vector(place).allFinite()) return StatusCode::rim_not_found;
    FoundDish found;
    found.place = place;
    found.inside_sign = peak.inside_sign;
    const double noise = tracer_.noise_beside(place, peak.inside_sign);
    found.support = trace(place, peak.inside_sign,
                          std::max(params_.min_step, params_.min_step_over_noise * noise), found.rms_mm);
    if (!(found.support >= params_.min_support)) return StatusCode::rim_not_found;
    return found;
  }

  // Collects where the edge lies along the rim; returns the share of the rim, within the pictures, that has
  // one, and its distance from the place.
  double trace(const DishPose& place, int inside_sign, double min_step, double& rms_mm) {
    RimTrace both;
    for (const std::size_t v : kBothViews) {
      const RimTrace one =
          tracer_.trace(v, place, inside_sign, min_step, RimChoice::strongest, workspace_.outlines[v]);
      both.seen += one.seen;
      both.supported += one.supported;
      both.squares_mm2 += one.squares_mm2;
    }
    rms_mm = both.supported > 0 ? std::sqrt(both.squares_mm2 / both.supported) : 0.0;
    return both.seen > 0 ? static_cast<double>(both.supported) / both.seen : 0.0;
  }

  const DishSearchViews& views_;
  const RimEdges& edges_;
  std::span<const FoundDish> taken_;
  const DishSearchParams& params_;
  DishSearchWorkspace& workspace_;
  RimTracer tracer_;
  TableCameras cameras_;
  FocalsPx focals_px_{};
  std::array<RimPeak, kMaxRimPeaks> peaks_;
};

}  // namespace

Result<FoundDish> search_dish(const DishSearchViews& views, const RimEdges& edges,
                              std::span<const DishModel> candidates, std::span<const FoundDish> taken,
                              const DishSearchParams& params, DishSearchWorkspace& workspace) {
  return DishSearch(views, edges, taken, params, workspace).run(candidates);
}

}  // namespace traygauge
