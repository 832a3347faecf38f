#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/check/device_check.hpp"
#include "firmware/record/capture_recording.hpp"
#include "firmware/setup/setup_steps.hpp"
#include "firmware/station/hardware.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

constexpr std::uint64_t kMoves = 5;  // two more than the calibration needs

bool turns(SetupSite& site) {
  const StationFile station = site.read();
  const std::unique_ptr<SetupDevices> opened = site.tools.open_devices(station);
  Arm& arm = *opened->devices().arm;
  const Nanoseconds longest = longest_move(*station.arm);
  const bool turned = tell(site, check_homing(arm, longest)) &&
                      tell(site, check_turn(arm, station.arm->second_view_deg, longest)) &&
                      tell(site, check_turn(arm, 0.0, longest));
  arm.stop();
  return turned;
}

bool calibrate_move(SetupSite& site) {
  const StationFile station = site.read();
  require_geometry(station);
  const PassingFolder folder;
  site.dialogue.say(
      "Leave the card where both views see it, and press the button " + std::to_string(kMoves) +
      " times, each time when the lamp says ready: the arm moves, and the card tells by how much.");
  {
    const std::unique_ptr<SetupDevices> opened = site.tools.open_devices(station);
    if (!record_captures(station, opened->devices(), {folder.path(), kMoves, kSetupRetries}, site.stop,
                         site.dialogue.out(), site.dialogue.out()))
      return false;
  }
  std::vector<std::string> arguments = {"arm", site.file.string()};
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    arguments.push_back(entry.path().string());
  return site.tools.run_program("traygauge-calibrate", arguments) == kExitMeasured;
}

bool is_calibrated(SetupSite& site) {
  const StationFile station = site.read();
  if (!station.arm_geometry) return false;
  site.dialogue.say("The arm's move is known: the camera turns by " +
                    fixed(station.arm_geometry->angle_deg(), 2) + " degrees.");
  return site.dialogue.confirm("Has nobody moved camera or arm since?", true);
}

}  // namespace

bool set_up_arm(SetupSite& site) {
  const StationFile station = site.read();
  if (station.second_camera) {
    site.dialogue.say("Two cameras look at the tray: nothing moves.");
    return true;
  }
  if (!station.arm) {
    site.dialogue.say(
        "The file has no [arm]: a hand moves the camera or turns the tray, 15 to 25 degrees, and a second "
        "press takes the second view.");
    return true;
  }
  return try_until_done(site,
                        [&site] { return turns(site) && (is_calibrated(site) || calibrate_move(site)); });
}

}  // namespace traygauge
