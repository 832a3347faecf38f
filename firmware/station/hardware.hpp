// The devices that a station file describes.
#pragma once

#include <iosfwd>
#include <memory>
#include <optional>

#include "firmware/config/station_file.hpp"
#include "firmware/handover/station_facts.hpp"
#include "firmware/station/station.hpp"

namespace traygauge {

class Hardware {
 public:
  // Nothing is opened yet.
  explicit Hardware(const StationFile& station);

  StationDevices devices() { return {camera_, trigger_, arm_.get(), lamp_, clock_, second_camera()}; }
  V4l2Camera& camera() { return camera_; }
  V4l2Camera* second_camera() { return second_camera_ ? &*second_camera_ : nullptr; }
  GpioTrigger& trigger() { return trigger_; }
  GpioIndicator& lamp() { return lamp_; }
  Arm* arm() { return arm_.get(); }  // null: there is none
  Clock& clock() { return clock_; }

 private:
  SystemClock clock_;
  V4l2Camera camera_;
  std::optional<V4l2Camera> second_camera_;
  GpioTrigger trigger_;
  GpioIndicator lamp_;
  std::unique_ptr<Arm> arm_;
};

// Warns of lenses that have changed since they were calibrated, a line each, and that pictures are measured
// with them all the same. Starts the cameras, for their focus.
void warn_of_changed_lenses(const StationFile& station, Hardware& hardware, std::ostream& log);

// What is known of how good the lenses are: the worse grade, and the earlier day. Nothing where none has a
// grade.
std::optional<CalibrationFacts> calibration_facts(const StationFile& station);

// How long going home or any move may take.
Nanoseconds longest_move(const ArmConfig& arm);

// What a loop on hardware does otherwise than one in simulated time: a device that is plugged in again works
// within three seconds.
StationParams hardware_params(const StationFile& station);

}  // namespace traygauge
