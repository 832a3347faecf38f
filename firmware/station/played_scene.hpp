// What played captures know beside their pictures.
#pragma once

#include "core/pipeline/configuration.hpp"
#include "firmware/station/estimator_measurer.hpp"
#include "simulator/devices/capture_source.hpp"
#include "simulator/devices/tray_player.hpp"

namespace traygauge {

// Captures with what is needed to measure them.
class MeasurableCaptures : public CaptureSource {
 public:
  // Camera, card and dishes of the open capture, at an address of its own for each capture.
  virtual const Configuration& configuration() const = 0;
  // The camera of view 0 or 1 of the pair, where the view carries one of its own.
  virtual std::optional<LensModel> lens(int view) const = 0;
  // Holds every capture.
  virtual FrameLimits limits() const = 0;
  // Whether any capture is played without labels.
  virtual bool needs_labels() const = 0;
};

// All outlive the scene.
class PlayedScene final : public Scene {
 public:
  PlayedScene(const MeasurableCaptures& captures, const TrayPlayer& player)
      : captures_(captures), player_(player) {}

  const Configuration* configuration() override {
    return player_.has_tray() ? &captures_.configuration() : nullptr;
  }
  std::span<const DishModel> dishes(const TrayHint& /*hint*/) override {
    return captures_.configuration().dishes;
  }
  // The arm's angle counts only where one was recorded: without, the simulated arm's has nothing to do with
  // where the camera stood. An arm that stands elsewhere shows the nearest recorded view: what it says of
  // itself is then as far from that view as it is from the truth.
  ViewInput describe(const StationView& view) override {
    ViewInput input;
    input.frame = view.frame;
    const auto played = player_.find_played(view.sequence);
    if (!played) return input;
    input.labels = captures_.pair()[static_cast<std::size_t>(played->view)].labels;
    input.lens = captures_.lens(played->view);
    if (player_.second_view_angle_deg() && view.arm_angle_deg) {
      input.arm_angle_deg = *view.arm_angle_deg + played->off_deg;
    }
    return input;
  }
  bool needs_labels() const override { return captures_.needs_labels(); }
  std::string_view tray_name() const override {
    return player_.has_tray() ? captures_.capture_name() : std::string_view();
  }

 private:
  const MeasurableCaptures& captures_;
  const TrayPlayer& player_;
};

}  // namespace traygauge
