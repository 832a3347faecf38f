#include "firmware/check/check_command.hpp"

#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/check/device_check.hpp"
#include "firmware/station/hardware.hpp"
#include "simulator/capture/picture_file.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

constexpr Nanoseconds kArmTimeout = 30s;
constexpr Nanoseconds kSignalShown = 300ms;

CheckResult good(const Device& device, const std::string& text) {
  return {std::string(device.description()), true, text};
}

CheckResult try_camera(V4l2Camera& camera, const std::optional<LensConfig>& lens) {
  CheckResult result = check_camera(camera);
  if (result.is_good) {
    const CameraCounters& counters = camera.counters();
    result.text = camera.describe_setup() + "; " + result.text + "; " + std::to_string(counters.damaged) +
                  " damaged, " + std::to_string(counters.missed) + " missed";
  }
  const auto focus = camera.held(CameraControl::focus);
  if (result.is_good && lens && lens->focus && focus && *focus != *lens->focus) {
    result.is_good = false;
    result.text = "The lens was calibrated at focus " + std::to_string(*lens->focus) + " and stands at " +
                  std::to_string(*focus) + "; set camera.focus to the former, or calibrate again.";
  }
  camera.stop();
  return result;
}

CheckResult try_button(GpioTrigger& trigger, const CheckOptions& options, std::ostream& out) {
  DeviceStatus status = trigger.start();
  if (!status.ok()) return describe_failure(trigger, status);
  std::string text = "the line is free, the contact open";
  if (options.press_s > 0.0) {
    out << "Press the button now." << std::endl;
    Press press;
    const auto wait = std::chrono::round<Nanoseconds>(std::chrono::duration<double>(options.press_s));
    status = trigger.wait_for_press(wait, press);
    text = "pressed";
  }
  trigger.stop();
  if (status.code() == DeviceCode::timed_out) {
    return {std::string(trigger.description()), false,
            "No press came; check the wire, active_low and bias of [button]."};
  }
  return status.ok() ? good(trigger, text) : describe_failure(trigger, status);
}

CheckResult try_lamp(GpioIndicator& lamp, Clock& clock) {
  DeviceStatus status = lamp.start();
  for (std::size_t i = 1; status.ok() && i < kSignalCount; ++i) {
    status = lamp.show(static_cast<Signal>(i));
    clock.sleep_for(kSignalShown);
  }
  lamp.stop();
  return status.ok() ? good(lamp, "showed every signal") : describe_failure(lamp, status);
}

CheckResult try_arm(Arm& arm, double second_view_deg) {
  DeviceStatus status = arm.start();
  if (status.ok()) status = arm.home(kArmTimeout);
  if (status.ok()) status = arm.move_to(second_view_deg, kArmTimeout);
  if (status.ok()) status = arm.move_to(0.0, kArmTimeout);
  const CheckResult result = status.ok()
                                 ? good(arm, "home, at " + fixed(second_view_deg, 1) + " degrees and back")
                                 : describe_failure(arm, status);
  arm.stop();
  return result;
}

CheckResult try_geometry(const StationFile& station) {
  CheckResult result{"lens and card", true, "described"};
  try {
    require_geometry(station);
    load_pattern(*station.card);
  } catch (const InputError& error) {
    result.is_good = false;
    result.text = error.what();
  }
  return result;
}

}  // namespace

void add_check_command(CLI::App& app, CheckOptions& options) {
  CLI::App* command =
      app.add_subcommand("check", "Try every device of a station and say what is wrong and what to do");
  command->add_option("STATION", options.station, "The station file, see config/station.toml")->required();
  command->add_option("--press", options.press_s, "Wait so many seconds for a press of the button")
      ->check(CLI::Range(0.1, 600.0));
}

int run_check(const CheckOptions& options, std::ostream& out) {
  const StationFile station = read_station_file(options.station);
  Hardware hardware(station);
  bool all_good = true;
  const auto tell = [&](const CheckResult& result) {
    out << (result.is_good ? "ok    " : "FAIL  ") << printable(result.device) << ": "
        << printable(result.text) << std::endl;
    all_good = all_good && result.is_good;
  };
  tell(try_camera(hardware.camera(), station.lens));
  if (station.second_camera) tell(try_camera(*hardware.second_camera(), station.second_lens));
  tell(try_button(hardware.trigger(), options, out));
  if (!station.lamp.lines.empty()) tell(try_lamp(hardware.lamp(), hardware.clock()));
  if (station.arm) tell(try_arm(*hardware.arm(), station.arm->second_view_deg));
  tell(try_geometry(station));
  return all_good ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
