// Profile `paper`: two labelled views in, volumes out (paper Fig. 2), over one block of memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/paper/pipeline/configuration.hpp"
#include "core/paper/pipeline/working_pictures.hpp"
#include "core/pipeline/measurement.hpp"
#include "core/pipeline/memory_row.hpp"
#include "core/pipeline/view_input.hpp"

namespace traygauge::paper {

class MotionSearch;
struct EstimatorState;

// Bytes that an Estimator with this configuration takes from its block.
std::size_t required_bytes(const Configuration& configuration);

inline constexpr std::size_t kMemoryRowCount = 8;
// One row a part; the kept rows and the largest shared one add up to required_bytes().
std::array<MemoryRow, kMemoryRowCount> describe_memory(const Configuration& configuration);

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
  Status add_view(const ViewInput& input);
  // The same without features, for set_matches().
  Status add_view_without_features(const ViewInput& input);
  // Replaces matching; after both views. wrong_call before them, and without a match.
  Status set_matches(std::span<const GivenMatch> matches, std::span<const GivenCardMatch> card_matches);
  // `search` looks for the motion in the place of RANSAC, and what it finds is refined as usual; nullptr:
  // RANSAC again. It outlives its use.
  Status set_motion_search(MotionSearch* search);

  // Measures the two views; the same input and seed give the same bits.
  const Measurement& estimate(std::uint64_t seed);
  // Of the last measurement.
  const WorkingPictures& pictures() const;

  // Forgets both views.
  void reset();

 private:
  EstimatorState* state_ = nullptr;  // in the block
  Status status_;
  Measurement measurement_;
};

}  // namespace traygauge::paper
