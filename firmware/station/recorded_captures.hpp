// Capture folders for the simulated devices and for the measurement of what they show.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "firmware/measure/pair_setup.hpp"
#include "firmware/segment/label_source.hpp"
#include "firmware/station/open_captures.hpp"
#include "firmware/station/played_scene.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

class RecordedCaptures final : public MeasurableCaptures {
 public:
  // Reads every capture.json and card pattern; throws InputError and UsageError. Captures without a dish take
  // those of the usual config folder.
  RecordedCaptures(const std::vector<std::filesystem::path>& folders, const LabelChoice& labels = {});

  std::size_t capture_count() const override { return recordings_.size(); }
  CameraFormat largest_frame() const override { return largest_; }
  bool open(std::size_t index) override;
  std::string_view problem() const override { return problem_; }
  std::string_view capture_name() const override { return open_->name; }
  const std::array<PlayedView, 2>& pair() const override { return pair_; }

  const Configuration& configuration() const override { return open_->configuration; }
  std::optional<LensModel> lens(int view) const override {
    return open_->setup.lenses[static_cast<std::size_t>(view)];
  }
  FrameLimits limits() const override;
  bool needs_labels() const override { return needs_labels_; }

 private:
  struct Recording {
    std::string name;
    LabelSource labels = LabelSource::given;
    std::array<ViewDescription, 2> views;
    PairSetup setup;
    Configuration configuration;  // refers to the setup
  };
  void add(const std::filesystem::path& folder, const LabelChoice& labels);

  std::vector<std::unique_ptr<Recording>> recordings_;
  CameraFormat largest_{0, 0, PixelFormat::bgr8};
  bool needs_labels_ = false;
  const Recording* open_ = nullptr;
  std::array<LoadedView, 2> loaded_;
  std::array<PlayedView, 2> pair_;
  std::string problem_;
};

}  // namespace traygauge
