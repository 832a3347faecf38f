#include "core/dish/dish_sighting.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/median.hpp"
#include "core/dish/rim_tracer.hpp"
#include "core/geometry/levenberg_marquardt.hpp"

namespace traygauge {
namespace {

// Of a round dish, whose azimuth nothing shows; 1 / rad².
constexpr double kFixedAzimuth = 1e12;

using SightingEquations = NormalEquations<kSightedParameters>;

// Sums over an outline about one place.
class RimFit {
 public:
  RimFit(std::span<const Vec2> outline, const Pose& camera, double focal_px)
      : outline_(outline), camera_(camera), focal_px_(focal_px) {}

  // False where a point cannot be on the dish's edge.
  bool linearise(const DishPose& place, double scale_px, bool is_round) {
    equations_ = {};
    by_camera_.setZero();
    by_height_.setZero();
    squares_px2_ = 0.0;
    agreeing_ = 0;
    if (is_round) equations_.add(0.0, SightedVector::Unit(kPlaceAzimuth), kFixedAzimuth);
    const RimProjection rim(place, camera_, focal_px_);
    for (const Vec2& ray : outline_) {
      double residual_px = 0.0;
      Vec6 by_camera;
      PlaceVector by_place;
      if (!rim.linearise(ray, residual_px, by_camera, by_place)) return false;
      const double shrink = 1.0 / (1.0 + residual_px * residual_px / (scale_px * scale_px));
      const double weight = shrink * shrink;
      SightedVector sighted;
      sighted << by_place.head<3>(),
          by_place[kPlaceSize] * place.size_mm[0] + by_place[kPlaceSize + 1] * place.size_mm[1];
      equations_.add(residual_px, sighted, weight);
      by_camera_ += weight * sighted * by_camera.transpose();
      by_height_ += weight * by_place[kPlaceHeight] * sighted;
      if (std::abs(residual_px) > scale_px) continue;
      squares_px2_ += residual_px * residual_px;
      ++agreeing_;
    }
    return true;
  }

  const SightingEquations& equations() const { return equations_; }
  const Eigen::Matrix<double, kSightedParameters, 6>& by_camera() const { return by_camera_; }
  const SightedVector& by_height() const { return by_height_; }
  int agreeing() const { return agreeing_; }
  double rms_px() const { return agreeing_ > 0 ? std::sqrt(squares_px2_ / agreeing_) : 0.0; }

 private:
  std::span<const Vec2> outline_;
  const Pose& camera_;
  double focal_px_;
  SightingEquations equations_;
  Eigen::Matrix<double, kSightedParameters, 6> by_camera_ =
      Eigen::Matrix<double, kSightedParameters, 6>::Zero();
  SightedVector by_height_ = SightedVector::Zero();
  double squares_px2_ = 0.0;
  int agreeing_ = 0;
};

}  // namespace

DishSighting sight_dish(std::span<const Vec2> outline, const Pose& camera_from_table, double focal_px,
                        const DishPose& about, const DishSightingParams& params) {
  DishSighting sighting;
  if (static_cast<int>(outline.size()) < params.min_points) return sighting;
  const bool is_round = is_round_dish(about.size_mm);
  DishPose place = about;
  double size = 1.0;
  RimFit fit(outline, camera_from_table, focal_px);
  for (const double scale_px : params.scales_px) {
    for (int i = 0; i < params.iterations; ++i) {
      SightedVector step;
      if (!fit.linearise(place, scale_px, is_round) || !fit.equations().solve(0.0, step)) return sighting;
      place.centre_mm += step.head<2>();
      place.azimuth_rad += step[kPlaceAzimuth];
      size *= 1.0 + step[kSightedSize];
      if (!(size > 0.5) || !(size < 2.0)) return sighting;
      for (std::size_t axis = 0; axis < 2; ++axis) place.size_mm[axis] = size * about.size_mm[axis];
    }
  }
  const double scale_px = std::max(params.scales_px.back(), kOutlierSigmas * fit.rms_px());
  if (!fit.linearise(place, scale_px, is_round) || fit.agreeing() < params.min_points ||
      fit.agreeing() < params.min_agreeing * static_cast<double>(outline.size()))
    return sighting;
  const SightedMatrix inverse = inverse_information<kSightedParameters>(fit.equations().hessian);
  if (!inverse.allFinite() || inverse.isZero(0.0)) return sighting;
  sighting.is_known = true;
  sighting.camera_from_table = camera_from_table;
  sighting.place << place.centre_mm, place.azimuth_rad, size - 1.0;
  sighting.covariance = params.points_for_one * fit.rms_px() * fit.rms_px() * inverse;
  sighting.by_camera = -inverse * fit.by_camera();
  sighting.by_height = -inverse * fit.by_height();
  sighting.points = fit.agreeing();
  sighting.rms_px = fit.rms_px();
  return sighting;
}

// About where both views have the dish, and about where this one alone wants it: bands of a decoration draw
// the second place aside, a slip between the pictures the first. More of the rim agrees about the right one.
std::array<DishSighting, 2> sight_found_dish(const DishSearchViews& views, const FoundDish& found,
                                             const DishSearchParams& search, const DishSightingParams& params,
                                             DishSearchWorkspace& workspace) {
  DishSearchParams wide = search;
  wide.vote_reach_mm = search.slip_reach_mm;
  RimTracer tracer(views, wide, workspace);
  std::array<DishSighting, 2> sightings;
  for (std::size_t v = 0; v < 2; ++v) {
    DishPose own = found.place;
    tracer.shift_to_edges(std::array{v}, found.inside_sign, own);
    for (const DishPose& about : {found.place, own}) {
      BoundedList<Vec2>& rays = workspace.outlines[v];
      tracer.trace(v, about, found.inside_sign, search.min_step, RimChoice::nearest, rays);
      const DishSighting sighting = sight_dish(rays.items(), views[v].camera_from_table,
                                               views[v].lens.pinhole.mean_focal_px(), about, params);
      if (sighting.points > sightings[v].points) sightings[v] = sighting;
    }
  }
  return sightings;
}

}  // namespace traygauge
