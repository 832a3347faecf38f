// The least-squares problem of placing one dish at given cameras.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/dish/rim_residual.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/levenberg_marquardt.hpp"
#include "core/geometry/table_frame.hpp"

namespace traygauge {

// Rays of the outline in both views.
using DishOutlines = std::array<std::span<const Vec2>, 2>;
using FocalsPx = std::array<double, 2>;

// Of so many points of the outlines one is read, with the weight of all: neighbours repeat each other's
// error. Each counts as if it had a standard deviation of one pixel: label outlines are right to about half
// of that, and wrong the same way over about four points of DishOutlineParams.
inline std::size_t outline_step(const DishOutlines& outlines, int max_view_points) {
  const std::size_t longer =
      outlines[0].size() > outlines[1].size() ? outlines[0].size() : outlines[1].size();
  return 1 + longer / static_cast<std::size_t>(max_view_points > 0 ? max_view_points : 1);
}

// What is known of a place before the outlines are seen: independent normal errors.
struct PlacePrior {
  PlaceVector mean = PlaceVector::Zero();
  PlaceVector information = PlaceVector::Zero();  // 1 / variance

  double cost(const DishPose& place) const { return information.dot((as_vector(place) - mean).cwiseAbs2()); }
};

// `step`: of so many points of the outline one is read, for all.
class DishPoseProblem {
 public:
  using Equations = NormalEquations<kPlaceParameters>;

  DishPoseProblem(const DishOutlines& outlines, const TableCameras& cameras, const FocalsPx& focals_px,
                  const PlacePrior& prior, double scale_px, std::size_t step)
      : outlines_(outlines),
        cameras_(cameras),
        focals_px_(focals_px),
        prior_(prior),
        weight_(static_cast<double>(step)),
        inverse_squared_scale_(1.0 / (scale_px * scale_px)),
        step_(step) {}

  double cost(const DishPose& place) const {
    double cost = prior_.cost(place);
    for (std::size_t view = 0; view < 2; ++view) {
      const RimProjection rim(place, cameras_[view], focals_px_[view]);
      for (std::size_t i = 0; i < outlines_[view].size(); i += step_) {
        double residual_px = 0.0;
        if (!rim.residual(outlines_[view][i], residual_px)) return kUnseenPlace;
        const double square = residual_px * residual_px;
        cost += weight_ * square / (1.0 + square * inverse_squared_scale_);
      }
    }
    return cost;
  }

  double linearise(const DishPose& place, Equations& equations) const {
    const PlaceVector error = as_vector(place) - prior_.mean;
    for (int i = 0; i < kPlaceParameters; ++i) {
      equations.add(error[i], PlaceVector::Unit(i), prior_.information[i]);
    }
    double cost = prior_.cost(place);
    for (std::size_t view = 0; view < 2; ++view) {
      const RimProjection rim(place, cameras_[view], focals_px_[view]);
      for (std::size_t i = 0; i < outlines_[view].size(); i += step_) {
        double residual_px = 0.0;
        Eigen::Matrix<double, 6, 1> by_camera;
        PlaceVector by_place;
        if (!rim.linearise(outlines_[view][i], residual_px, by_camera, by_place)) return kUnseenPlace;
        const double square = residual_px * residual_px;
        const double shrink = 1.0 / (1.0 + square * inverse_squared_scale_);
        cost += weight_ * square * shrink;
        equations.add(residual_px, by_place, weight_ * shrink * shrink);
      }
    }
    return cost;
  }

  static DishPose moved(const DishPose& place, const PlaceVector& step) {
    return place_from_vector(as_vector(place) + step);
  }

 private:
  const DishOutlines& outlines_;
  const TableCameras& cameras_;
  const FocalsPx& focals_px_;
  const PlacePrior& prior_;
  double weight_;
  double inverse_squared_scale_;
  std::size_t step_;
};

}  // namespace traygauge
