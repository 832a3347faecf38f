#include <charconv>

#include "firmware/base/toml_text.hpp"
#include "firmware/check/device_check.hpp"
#include "firmware/config/station_writing.hpp"
#include "firmware/setup/setup_steps.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

// What stays the same when the cable is plugged in again.
std::string lasting_name(const FoundCamera& camera) {
  if (!camera.serial.empty()) return "serial:" + camera.serial;
  return camera.port.empty() ? camera.node : "port:" + camera.port;
}

std::string describe_camera(const FoundCamera& camera) {
  std::string text = printable(camera.name) + " at " + camera.node;
  if (!camera.port.empty()) text += ", plugged in at " + printable(camera.port);
  if (!camera.serial.empty()) text += ", serial number " + printable(camera.serial);
  return text;
}

// The camera that looks at the tray: the file's, or one of those that are connected.
void choose_camera(SetupSite& site, const std::vector<FoundCamera>& cameras) {
  const std::string device = site.read().camera.device;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    site.dialogue.say(std::to_string(i + 1) + "  " + describe_camera(cameras[i]));
  site.dialogue.ask_until(
      "Which one looks at the tray? A number, or Enter for " + printable(device), {},
      [&](const std::string& answer) -> std::string {
        if (answer.empty()) return {};
        std::size_t number = 0;
        const auto [end, error] = std::from_chars(answer.data(), answer.data() + answer.size(), number);
        if (error != std::errc() || *end != 0 || number < 1 || number > cameras.size())
          return "Type a number from 1 to " + std::to_string(cameras.size()) + ".";
        write_station_value(site.file, "camera", "device", toml_text(lasting_name(cameras[number - 1])));
        return {};
      });
}

bool look_through_cameras(SetupSite& site) {
  const std::unique_ptr<SetupDevices> opened = site.tools.open_devices(site.read());
  const StationDevices devices = opened->devices();
  bool all_good = true;
  for (Camera* camera : {&devices.camera, devices.second_camera}) {
    if (camera == nullptr) continue;
    TakenPicture picture;
    const CheckResult result = check_camera(*camera, picture);
    camera->stop();
    all_good = tell(site, result) && all_good;
  }
  return all_good;
}

}  // namespace

bool set_up_camera(SetupSite& site) {
  return try_until_done(site, [&site] {
    const CameraList list = site.tools.list_cameras();
    if (!list.cameras.empty()) {
      choose_camera(site, list.cameras);
    } else if (!list.closed_node.empty()) {
      site.dialogue.say(list.closed_node + " could not be opened: " + sentence(list.closed_status.code()));
    } else {
      site.dialogue.say("No camera is connected.");
    }
    return look_through_cameras(site);
  });
}

}  // namespace traygauge
