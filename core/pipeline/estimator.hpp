// Two views in, volumes out (paper Fig. 2): strings the stages together over one block of memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/pipeline/configuration.hpp"
#include "core/pipeline/measurement.hpp"

namespace traygauge {

struct EstimatorState;
class MotionSearch;
class StageTap;

// Bytes that an Estimator with this configuration takes from its block.
std::size_t required_bytes(const Configuration& configuration);
// The same with the default parameters of every stage.
std::size_t required_bytes(const EstimatorLimits& limits, Profile profile);

// One picture to measure. Pixels and labels belong to the caller and stay valid until estimate() returns.
struct ViewInput {
  FrameView frame;
  ImageView<const std::uint8_t> labels;
  std::optional<LensModel> lens;        // a camera of its own; else the configuration's
  std::optional<double> arm_angle_deg;  // commanded, about the arm's axis
  // What a segmentation has made of the frame already; profile best takes it as it is. Grey values as
  // convert_to_gray gives them, and where the card lies.
  ImageView<const std::uint8_t> gray = {};
  const CardAlignment* card = nullptr;
  bool are_outlines_found = false;  // not drawn by a person: less sure
};

// Features from another detector, instead of SURF: pixels of the picture, descriptors of unit length.
struct GivenFeatures {
  std::span<const Keypoint> keypoints;
  std::span<const Descriptor> descriptors;
};

// Corresponding points from elsewhere, in pixels of the stored pictures; a card point also with its place on
// the printed side (mm from the pattern's top left corner).
struct GivenMatch {
  Vec2 first = Vec2::Zero();
  Vec2 second = Vec2::Zero();
};
struct GivenCardMatch {
  Vec2 pattern_mm = Vec2::Zero();
  Vec2 first = Vec2::Zero();
  Vec2 second = Vec2::Zero();
};

// Not thread-safe. Nothing allocates, construction included.
class Estimator {
 public:
  // `block` holds required_bytes(configuration), aligned to kArenaAlignmentBytes, and outlives the estimator.
  // The card's pattern is read here only. Check status() before use.
  Estimator(std::span<std::byte> block, const Configuration& configuration);

  Status status() const { return status_; }
  double setup_ms() const;
  std::size_t reserved_bytes() const;  // size of the block
  std::size_t used_bytes() const;      // most of it that was ever handed out

  // Takes the first, then the second view, and finds its features at once. What fails here is also what
  // estimate() reports. A third view is refused (wrong_call) and changes nothing.
  Status add_view(const ViewInput& view);
  // The same with features from elsewhere; `set_pattern` gives those of the card's picture.
  Status add_view(const ViewInput& view, const GivenFeatures& features);
  Status set_pattern(const GivenFeatures& features, int picture_width_px);
  // The same without features, for set_matches().
  Status add_view_without_features(const ViewInput& view);
  // Replaces matching; after both views. wrong_call before them.
  Status set_matches(std::span<const GivenMatch> matches, std::span<const GivenCardMatch> card_matches);

  // Profile paper: `search` looks for the motion in the place of RANSAC, and what it finds is refined as
  // usual; nullptr: RANSAC again. It outlives its use.
  Status set_motion_search(MotionSearch* search);

  // Measures the two views; the same input and seed give the same bits. Profile best shows `tap` its stages.
  const Measurement& estimate(std::uint64_t seed, StageTap* tap = nullptr);

  // Memory for the grey picture of the first or second view, of the largest frame's size: a segmentation may
  // leave it there before add_view. Empty in profile paper, which keeps none.
  ImageView<std::uint8_t> gray_memory(std::size_t view) const;

  // Where the stages work, aligned for an arena: from one call to the next nothing lies there, so that
  // somebody else may work there meanwhile. Empty in profile paper, and where the configuration is refused.
  std::span<std::byte> idle_memory() const;

  // The card's pattern; null in profile paper, which keeps another, and where the configuration is refused.
  const CardPattern* card_pattern() const;

  // Forgets both views.
  void reset();

 private:
  EstimatorState* state_ = nullptr;  // in the block
  Status status_;
  Measurement measurement_;
};

}  // namespace traygauge
