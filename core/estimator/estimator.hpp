// Two views in, volumes out (paper Fig. 2): strings the stages together over one block of memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/estimator/configuration.hpp"
#include "core/estimator/measurement.hpp"

namespace traygauge {

// Bytes that an Estimator with these limits takes from its block.
std::size_t required_bytes(const EstimatorLimits& limits);

// One picture to measure. Pixels and labels belong to the caller and stay valid until estimate() returns.
struct ViewInput {
  FrameView frame;
  ImageView<const std::uint8_t> labels;
  std::optional<LensModel> lens;        // a camera of its own; else the configuration's
  std::optional<double> arm_angle_deg;  // commanded, about the arm's axis
};

// Features from another detector, instead of SURF: pixels of the stored picture, descriptors of unit length.
struct GivenFeatures {
  std::span<const Keypoint> keypoints;
  std::span<const Descriptor> descriptors;
};

// A corresponding pair of points, in pixels of the stored pictures.
struct GivenMatch {
  Vec2 first = Vec2::Zero();
  Vec2 second = Vec2::Zero();
};

// Not thread-safe. Nothing allocates after construction.
class Estimator {
 public:
  // `block` holds required_bytes(configuration.limits), aligned to kArenaAlignmentBytes, and outlives the
  // estimator; the card's pattern is read here only. Check status() before use.
  Estimator(std::span<std::byte> block, const Configuration& configuration);

  Status status() const;
  double setup_ms() const;
  std::size_t reserved_bytes() const;
  std::size_t used_bytes() const;  // high-water mark

  // Takes the first, then the second view; computes its features at once. A failure is also what estimate()
  // reports.
  Status add_view(const ViewInput& view);
  // The same with features from elsewhere. `pattern` are features of the card's picture (pixels of that
  // picture).
  Status add_view(const ViewInput& view, const GivenFeatures& features);
  void set_pattern_features(const GivenFeatures& pattern);
  // Replaces matching between the views; call after both add_view. The card's tracks are then the given
  // matches that lie on the card's label and agree with the pattern's features.
  void set_matches(std::span<const GivenMatch> matches);

  // Measures the two views; every call with the same input and seed gives the same bits.
  const Measurement& estimate(std::uint64_t seed);

  // Forgets both views.
  void reset();

 private:
  struct State;
  State* state_ = nullptr;  // in the block
  Status status_;
};

}  // namespace traygauge
