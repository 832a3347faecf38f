#include "drivers/v4l2/device_finder.hpp"

#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <system_error>

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSerial = "serial:";
constexpr const char* kPort = "port:";
constexpr const char* kName = "name:";

template <std::size_t N>
std::string text_of(const __u8 (&bytes)[N]) {
  const char* const text = reinterpret_cast<const char*>(bytes);
  return {text, strnlen(text, N)};
}

std::string read_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

bool delivers_pictures(const v4l2_capability& capability) {
  const std::uint32_t own = node_capabilities(capability);
  return (own & V4L2_CAP_VIDEO_CAPTURE) != 0 && (own & V4L2_CAP_STREAMING) != 0;
}

std::string describe(const std::vector<FoundCamera>& cameras) {
  if (cameras.empty()) return "no camera is connected";
  std::string text = "connected:";
  for (const FoundCamera& camera : cameras) {
    text += (text.back() == ':' ? " " : "; ") + camera.node + " is \"" + kName + camera.name + "\", \"" +
            kPort + camera.port + "\"";
    if (!camera.serial.empty()) text += std::string(", \"") + kSerial + camera.serial + "\"";
  }
  return text;
}

bool is_called(const FoundCamera& camera, const std::string& wanted) {
  return wanted == kSerial + camera.serial || wanted == kPort + camera.port || wanted == kName + camera.name;
}

}  // namespace

std::uint32_t node_capabilities(const v4l2_capability& capability) {
  const bool knows_own = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0;
  return knows_own ? capability.device_caps : capability.capabilities;
}

bool is_camera_name(const std::string& wanted) {
  if (wanted.starts_with("/")) return true;
  const std::array prefixes = {kSerial, kPort, kName};
  return std::ranges::any_of(prefixes, [&wanted](const char* prefix) {
    return wanted.starts_with(prefix) && wanted.size() > std::strlen(prefix);
  });
}

CameraList list_cameras(VideoDevice& device, const CameraFolders& folders) {
  CameraList list;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folders.classes, ignored)) {
    FoundCamera camera;
    camera.node = folders.nodes / entry.path().filename();
    if (const int error = device.open(camera.node); error != 0) {
      device.close();
      const DeviceStatus status = status_of_errno(error);
      if (status.code() != DeviceCode::device_gone) {
        list.closed_node = camera.node;
        list.closed_status = status;
      }
      continue;
    }
    v4l2_capability capability{};
    const bool is_camera = device.request(VIDIOC_QUERYCAP, &capability) == 0 && delivers_pictures(capability);
    device.close();
    if (!is_camera) continue;
    camera.name = text_of(capability.card);
    camera.port = text_of(capability.bus_info);
    // The node belongs to an interface of the USB device, whose serial number stands one level up.
    camera.serial = read_line(entry.path() / "device" / ".." / "serial");
    list.cameras.push_back(camera);
  }
  std::sort(list.cameras.begin(), list.cameras.end(),
            [](const FoundCamera& a, const FoundCamera& b) { return a.node < b.node; });
  return list;
}

DeviceStatus find_camera(VideoDevice& device, const std::string& wanted, std::string& node,
                         std::string& problem, const CameraFolders& folders) {
  if (wanted.starts_with("/")) {
    node = wanted;
    return DeviceCode::ok;
  }
  const auto [cameras, closed_node, closed_status] = list_cameras(device, folders);
  const auto is_wanted = [&wanted](const FoundCamera& camera) { return is_called(camera, wanted); };
  const auto found = std::find_if(cameras.begin(), cameras.end(), is_wanted);
  if (found == cameras.end() && !closed_node.empty()) {
    problem = closed_node + " may be \"" + wanted + "\" and could not be opened";
    return closed_status;
  }
  if (found == cameras.end()) {
    problem = "\"" + wanted + "\" is not there; " + describe(cameras);
    return DeviceCode::device_gone;
  }
  if (std::count_if(cameras.begin(), cameras.end(), is_wanted) > 1) {
    problem = "several cameras are \"" + wanted + "\"; name one by its port or serial; " + describe(cameras);
    return DeviceCode::invalid_argument;
  }
  node = found->node;
  return DeviceCode::ok;
}

}  // namespace traygauge
