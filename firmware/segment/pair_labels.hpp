// The label pictures of a pair, drawn by the segmentation, and what is measured with them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/pipeline/estimator.hpp"
#include "core/pipeline/segmenter.hpp"
#include "firmware/base/aligned_block.hpp"
#include "firmware/segment/label_source.hpp"
#include "simulator/capture/picture.hpp"

namespace traygauge {

struct PairLabels {
  std::array<Picture, 2> labels;
  Segmentation segmentation;
  std::size_t working_bytes = 0;   // that drawing needs
  std::size_t reserved_bytes = 0;  // of these, beside the estimator's
};

// Takes its memory once; nothing is allocated while it draws. Where the estimator has enough, it works in the
// estimator's.
class LabelDrawer {
 public:
  // For cameras, cards and dishes within the limits of `configuration`, and its parameters.
  explicit LabelDrawer(const Configuration& configuration);

  // What the next pairs show; `estimator` is to measure them and is of the same configuration. The dishes are
  // referred to.
  void configure(const Configuration& configuration, const Estimator& estimator);
  // Forgets both views. After measure() and before the next pair.
  void reset();
  // How much of the estimator's idle memory, from its beginning, nobody else may touch from reset() to
  // measure().
  std::size_t borrowed_bytes() const { return drawn_.working_bytes - drawn_.reserved_bytes; }
  // Takes the first, then the second view, whose labels are not looked at, and draws after the second. Its
  // grey picture goes to the estimator. What fails here is also what measure() reports.
  Status add_view(const ViewInput& view, const Estimator& estimator);
  // The segmentation's outcome after both views.
  const PairLabels& drawn() const { return drawn_; }

  // Measures both views with the labels drawn. Valid until the next call of any function.
  const Measurement& measure(Estimator& estimator, std::uint64_t seed, StageTap* tap = nullptr);

 private:
  void take_memory(const Estimator& estimator);

  Configuration configuration_;
  std::optional<AlignedBlock> block_;  // for estimators that lend none
  std::span<std::byte> memory_;        // the segmenter's
  // For estimators that keep none.
  std::optional<AlignedBlock> pattern_block_;
  CardPattern pattern_;
  std::array<Picture, 2> gray_;

  const CardPattern* learned_ = nullptr;

  std::optional<Segmenter> segmenter_;
  std::array<ViewInput, 2> views_;
  std::size_t view_count_ = 0;
  PairLabels drawn_;
  Measurement measurement_;
};

}  // namespace traygauge
