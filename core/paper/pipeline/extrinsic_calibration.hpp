// Extrinsic calibration (paper III-A): salient point matches → relative pose → scale and table from the card.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/random.hpp"
#include "core/base/status.hpp"
#include "core/card/card_detection.hpp"
#include "core/geometry/geometry.hpp"
#include "core/paper/card/card_scale.hpp"
#include "core/paper/matching/matcher.hpp"
#include "core/paper/pipeline/configuration.hpp"
#include "core/paper/pipeline/view_preparation.hpp"
#include "core/paper/pose/motion_search.hpp"
#include "core/paper/pose/relative_pose.hpp"
#include "core/pipeline/measurement.hpp"
#include "core/pipeline/stage_clock.hpp"

namespace traygauge::paper {

// Corresponding points that the caller brought; they replace matching when there are any.
struct GivenCorrespondences {
  BoundedList<RayMatch> matches;
  BoundedList<CardTrack> card_tracks;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Caps& caps) {
    matches =
        BoundedList<RayMatch>(arena.template take<RayMatch>(static_cast<std::size_t>(caps.max_keypoints)));
    card_tracks = BoundedList<CardTrack>(
        arena.template take<CardTrack>(static_cast<std::size_t>(caps.max_pattern_keypoints)));
  }
};

struct ExtrinsicInput {
  const PreparedView* first = nullptr;
  const PreparedView* second = nullptr;
  FeatureSet pattern;                // of the card's printed side
  std::span<const Vec2> pattern_mm;  // where each lies on it
  const GivenCorrespondences* given = nullptr;
  MotionSearch* motion_search = nullptr;  // null: RANSAC
};

// What the dense stages need; in the first camera and in mm.
struct Extrinsics {
  Pose second_from_first;
  Plane table;
  BoundedList<RayMatch> inliers;
  BoundedList<Vec3> card_points;
  bool pose_from_card = false;
  bool matches_capped = false;
};

// Memory of the two lists, apart because a struct with Eigen members cannot be planned at compile time.
struct ExtrinsicStorage {
  std::span<RayMatch> inliers;
  std::span<Vec3> card_points;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Caps& caps) {
    inliers = arena.template take<RayMatch>(static_cast<std::size_t>(caps.max_keypoints));
    card_points = arena.template take<Vec3>(static_cast<std::size_t>(caps.max_pattern_keypoints));
  }
};

struct ExtrinsicWorkspace {
  MatcherWorkspace matcher;
  BoundedList<Match> view_matches;
  BoundedList<Match> first_pattern_matches;
  BoundedList<Match> second_pattern_matches;
  std::span<RayMatch> rays;
  std::span<std::uint8_t> inliers;
  std::span<std::uint8_t> card_motion_inliers;
  std::span<std::uint8_t> triangulated;
  std::span<Vec3> cloud;
  RelativePoseWorkspace pose;
  BoundedList<CardTrack> tracks;
  CardScaleWorkspace card;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    const Caps& caps = configuration.caps;
    const auto matches = static_cast<std::size_t>(caps.max_keypoints);
    const auto pattern = static_cast<std::size_t>(caps.max_pattern_keypoints);
    view_matches = BoundedList<Match>(arena.template take<Match>(matches));
    first_pattern_matches = BoundedList<Match>(arena.template take<Match>(pattern));
    second_pattern_matches = BoundedList<Match>(arena.template take<Match>(pattern));
    rays = arena.template take<RayMatch>(matches);
    inliers = arena.template take<std::uint8_t>(matches);
    card_motion_inliers = arena.template take<std::uint8_t>(matches);
    triangulated = arena.template take<std::uint8_t>(matches);
    cloud = arena.template take<Vec3>(matches);
    tracks = BoundedList<CardTrack>(arena.template take<CardTrack>(pattern));
    matcher.allocate(arena, caps.max_keypoints);
    pose.allocate(arena, matches, static_cast<std::size_t>(configuration.pose.noise_sample));
    card.allocate(arena, caps.max_pattern_keypoints);
  }
};

// Fills `extrinsics` and the sparse part of the report as far as it comes.
Status calibrate_extrinsics(const ExtrinsicInput& input, const Configuration& configuration, Random& random,
                            ExtrinsicWorkspace& workspace, StageClock& clock, MeasurementReport& report,
                            Extrinsics& extrinsics);

}  // namespace traygauge::paper
