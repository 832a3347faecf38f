// The reference card: found in both views by its pattern, it gives scale and table (paper III-A-3).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/random.hpp"
#include "core/base/status.hpp"
#include "core/geometry/geometry.hpp"
#include "core/paper/base/half_sample_mode.hpp"

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

struct CardModelSize {
  double width_mm = 85.60;  // ISO/IEC 7810 ID-1
  double height_mm = 53.98;
  double thickness_mm = 0.8;  // the print lies that much above the table

  double length_mm() const { return std::max(width_mm, height_mm); }
  double area_mm2() const { return width_mm * height_mm; }
};

// Where a pixel of the pattern's picture (`pattern_width_px` wide, centres at integers) lies on the card.
inline Vec2 pattern_mm(const Vec2& pixel, int pattern_width_px, const CardModelSize& size) {
  return (pixel.array() + 0.5).matrix() * (size.width_mm / pattern_width_px);
}

// Which matches make a track of a match between the views.
enum class TrackRule : std::uint8_t {
  triangle,  // both ends match the same point of the pattern (paper)
  one_side,  // one end does and the other matches nothing else; the homography confirms it
};

// What the card is sought as.
enum class CardModel : std::uint8_t {
  homography,     // eight degrees of freedom (paper)
  absolute_pose,  // a calibrated view of a card of known size: six (the paper's alternative, V-A-3)
};

struct CardDetectionParams {
  CardModel model = CardModel::homography;
  double inlier_share = 0.03;      // inlier distance on the pattern, as a share of the card's length (paper)
  int min_tracks = 8;              // fewer inliers are no card: four fit any homography, four more confirm it
  double max_false_alarms = 1e-2;  // expected number of homographies as good among random matches
  double min_spread_share = 0.05;  // least standard deviation of the inliers' places, of the card's length
  double min_triangle_share = 0.002;  // flattest triangle of a sample, of the card's area
  double max_skew = 0.2;  // how far the sides' lengths and angle may be off those of a rigid card (0: exact)
  double min_tilt_cosine = 0.17;   // between the card's normal and the view: 80 degrees, print unreadable
  double min_distance_mm = 100.0;  // of the card from the camera
  double max_distance_mm = 3000.0;
  double confidence = 0.999;  // that one sample was free of outliers
  int min_iterations = 50;
  int max_iterations = 2000;
  int refit_rounds = 3;  // least squares on the inliers, then inliers anew
};

struct CardPoseParams {
  int iterations = 20;      // Levenberg-Marquardt; it converges in about five
  bool try_flipped = true;  // a small plane has two nearly equal poses; start from both
};

enum class ScaleMethod : std::uint8_t {
  half_sample_mode,  // of the ratios of distances (paper: their mode)
  median,            // of the same ratios
  card_motion,       // length of the card's own motion between the views, from its absolute poses
};

struct ScaleParams {
  ScaleMethod method = ScaleMethod::half_sample_mode;
  ModeParams mode;
  double min_distance_share = 0.25;  // pairs of points nearer than this share of the card's length are noise
  int min_pairs = 10;                // fewer have no mode
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
  double min_inlier_share = 0.5;   // of the card's points: fewer and most of the cloud there is wrong
  double min_tilt_cosine = 0.17;   // between the plane's normal and the view, as in detection
  double min_spread_share = 0.05;  // as in detection: nearly collinear points have no plane
  int refits = 4;                  // rounds of least squares and new inliers
  double confidence = 0.999;
  int min_iterations = 50;
  int max_iterations = 500;
};

struct CardParams {
  TrackRule tracks = TrackRule::triangle;
  CardDetectionParams detection;
  CardPoseParams pose;
  ScaleParams scale;
  CardPlaneParams plane;
};

inline constexpr int kMaxScalePairs = 20000;  // above, pairs are drawn at random: more do not move the mode

// Scratch for up to `max_tracks` tracks; find_card's inliers live here until its next call.
struct CardWorkspace {
  std::span<std::uint8_t> inliers;
  std::span<std::uint8_t> trial_inliers;
  std::span<std::int32_t> indices;
  std::span<Vec3> points_mm;
  std::span<double> ratios;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_tracks, int max_pairs = kMaxScalePairs) {
    const auto count = static_cast<std::size_t>(max_tracks);
    inliers = arena.template take<std::uint8_t>(count);
    trial_inliers = arena.template take<std::uint8_t>(count);
    indices = arena.template take<std::int32_t>(count);
    points_mm = arena.template take<Vec3>(count);
    ratios = arena.template take<double>(static_cast<std::size_t>(max_pairs));
  }
};

}  // namespace traygauge
