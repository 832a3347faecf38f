// Scale and table from the card's points of the sparse cloud (paper III-A-3).
#pragma once

#include <cstdint>
#include <span>

#include "core/base/random.hpp"
#include "core/base/status.hpp"
#include "core/card/card.hpp"
#include "core/geometry/geometry.hpp"
#include "core/paper/base/half_sample_mode.hpp"

namespace traygauge::paper {

struct ScaleParams {
  ModeParams mode;
  double min_distance_fraction =
      0.25;            // pairs of points nearer than this share of the card's length are noise
  int min_pairs = 10;  // fewer have no mode
  double max_spread =
      0.2;  // interquartile range of the ratios over the scale; beyond it the cloud is not rigid
};

struct CardPlaneParams {
  double inlier_mm = 1.0;  // twice the depth noise of 0.3 px at 50 cm over a base of 15 cm
  int min_inliers = 6;
  double min_inlier_fraction = 0.5;   // of the card's points: fewer and most of the cloud there is wrong
  double min_tilt_cosine = 0.17;      // between the plane's normal and the view, as in detection
  double min_spread_fraction = 0.05;  // as in detection: nearly collinear points have no plane
  int refits = 4;                     // rounds of least squares and new inliers
  double confidence = 0.999;
  int min_iterations = 50;
  int max_iterations = 500;
};

struct CardScaleParams : CardParams {
  ScaleParams scale;
  CardPlaneParams plane;
  int few_tracks = 20;  // inliers; fewer: warning
};

inline constexpr std::size_t kMaxScalePairs =
    20000;  // above, pairs are drawn at random: more do not move the mode

struct CardScaleWorkspace : CardWorkspace {
  std::span<double> ratios;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_tracks) {
    CardWorkspace::allocate(arena, max_tracks);
    ratios = arena.template take<double>(kMaxScalePairs);
  }
};

struct ScaleEstimate {
  double mm_per_baseline = 0.0;
  int pairs = 0;        // of points, whose ratios were used
  double spread = 0.0;  // interquartile range of the ratios over the scale
};

// The mode of the ratios of distances on the pattern (mm) over distances in the sparse cloud (baselines),
// over pairs of inliers. scale_not_found with too few pairs or when the ratios scatter too much.
// O(pairs log pairs), drawn at random when the workspace cannot hold all.
Status estimate_scale(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                      double card_length_mm, const ScaleParams& params, Random& random,
                      CardScaleWorkspace& workspace, ScaleEstimate& estimate);

// The plane of the card's print in the first camera's frame, mm: RANSAC over the flagged tracks' points of
// the sparse cloud, then least squares on the inliers. The normal points to the camera; the table is
// `card_plane_in_first.raised(-thickness)`. table_not_found when too few points agree or nearly on a line.
Status fit_card_plane(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                      double card_length_mm, double mm_per_baseline, const CardPlaneParams& params,
                      Random& random, CardScaleWorkspace& workspace, Plane& card_plane_in_first);

}  // namespace traygauge::paper
