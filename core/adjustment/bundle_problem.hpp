// The least-squares problem of the bundle adjustment: both cameras over the table, how the card lies on it,
// and the places of the dishes.
//
// The dishes' places are eliminated from the normal equations (Schur's complement), so that the problem's
// size does not depend on how many stand on the tray.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/adjustment/card_prior.hpp"
#include "core/adjustment/track_residuals.hpp"
#include "core/dish/dish_model.hpp"
#include "core/dish/dish_pose.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/levenberg_marquardt.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/tracking/point_track.hpp"

namespace traygauge {

// A step of both cameras, then of the card's lie (tilt 2, raised 1).
inline constexpr int kLieParameter = kCameraParameters;
inline constexpr int kBundleParameters = kLieParameter + Vec3::SizeAtCompileTime;
using BundleVector = Eigen::Matrix<double, kBundleParameters, 1>;
using BundleMatrix = Eigen::Matrix<double, kBundleParameters, kBundleParameters>;

struct BundleState {
  TableCameras camera_from_table;
  CardTilt card;
  std::array<DishPose, kMaxPlacedDishes> places;
};

// How a track's residuals count: a residual r costs r²/variance / (1 + r²/scale²) (Geman and McClure). px².
struct TrackWeight {
  double line_variance = 1.0;
  double line_squared_scale = 0.0;
  double table_variance = 1.0;
  double table_squared_scale = 0.0;
  bool uses_line = false;
  bool uses_table = false;
};

struct BundleRim {
  DishOutlines outlines;
  PlacePrior prior;
  double scale_px = 1.0;
  std::size_t step = 1;  // of so many points one is read
};

// What the elimination leaves behind for going back: place step = −from_place − from_cameras · camera step.
struct PlaceElimination {
  PlaceMatrix covariance = PlaceMatrix::Zero();  // of the place with the cameras fixed
  PlaceVector from_place = PlaceVector::Zero();
  Eigen::Matrix<double, kPlaceParameters, kCameraParameters> from_cameras =
      Eigen::Matrix<double, kPlaceParameters, kCameraParameters>::Zero();
};

struct BundleTerms {
  std::array<CardPrior, 2> cards;
  Vec3 card_pivot_mm = Vec3::Zero();
  double lie_tilt_information = 0.0;
  double lie_raised_information = 0.0;
  std::span<const PointTrack> tracks;
  std::span<const TrackWeight> weights;
  std::span<const BundleRim> rims;
  FocalsPx focals_px{};
};

class BundleProblem {
 public:
  using Equations = NormalEquations<kBundleParameters>;

  // `eliminations`: one a rim, overwritten by each linearisation.
  BundleProblem(const BundleTerms& terms, std::span<PlaceElimination> eliminations)
      : terms_(terms), eliminations_(eliminations) {}

  double cost(const BundleState& state) const;
  double linearise(const BundleState& state, Equations& equations) const;
  // After a linearisation: the dishes follow the cameras.
  BundleState moved(const BundleState& state, const BundleVector& step) const;

 private:
  double add_cards(const BundleState& state, Equations& equations) const;
  double add_tracks(const BundleState& state, Equations& equations) const;
  double add_rim(const BundleState& state, std::size_t index, Equations& equations) const;
  double cards_cost(const BundleState& state) const;
  double tracks_cost(const BundleState& state) const;
  double rim_cost(const BundleState& state, std::size_t index) const;

  const BundleTerms& terms_;
  std::span<PlaceElimination> eliminations_;
};

}  // namespace traygauge
