#include "firmware/station/hardware.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>
#include <utility>

#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

std::vector<std::unique_ptr<GpioLine>> make_lamps(const LampConfig& config) {
  std::vector<std::unique_ptr<GpioLine>> lamps;
  for (const GpioLineParams& line : config.lines) lamps.push_back(make_gpio_line(line));
  return lamps;
}

std::unique_ptr<Arm> make_arm(const ArmConfig& config, Clock& clock) {
  if (const auto* serial = std::get_if<SerialArmParams>(&config.kind)) {
    return std::make_unique<SerialArm>(clock, *serial);
  }
  const auto& stepper = std::get<StepperConfig>(config.kind);
  StepperLines lines;
  lines.step = make_gpio_line(stepper.step);
  lines.direction = make_gpio_line(stepper.direction);
  if (stepper.enable) lines.enable = make_gpio_line(*stepper.enable);
  lines.home = make_gpio_line(stepper.home);
  return std::make_unique<StepperArm>(std::move(lines), clock, stepper.motion);
}

void warn_of_changed_lens(const std::optional<LensConfig>& lens, const V4l2CameraParams& params,
                          V4l2Camera& camera, std::ostream& log) {
  if (!lens) return;
  // What keeps it from starting is the station's to tell.
  const bool is_started = camera.start().ok();
  const std::string change =
      find_lens_change(*lens, params, is_started ? camera.held(CameraControl::focus) : std::nullopt);
  if (!change.empty()) log << "Warning: " << camera.description() << ": " << printable(change) << std::endl;
}

}  // namespace

Hardware::Hardware(const StationFile& station)
    : camera_(make_system_video_device(), clock_, station.camera),
      trigger_(make_gpio_line(station.button.line), clock_, station.button),
      lamp_(make_lamps(station.lamp), station.lamp.table),
      arm_(station.arm ? make_arm(*station.arm, clock_) : nullptr) {
  if (station.second_camera) {
    second_camera_.emplace(make_system_video_device(), clock_, *station.second_camera);
  }
}

void warn_of_changed_lenses(const StationFile& station, Hardware& hardware, std::ostream& log) {
  warn_of_changed_lens(station.lens, station.camera, hardware.camera(), log);
  if (station.second_camera)
    warn_of_changed_lens(station.second_lens, *station.second_camera, *hardware.second_camera(), log);
}

std::optional<CalibrationFacts> calibration_facts(const StationFile& station) {
  std::optional<CalibrationFacts> facts;
  for (const std::optional<LensConfig>& lens : {station.lens, station.second_lens}) {
    if (!lens || !lens->grade_percent) continue;
    if (!facts) {
      facts = {*lens->grade_percent, lens->calibrated_on};
      continue;
    }
    facts->grade_percent = std::max(facts->grade_percent, *lens->grade_percent);
    facts->calibrated_on = std::min(facts->calibrated_on, lens->calibrated_on);
  }
  return facts;
}

Nanoseconds longest_move(const ArmConfig& arm) {
  if (const auto* serial = std::get_if<SerialArmParams>(&arm.kind)) return serial->longest_move;
  return longest_move(std::get<StepperConfig>(arm.kind).motion);
}

StationParams hardware_params(const StationFile& station) {
  StationParams params;
  params.last_retry = std::chrono::seconds(1);
  if (station.long_press) params.long_press = *station.long_press;
  if (station.arm_geometry) {
    params.seen_per_commanded =
        station.arm_geometry->angle_deg() / std::abs(station.arm_geometry->commanded_deg);
  }
  if (station.arm) {
    params.second_view_deg = station.arm->second_view_deg;
    params.arm_timeout = longest_move(*station.arm);
  }
  return params;
}

}  // namespace traygauge
