#include <chrono>

#include "firmware/check/device_check.hpp"
#include "firmware/setup/setup_steps.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

constexpr Nanoseconds kWaitForPress = std::chrono::seconds(60);

bool try_button_and_lamp(SetupSite& site) {
  const StationFile station = site.read();
  const std::unique_ptr<SetupDevices> opened = site.tools.open_devices(station);
  const StationDevices devices = opened->devices();
  site.dialogue.say("Press the button once.");
  if (!tell(site, check_press(devices.trigger, kWaitForPress))) return false;
  if (station.lamp.lines.empty()) return true;
  site.dialogue.say("Look at the lamp: it shows each of its signals.");
  if (!tell(site, check_lamp(devices.lamp, devices.clock))) return false;
  if (site.dialogue.confirm("Did every lamp light?", true)) return true;
  site.dialogue.say("Check the wires, and lines and active_low of [lamp].");
  return false;
}

}  // namespace

bool set_up_button(SetupSite& site) {
  return try_until_done(site, [&site] { return try_button_and_lamp(site); });
}

}  // namespace traygauge
