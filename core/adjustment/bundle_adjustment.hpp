// Both cameras, the table and the places of the dishes from everything at once: the card's alignment in each
// view, point tracks, the table's texture and the dishes' outlines. Levenberg and Marquardt's method with
// robust weights; tracks are believed as far as what is already known can tell them from wrong ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/adjustment/bundle_problem.hpp"
#include "core/adjustment/card_prior.hpp"
#include "core/adjustment/table_consensus.hpp"
#include "core/base/status.hpp"
#include "core/dish/dish_model.hpp"
#include "core/dish/dish_pose.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/tracking/point_track.hpp"

namespace traygauge {

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.04 points at most
// (tests/evaluation/numbers.tsv), but for half of min_track_sigma_px: 0.10.
struct BundleParams {
  // A card on a table: crumbs, a bent corner. Degrees about each axis, and mm on top of its thickness: 0.1 mm
  // under one of the long sides of an ID-1 card tilts it by 0.1 degrees.
  double card_tilt_sigma_deg = 0.1;
  double card_raised_sigma_mm = 0.1;
  double min_track_sigma_px = 0.05;  // below it lens calibration and rolling edges decide
  // Roughness of a table: paper, weave, grooves. Points that differ by more are no table.
  double table_flatness_mm = 0.15;
  // How many times worse than stated the tracks may be before they count as wrong rather than as noisy.
  double max_noise_factor = 3.0;
  bool use_tracks = true;
  bool use_table = true;
  bool use_rims = true;
  TableConsensusParams table;
  int iterations = 4;  // of each of the four rounds of weighing and refining
  // Of the tracks on dishes; below it the dishes moved against the card.
  double min_dish_inlier_fraction = 0.3;
  DishPoseParams placement;
};

// A dish to be placed. `candidates`: the one described, or all that are known.
struct BundleDish {
  DishOutlines outlines;
  std::span<const DishModel> candidates;
};

struct BundleInput {
  std::array<CardPrior, 2> cards;
  Vec3 card_middle_mm = Vec3::Zero();  // of the print, in the table frame
  std::span<const PointTrack> tracks;
  std::span<const BundleDish> dishes;
  FocalsPx focals_px{};  // mean focal length of each stored picture
};

// What one kind of measurement had to say.
struct TermReport {
  int count = 0;
  int inliers = 0;
  double rms = 0.0;  // of the inliers, px; for the card: deviations in standard deviations
};

struct BundleDishResult {
  Status status = StatusCode::rim_not_found;  // as fit_dish_pose
  PlacedDish placed;                          // its covariance includes that of the cameras
  // The place's answer to a step of the cameras, so that both vary together.
  Eigen::Matrix<double, kPlaceParameters, kCameraParameters> place_by_cameras =
      Eigen::Matrix<double, kPlaceParameters, kCameraParameters>::Zero();
};

struct BundleResult {
  TableCameras camera_from_table;  // z = 0 is the table, whatever the card lies like
  CardTilt card;
  BundleMatrix covariance = BundleMatrix::Zero();         // of steps as in BundleProblem
  std::array<BundleDishResult, kMaxPlacedDishes> dishes;  // in the order of the input
  TermReport cards;
  TermReport lines;       // all tracks off their epipolar lines
  TermReport dish_lines;  // those of them that are neither background nor card
  TermReport table;       // background along its line
  TermReport rims;
  double track_noise_factor = 1.0;  // of the tracks' errors against what they state
  int iterations = 0;
};

struct BundleWorkspace {
  std::span<TrackWeight> weights;
  std::span<double> magnitudes;
  std::span<TableSighting> sightings;
  std::span<BundleRim> rims;
  std::span<PlaceElimination> eliminations;
  DishPoseWorkspace placement;

  // `max_outline_points`: of one dish in one view.
  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t max_tracks, std::size_t max_outline_points) {
    weights = arena.template take<TrackWeight>(max_tracks);
    magnitudes = arena.template take<double>(max_tracks);
    sightings = arena.template take<TableSighting>(max_tracks);
    rims = arena.template take<BundleRim>(kMaxPlacedDishes);
    eliminations = arena.template take<PlaceElimination>(kMaxPlacedDishes);
    placement.allocate(arena, max_outline_points);
  }
};

// Tracks beyond the workspace's capacity are left out, as are dishes beyond kMaxPlacedDishes. A dish that
// could not be placed carries its own status and has no say. card_not_found: an alignment that is not finite
// or has no information; pose_contradicts_card: most of what is tracked on the dishes moved otherwise than
// the card.
Status adjust_bundle(const BundleInput& input, const BundleParams& params, BundleWorkspace& workspace,
                     BundleResult& result);

}  // namespace traygauge
