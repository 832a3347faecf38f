// A station's devices, lens and card: config/station.toml.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "drivers/gpio/gpio_indicator.hpp"
#include "drivers/gpio/gpio_trigger.hpp"
#include "drivers/gpio/stepper_arm.hpp"
#include "drivers/serial/serial_arm.hpp"
#include "drivers/v4l2/v4l2_camera.hpp"
#include "firmware/config/hub_tables.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

struct LampConfig {
  std::vector<GpioLineParams> lines;  // empty: there is no lamp
  LampTable table{};
};

struct StepperConfig {
  GpioLineParams step;
  GpioLineParams direction;
  std::optional<GpioLineParams> enable;
  GpioLineParams home;
  StepperArmParams motion;
};

struct ArmConfig {
  std::variant<StepperConfig, SerialArmParams> kind;
  double second_view_deg = 18.0;
};

// What the arm's move to the second view does to the camera, as it was seen: second_from_first.
struct ArmGeometry {
  double commanded_deg = 0.0;
  std::array<double, 3> turn_deg{};  // axis times angle, in the first view's axes
  std::array<double, 3> shift_mm{};

  double angle_deg() const;
};

inline constexpr double kMaxGradePercent = 100.0;  // a lens that is worse has no grade

// A lens as it was calibrated. The camera may have changed since.
struct LensConfig {
  CameraDescription camera;
  std::optional<int> focus;             // the camera's
  std::string calibrated_camera;        // its name; empty: not known
  std::string calibrated_on;            // YYYY-MM-DD; empty: not known
  std::optional<double> grade_percent;  // two standard deviations of a meal's volume by this lens
  std::string changed_on;               // the day on which somebody touched the lens; empty: never
};

struct StationFile {
  std::filesystem::path file;
  V4l2CameraParams camera;
  GpioTriggerParams button;
  std::optional<Nanoseconds> long_press;  // zero: presses are never long; none: the station's default
  LampConfig lamp;
  std::optional<ArmConfig> arm;  // none: a hand moves the camera or the tray
  std::optional<ArmGeometry> arm_geometry;
  std::optional<V4l2CameraParams> second_camera;  // takes the second view; excludes the arm
  std::optional<LensConfig> lens;
  std::optional<LensConfig> second_lens;  // of the second camera
  std::optional<CardDescription> card;
  // Outlines of dish and food, the same for every tray; none: to be found.
  std::optional<std::array<InputFile, 2>> labels;
  // Which dishes stand on every tray, by style, of those known; none: one, whichever it is.
  std::vector<std::string> dishes;
  int items = 0;                           // on every tray; 0: not known
  std::optional<HandoverConfig> handover;  // none: results are printed alone
  bool has_hub = false;                    // [hub] is read by the hub, and checked here
  OnBadConfig on_bad_config = OnBadConfig::keep;
};

// Unknown keys are errors: they are typing mistakes. Paths are relative to `file`; `content` is read, which
// is another file where that is the last good one. Throws InputError.
StationFile read_station_file(const std::filesystem::path& file, const std::filesystem::path& content);
inline StationFile read_station_file(const std::filesystem::path& file) {
  return read_station_file(file, file);
}

// What has changed since a lens was calibrated, and what to do; empty when nothing is known to have. `focus`:
// the camera's now, where it says.
std::string find_lens_change(const LensConfig& lens, const V4l2CameraParams& camera,
                             std::optional<int> focus);

// Throws InputError unless the file has the lenses and the card, without which nothing is measured, and the
// lenses are of pictures of the camera's size.
void require_geometry(const StationFile& station);

}  // namespace traygauge
