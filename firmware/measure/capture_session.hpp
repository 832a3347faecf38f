// One pair of a capture through the estimator of a profile.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/pipeline/tray_estimator.hpp"
#include "firmware/base/aligned_block.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/measure/measure_report.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "firmware/paper/paper_profile.hpp"
#include "firmware/segment/label_source.hpp"
#include "firmware/segment/pair_labels.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

// Loads the pictures of the pair and builds the estimator for them; both live as long as the session. Throws
// InputError.
class CaptureSession {
 public:
  // `dishes`: those of the tray, or candidates for its only one. Labels that are to be found are found here.
  CaptureSession(const Capture& capture, std::array<int, 2> pair, const std::vector<DishDescription>& dishes,
                 const ProfileParameters& parameters = {}, LabelSource labels = LabelSource::given);

  // The views of `measurement` point into the session. Profile paper shows nothing to `observer`.
  const Measurement& measure(std::uint64_t seed, StageObserver* observer = nullptr);

  // Pictures and mesh of the last measurement; null unless the profile is paper.
  const paper::WorkingPictures* pictures() const { return paper_ ? &paper_->pictures() : nullptr; }
  // For measurements from points that other programs found; profile paper alone.
  paper::Estimator& paper_estimator() { return paper_->estimator(); }

  double setup_ms() const { return paper_ ? paper_->setup_ms() : tray_->setup_ms(); }
  std::size_t reserved_bytes() const;
  std::size_t used_bytes() const;

  // As the capture has it, without labels where these are to be found.
  ViewInput input(std::size_t i) const;
  const PairSetup& setup() const { return setup_; }
  // Reduced where it is larger than what is measured (view_reduction.hpp), as is lens().
  const LoadedView& view(int i) const { return views_[static_cast<std::size_t>(i)]; }
  const LensModel& lens(int i) const { return setup_.lenses[static_cast<std::size_t>(i)]; }
  // What was found, where labels were to be found; else null.
  const PairLabels* drawn() const { return drawn_ ? &*drawn_ : nullptr; }
  // The capture's own labels where others were found; else empty pictures.
  const std::array<Picture, 2>& given_labels() const { return given_labels_; }
  // Doubts about the input that do not stop a measurement.
  const std::vector<ReportedWarning>& warnings() const { return warnings_; }

 private:
  void reduce_large_views();
  void check_inputs();
  void build_estimators(const Capture& capture, const ProfileParameters& parameters, LabelSource labels);
  void find_labels();
  const Measurement& measure_found_labels(std::uint64_t seed);

  std::array<const ViewDescription*, 2> descriptions_{};
  std::array<LoadedView, 2> views_;
  PairSetup setup_;
  std::vector<ReportedWarning> warnings_;
  std::optional<AlignedBlock> tray_block_;
  std::optional<TrayEstimator> tray_;  // unless profile paper measures given labels
  std::unique_ptr<PaperEstimator> paper_;
  std::optional<PairLabels> drawn_;
  std::array<Picture, 2> given_labels_;
  Measurement measurement_;  // of profile paper on labels that were found
};

}  // namespace traygauge
