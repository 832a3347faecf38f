// Scale and table from the card's points of the sparse cloud (paper III-A-3): parameters and memory.
#pragma once

#include <cstdint>
#include <span>

#include "core/card/card.hpp"
#include "core/paper/base/half_sample_mode.hpp"

namespace traygauge::paper {

// Which matches make a track of a match between the views.
enum class TrackRule : std::uint8_t {
  triangle,  // both ends match the same point of the pattern (paper)
  one_side,  // one end does and the other matches nothing else; the homography confirms it
};

enum class ScaleMethod : std::uint8_t {
  half_sample_mode,  // of the ratios of distances (paper: their mode)
  median,            // of the same ratios
  card_motion,       // length of the card's own motion between the views, from its absolute poses
};

struct ScaleParams {
  ScaleMethod method = ScaleMethod::half_sample_mode;
  ModeParams mode;
  double min_distance_fraction =
      0.25;            // pairs of points nearer than this share of the card's length are noise
  int min_pairs = 10;  // fewer have no mode
  double max_spread =
      0.2;  // interquartile range of the ratios over the scale; beyond it the cloud is not rigid
};

// What the card's plane is taken from.
enum class CardPlaneSource : std::uint8_t {
  sparse_points,  // the card's points of the sparse cloud (paper)
  absolute_pose,  // the card's calibrated pose in the first view
};

struct CardPlaneParams {
  CardPlaneSource source = CardPlaneSource::sparse_points;
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
  TrackRule tracks = TrackRule::triangle;
  ScaleParams scale;
  CardPlaneParams plane;
};

inline constexpr int kMaxScalePairs = 20000;  // above, pairs are drawn at random: more do not move the mode

struct CardScaleWorkspace : CardWorkspace {
  std::span<double> ratios;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_tracks, int max_pairs = kMaxScalePairs) {
    CardWorkspace::allocate(arena, max_tracks);
    ratios = arena.template take<double>(static_cast<std::size_t>(max_pairs));
  }
};

}  // namespace traygauge::paper
