// The measurement that the station runs: core's estimator, fed with what is known of the tray.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/pipeline/tray_estimator.hpp"
#include "firmware/base/aligned_block.hpp"
#include "firmware/card/card_guide.hpp"
#include "firmware/station/measurer.hpp"

namespace traygauge {

// What the station knows beside the pictures. A played capture brings it along.
class Scene {
 public:
  Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  virtual ~Scene() = default;

  // Camera, card and dishes for the tray that lies there now, valid until the next call; the same address
  // means the same content. Null when nothing is known of it; its limits are not looked at.
  virtual const Configuration* configuration() = 0;
  // The dishes of a tray of which that is known, valid until the next call; else the configuration's.
  virtual std::span<const DishModel> dishes(const TrayHint& hint) = 0;
  // The view with its labels and, where they are known, its own camera and the arm's angle. Without labels
  // they are found.
  virtual ViewInput describe(const StationView& view) = 0;
  // Whether any tray's views come without labels.
  virtual bool needs_labels() const = 0;
  virtual std::string_view tray_name() const = 0;
};

// Takes its memory once, for `limits`, and where the scene needs it for finding labels; nothing is allocated
// during a scan.
class EstimatorMeasurer final : public Measurer {
 public:
  EstimatorMeasurer(Scene& scene, const FrameLimits& limits, std::uint64_t seed);

  void begin_scan(const TrayHint& hint) override;
  Status add_view(const StationView& view) override;
  const Measurement& measure() override;
  bool can_guide() const override { return true; }
  std::optional<double> turned_deg(const FrameView& live) override;
  std::optional<LensSpot> lens_spot() const override { return lens_watch_.spot(); }
  std::string_view tray_name() const override { return scene_.tray_name(); }

 private:
  void watch_lens();
  Status expect(const Configuration& configuration, const TrayHint& hint);

  Scene& scene_;
  FrameLimits limits_;
  std::uint64_t seed_;
  AlignedBlock block_;
  const Configuration* configured_with_ = nullptr;
  std::optional<TrayEstimator> estimator_;
  Status status_ = StatusCode::wrong_call;  // whether it can measure this tray
  Measurement unmeasured_;                  // where it cannot
  CardGuide guide_;
  std::array<StationView, 2> views_;  // of this scan
  std::size_t view_count_ = 0;
  LensWatch lens_watch_;
  std::optional<ViewInput> first_view_;  // until guide_ knows it
};

}  // namespace traygauge
