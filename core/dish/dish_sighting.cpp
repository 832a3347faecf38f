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

// Steps of the camera that show the same as a dish which leans, one column for each axis: it turns about the
// middle of its edge.
Eigen::Matrix<double, 6, 2> steps_of_lean(const DishPose& place, const Pose& camera_from_table) {
  const Vec3 pivot_mm(place.centre_mm.x(), place.centre_mm.y(), place.edge_height_mm);
  Eigen::Matrix<double, 6, 2> steps;
  for (int axis = 0; axis < 2; ++axis) {
    const Vec3 turn = Vec3::Unit(axis);
    steps.col(axis) << camera_from_table.rotation * turn, camera_from_table.rotation * pivot_mm.cross(turn);
  }
  return steps;
}

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
    camera_squares_.setZero();
    camera_gradient_.setZero();
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
      camera_squares_ += weight * by_camera * by_camera.transpose();
      camera_gradient_ += weight * residual_px * by_camera;
      by_height_ += weight * by_place[kPlaceHeight] * sighted;
      if (std::abs(residual_px) > scale_px) continue;
      squares_px2_ += residual_px * residual_px;
      ++agreeing_;
    }
    return true;
  }

  // `variance_px2`: of a residual with weight one.
  SightedLean lean(const DishPose& place, const SightedMatrix& inverse, double variance_px2) const {
    const Eigen::Matrix<double, 6, 2> steps = steps_of_lean(place, camera_);
    // What place and size leave of a step of the camera.
    const Eigen::Matrix<double, 6, kSightedParameters> explained =
        by_camera_.transpose().lazyProduct(inverse);
    const Mat6 left = camera_squares_ - Mat6(explained.lazyProduct(by_camera_));
    const Eigen::Matrix<double, 2, 6> by_camera = -steps.transpose().lazyProduct(left) / variance_px2;
    const Vec6 gradient = camera_gradient_ - Vec6(explained.lazyProduct(equations_.gradient));
    SightedLean lean;
    lean.by_camera = by_camera.cast<float>();
    lean.information = -by_camera.lazyProduct(steps).eval().cast<float>();
    lean.weighted = (-steps.transpose().lazyProduct(gradient) / variance_px2).eval().cast<float>();
    return lean;
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
  Mat6 camera_squares_ = Mat6::Zero();
  Vec6 camera_gradient_ = Vec6::Zero();
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
  const double variance_px2 = params.points_for_one * fit.rms_px() * fit.rms_px();
  sighting.covariance = variance_px2 * inverse;
  sighting.lean = fit.lean(place, inverse, variance_px2);
  sighting.by_camera = -inverse * fit.by_camera();
  sighting.by_height = -inverse * fit.by_height();
  sighting.points = fit.agreeing();
  sighting.rms_px = fit.rms_px();
  return sighting;
}

namespace {

// Of a dish that was found, about places that are guessed.
class FoundRim {
 public:
  FoundRim(RimTracer& tracer, const DishSearchView& view, std::size_t index, const FoundDish& found,
           const DishSearchParams& search, const DishSightingParams& params, BoundedList<Vec2>& rays,
           BoundedList<Vec2>& kept)
      : tracer_(tracer),
        view_(view),
        index_(index),
        found_(found),
        search_(search),
        params_(params),
        rays_(rays),
        kept_(kept) {}

  // The better of what shows about where both views have the dish, and about where this one alone wants it:
  // bands of a decoration draw the second place aside, a slip between the pictures the first.
  DishSighting sight() {
    DishPose own = found_.place;
    tracer_.shift_to_edges(std::array{index_}, found_.inside_sign, own);
    trace(found_.place);
    DishSighting sighting = sight_dish(found_.place, params_);
    if (sighting.is_known) keep_rays();
    trace(own);
    DishSighting own_sighting = sight_dish(own, params_);
    if (own_sighting.points <= sighting.points) return sighting;
    keep_rays();
    return own_sighting;
  }

  // Of a rim that is larger than described nearly all has to show: parts are the edges of other things.
  DishSighting sight_larger(double size) {
    DishPose about = found_.place;
    for (double& side_mm : about.size_mm) side_mm *= size;
    tracer_.shift_to_edges(std::array{index_}, found_.inside_sign, about);
    trace(about);
    DishSightingParams any = params_;
    any.min_agreeing = 0.0;
    const DishSighting rough = sight_dish(about, any);
    if (!rough.is_known) return {};
    about.centre_mm = rough.place.head<2>();
    about.azimuth_rad = rough.place[kPlaceAzimuth];
    for (double& side_mm : about.size_mm) side_mm *= 1.0 + rough.place[kSightedSize];
    const RimTrace shown = trace(about);
    if (shown.supported < params_.min_agreeing * shown.seen) return {};
    DishSighting sighting = sight_dish(about, params_);
    const double described_mm = found_.place.size_mm[0];
    sighting.place[kSightedSize] =
        about.size_mm[0] / described_mm * (1.0 + sighting.place[kSightedSize]) - 1.0;
    return sighting;
  }

  // Of the sighting that was made last.
  void keep_rays() { kept_.assign(rays_.items()); }

 private:
  RimTrace trace(const DishPose& about) {
    return tracer_.trace(index_, about, found_.inside_sign, search_.min_step, RimChoice::nearest, rays_);
  }
  DishSighting sight_dish(const DishPose& about, const DishSightingParams& params) const {
    return traygauge::sight_dish(rays_.items(), view_.camera_from_table, view_.lens.pinhole.mean_focal_px(),
                                 about, params);
  }

  RimTracer& tracer_;
  const DishSearchView& view_;
  std::size_t index_;
  const FoundDish& found_;
  const DishSearchParams& search_;
  const DishSightingParams& params_;
  BoundedList<Vec2>& rays_;  // of the last trace
  BoundedList<Vec2>& kept_;
};

}  // namespace

std::array<DishSighting, 2> sight_found_dish(const DishSearchViews& views, const FoundDish& found,
                                             const DishSearchParams& search, const DishSightingParams& params,
                                             DishSearchWorkspace& workspace) {
  DishSearchParams wide = search;
  wide.vote_reach_mm = search.slip_reach_mm;
  RimTracer tracer(views, wide, workspace);
  std::array<DishSighting, 2> sightings;
  for (std::size_t v = 0; v < 2; ++v) {
    workspace.rims[v].clear();
    FoundRim rim(tracer, views[v], v, found, search, params, workspace.outlines[v], workspace.rims[v]);
    sightings[v] = rim.sight();
    // Of several edges around a dish its own is the outermost.
    for (const double size : params.larger_sizes) {
      const DishSighting larger = rim.sight_larger(size);
      const double least = sightings[v].place[kSightedSize] + params.least_larger;
      if (!larger.is_known || (sightings[v].is_known && larger.place[kSightedSize] <= least)) continue;
      sightings[v] = larger;
      rim.keep_rays();
    }
  }
  if (!sightings[0].is_known || !sightings[1].is_known) {
    for (BoundedList<Vec2>& rays : workspace.rims) rays.clear();
  }
  return sightings;
}

}  // namespace traygauge
