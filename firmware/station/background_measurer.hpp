// Measures in a thread of its own, so that the station's loop can look after the next tray meanwhile.
#pragma once

#include <semaphore>
#include <thread>

#include "firmware/station/measurer.hpp"

namespace traygauge {

// `measurer` outlives it. Between begin_measuring() and the result nothing else is called.
class BackgroundMeasurer final : public Measurer {
 public:
  explicit BackgroundMeasurer(Measurer& measurer);
  ~BackgroundMeasurer() override;

  void begin_scan(const TrayHint& hint) override { measurer_.begin_scan(hint); }
  Status add_view(const StationView& view) override { return measurer_.add_view(view); }
  const Measurement& measure() override { return measurer_.measure(); }
  void begin_measuring() override;
  const Measurement* await_measurement(Nanoseconds timeout) override;
  bool can_guide() const override { return measurer_.can_guide(); }
  std::optional<double> turned_deg(const FrameView& live) override { return measurer_.turned_deg(live); }
  std::optional<LensSpot> lens_spot() const override { return measurer_.lens_spot(); }
  std::string_view tray_name() const override { return measurer_.tray_name(); }

 private:
  void work();

  Measurer& measurer_;
  std::binary_semaphore wanted_{0};
  std::binary_semaphore done_{0};
  bool ends_ = false;                    // written before wanted_
  const Measurement* result_ = nullptr;  // written before done_
  std::thread thread_;
};

}  // namespace traygauge
