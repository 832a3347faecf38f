// The reference card as points that were matched with its pattern, and how it is found among them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/random.hpp"
#include "core/base/status.hpp"
#include "core/card/card_size.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

// A point of the card seen in both views: where on the pattern (mm, origin at its top left corner, y down),
// and along which ray of each view.
struct CardTrack {
  Vec2 pattern_mm = Vec2::Zero();
  Vec2 first = Vec2::Zero();
  Vec2 second = Vec2::Zero();
  Vec3 point_in_first = Vec3::Zero();  // of the sparse cloud, in baselines
};

// The view whose rays a function takes: &CardTrack::first or &CardTrack::second.
using CardView = Vec2 CardTrack::*;

// What the card is sought as.
enum class CardModel : std::uint8_t {
  homography,     // eight degrees of freedom (paper)
  absolute_pose,  // a calibrated view of a card of known size: six (the paper's alternative, V-A-3)
};

// Half or twice of any number here changes no volume of six pairs of the captures with found outlines
// (tests/evaluation/numbers.tsv), but for inlier_fraction, and twice of min_tracks and max_skew.
struct CardDetectionParams {
  CardModel model = CardModel::homography;
  double inlier_fraction = 0.03;   // inlier distance on the pattern, as a share of the card's length (paper)
  int min_tracks = 8;              // fewer inliers are no card: four fit any homography, four more confirm it
  double max_false_alarms = 1e-2;  // expected number of homographies as good among random matches
  double min_spread_fraction = 0.05;  // least standard deviation of the inliers' places, of the card's length
  double min_triangle_fraction = 0.002;  // flattest triangle of a sample, of the card's area
  double max_skew = 0.2;  // how far the sides' lengths and angle may be off those of a rigid card (0: exact)
  // Of the card from the camera: an ID-1 card fills 46 degrees at the first, and has 40 px at the second with
  // a focal length of 1400 px.
  double min_distance_mm = 100.0;
  double max_distance_mm = 3000.0;
  double confidence = 0.999;  // that one sample was free of outliers
  int min_iterations = 50;    // before the share of inliers, which bounds their number, is believed
  int max_iterations = 2000;  // by then four of a sample are right at that confidence if 24 % of all are
  int refit_rounds = 3;       // least squares on the inliers, then inliers anew
};

struct CardPoseParams {
  bool try_flipped = true;  // a small plane has two nearly equal poses; start from both
};

struct CardParams {
  CardDetectionParams detection;
  CardPoseParams pose;
};

// Scratch for up to `max_tracks` tracks; find_card's inliers live here until its next call.
struct CardWorkspace {
  std::span<std::uint8_t> inliers;
  std::span<std::uint8_t> trial_inliers;
  std::span<std::int32_t> indices;
  std::span<Vec3> points_mm;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_tracks) {
    const auto count = static_cast<std::size_t>(max_tracks);
    inliers = arena.template take<std::uint8_t>(count);
    trial_inliers = arena.template take<std::uint8_t>(count);
    indices = arena.template take<std::int32_t>(count);
    points_mm = arena.template take<Vec3>(count);
  }
};

}  // namespace traygauge
