// Two views of a tray in, with labels or without; dishes, items, volumes and sigmas out, over one block of
// memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/pipeline/configuration.hpp"
#include "core/pipeline/measurement.hpp"
#include "core/pipeline/segmentation.hpp"
#include "core/pipeline/view_input.hpp"

namespace traygauge {

struct EstimatorState;
class StageObserver;

// Bytes that an estimator with this configuration takes from its block; estimator_state_bytes() of them for
// its own state, at the block's head.
std::size_t required_bytes(const Configuration& configuration);
std::size_t estimator_state_bytes();

// Not thread-safe. Nothing allocates, construction included.
class TrayEstimator {
 public:
  // `block` holds required_bytes(configuration), aligned to kArenaAlignmentBytes, and outlives the estimator.
  // The card's pattern is read here only. Check status() before use.
  TrayEstimator(std::span<std::byte> block, const Configuration& configuration);

  Status status() const { return status_; }
  double setup_ms() const;
  std::size_t reserved_bytes() const;  // size of the block
  std::size_t used_bytes() const;      // most of it that was ever handed out

  // Of the trays whose views come next: their dishes, as in TraySetup, and how many foods lie on each where
  // they are found (0: as many as are found). Else as configured. invalid_configuration, wrong_call (between
  // two views) and a failed status change nothing.
  Status expect(std::span<const DishModel> dishes, int items);

  // Takes the first, then the second view. Where the first has no labels, those of both are found: the card
  // at once, dishes and food with the second view. What fails here is also what estimate() reports.
  // wrong_call, which changes nothing: a third view.
  Status add_view(const ViewInput& input);

  // Measures the two views, as often as is liked; the same input and seed give the same bits. Where card and
  // dishes contradict each other, some other lenses are tried, which takes three to five times as long. Shows
  // the stages of the views as given to `observer`, which may be null.
  const Measurement& estimate(std::uint64_t seed, StageObserver* observer = nullptr);

  // What was found where no labels were given; null where they were. Valid until reset().
  const Segmentation* segmentation() const;
  // Of the view added first or second, given or found; empty before it was added.
  ImageView<const std::uint8_t> labels(std::size_t view) const;

  // Memory for others between two calls; its contents are undefined after each.
  std::span<std::byte> scratch() const;

  // Forgets both views.
  void reset();

 private:
  enum class Extent : std::uint8_t { located, measured };  // locate_tray() alone, or measure_tray()
  void measure(std::uint64_t seed, StageObserver* observer, Extent extent = Extent::measured);
  void doubt_lens(std::uint64_t seed);
  void take_again(const std::array<ViewInput, 2>& inputs);

  EstimatorState* state_ = nullptr;  // in the block
  Status status_;
  Measurement measurement_;
};

}  // namespace traygauge
