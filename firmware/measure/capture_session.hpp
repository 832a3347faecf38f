// One pair of a capture through one estimator.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pipeline/estimator.hpp"
#include "firmware/base/aligned_block.hpp"
#include "firmware/measure/measure_report.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "firmware/segment/pair_labels.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

// Loads the pictures of the pair and builds the estimator for them; both live as long as the session. Throws
// InputError.
class CaptureSession {
 public:
  // `dishes`: those of the tray, or candidates for its only one.
  // `parameters` carries those of the stages; its camera, card and dishes are replaced by the capture's.
  CaptureSession(const Capture& capture, std::array<int, 2> pair, const std::vector<DishDescription>& dishes,
                 const Configuration& parameters = {}, LabelSource labels = LabelSource::given);

  // The views of `measurement` point into the session.
  const Measurement& measure(std::uint64_t seed, StageTap* tap = nullptr);

  const Estimator& estimator() const { return estimator_; }
  // For measurements from points that other programs found.
  Estimator& estimator() { return estimator_; }
  ViewInput input(std::size_t i) const;
  const PairSetup& setup() const { return setup_; }
  const LoadedView& view(int i) const { return views_[static_cast<std::size_t>(i)]; }
  const LensModel& lens(int i) const { return setup_.lenses[static_cast<std::size_t>(i)]; }
  // Of the segmentation, where that drew the labels; else null.
  const PairLabels* drawn() const { return drawer_ ? &drawer_->drawn() : nullptr; }
  // The capture's own labels where the segmentation drew others; else empty pictures.
  const std::array<Picture, 2>& given_labels() const { return given_labels_; }
  // Doubts about the input that do not stop a measurement.
  const std::vector<ReportedWarning>& warnings() const { return warnings_; }

 private:
  void check_inputs(const Capture& capture);
  void draw_labels();

  std::array<const ViewDescription*, 2> descriptions_{};
  std::array<LoadedView, 2> views_;
  PairSetup setup_;
  std::vector<ReportedWarning> warnings_;
  Configuration configuration_;
  AlignedBlock block_;
  Estimator estimator_;
  std::optional<LabelDrawer> drawer_;
  std::array<Picture, 2> given_labels_;
};

}  // namespace traygauge
