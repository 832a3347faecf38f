#include "firmware/check/check_command.hpp"

#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/check/device_check.hpp"
#include "firmware/check/drift_check.hpp"
#include "firmware/check/view_check.hpp"
#include "firmware/command/program.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "firmware/station/hardware.hpp"
#include "firmware/station/site_scene.hpp"
#include "simulator/capture/picture_file.hpp"

namespace traygauge {
namespace {

CheckResult try_camera(V4l2Camera& camera, TakenPicture& picture) {
  CheckResult result = check_camera(camera, picture);
  if (result.is_good) {
    const CameraCounters& counters = camera.counters();
    result.text = camera.describe_setup() + "; " + result.text + "; " + std::to_string(counters.damaged) +
                  " damaged, " + std::to_string(counters.missed) + " missed";
  }
  return result;
}

CheckResult try_lens(const LensConfig& lens, const V4l2CameraParams& params, const V4l2Camera& camera,
                     const std::string& name) {
  const std::string change = find_lens_change(lens, params, camera.held(CameraControl::focus));
  if (!change.empty()) return {name, false, change};
  return {name, true,
          lens.calibrated_on.empty() ? "described"
                                     : "calibrated on " + lens.calibrated_on + ", nothing has changed since"};
}

CheckResult try_button(GpioTrigger& trigger, const CheckOptions& options, std::ostream& out) {
  if (options.press_s > 0.0) {
    out << "Press the button now." << std::endl;
    return check_press(trigger,
                       std::chrono::round<Nanoseconds>(std::chrono::duration<double>(options.press_s)));
  }
  const DeviceStatus status = trigger.start();
  if (!status.ok()) return describe_failure(trigger, status);
  trigger.stop();
  return {std::string(trigger.description()), true, "the line is free, the contact open"};
}

CheckResult try_geometry(const StationFile& station, Picture& pattern) {
  CheckResult result{"lens and card", true, "described"};
  try {
    require_geometry(station);
    pattern = load_pattern(*station.card);
  } catch (const InputError& error) {
    result.is_good = false;
    result.text = error.what();
  }
  return result;
}

// What the station reads beside: dishes, and labels where there are any.
CheckResult try_trays(const StationFile& station, bool knows_geometry) {
  CheckResult result{"trays", true, "dishes"};
  try {
    const std::vector<DishDescription> library = read_station_dishes(station.file);
    for (const DishDescription& dish : choose_tray_dishes(station, library)) result.text += " " + dish.style;
    if (knows_geometry) const SiteScene scene(station, library);
  } catch (const InputError& error) {
    result.is_good = false;
    result.text = error.what();
  }
  return result;
}

class StationCheck {
 public:
  StationCheck(const CheckOptions& options, std::ostream& out)
      : options_(options), out_(out), station_(read_station_file(options.station)), hardware_(station_) {}

  bool run() {
    knows_geometry_ = tell(try_geometry(station_, pattern_));
    tell(try_trays(station_, knows_geometry_));
    if (station_.handover) tell(check_drift(*station_.handover));
    const bool arm_works = !station_.arm || tell(check_homing(*hardware_.arm(), longest_move(*station_.arm)));
    const auto first = look(hardware_.camera(), station_.camera, station_.lens, "lens");
    if (station_.second_camera) {
      look(*hardware_.second_camera(), *station_.second_camera, station_.second_lens, "second lens");
    }
    tell(try_button(hardware_.trigger(), options_, out_));
    if (!station_.lamp.lines.empty()) tell(check_lamp(hardware_.lamp(), hardware_.clock()));
    if (station_.arm && arm_works) move_arm(first);
    hardware_.camera().stop();
    return all_good_;
  }

 private:
  bool tell(const CheckResult& result) {
    out_ << (result.is_good ? "ok    " : "FAIL  ") << printable(result.device) << ": "
         << printable(result.text) << std::endl;
    all_good_ = all_good_ && result.is_good;
    return result.is_good;
  }
  std::optional<Pose> find_card(const LensConfig& lens) {
    std::optional<Pose> camera_from_table;
    tell(check_card(picture_.frame.view, lens_of(lens.camera), card_of(*station_.card, pattern_),
                    camera_from_table));
    return camera_from_table;
  }
  // The camera, its lens, and the card in its picture.
  std::optional<Pose> look(V4l2Camera& camera, const V4l2CameraParams& params,
                           const std::optional<LensConfig>& lens, const std::string& name) {
    const bool sees = tell(try_camera(camera, picture_));
    std::optional<Pose> camera_from_table;
    if (lens) tell(try_lens(*lens, params, camera, name));
    if (sees && knows_geometry_) camera_from_table = find_card(*lens);
    if (&camera != &hardware_.camera()) camera.stop();
    return camera_from_table;
  }
  void move_arm(const std::optional<Pose>& first) {
    Arm& arm = *hardware_.arm();
    const double second_deg = station_.arm->second_view_deg;
    const Nanoseconds timeout = longest_move(*station_.arm);
    if (tell(check_turn(arm, second_deg, timeout))) {
      if (first && take_pictures(hardware_.camera(), 1, picture_).ok()) {
        if (const auto second = find_card(*station_.lens))
          tell(check_move(*second * first->inverse(), second_deg, station_.arm_geometry));
      }
      tell(check_turn(arm, 0.0, timeout));
    }
    arm.stop();
  }

  const CheckOptions& options_;
  std::ostream& out_;
  StationFile station_;
  Hardware hardware_;
  Picture pattern_;
  TakenPicture picture_;
  bool knows_geometry_ = false;
  bool all_good_ = true;
};

}  // namespace

void add_check_command(Program& program, CheckOptions& options) {
  Command command =
      program.add_command("check", "Try every device of a station and say what is wrong and what to do");
  command.add_option("STATION", options.station, "The station file, see config/station.toml").required();
  command.add_option("--press", options.press_s, "Wait so many seconds for a press of the button")
      .range(0.1, 600.0);
}

int run_check(const CheckOptions& options, std::ostream& out) {
  return StationCheck(options, out).run() ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
