#include "firmware/support/connected_devices.hpp"

#include <fcntl.h>
#include <linux/gpio.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include "core/base/status.hpp"
#include "drivers/v4l2/device_finder.hpp"
#include "firmware/base/file_descriptor.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

std::string describe_cameras() {
  const std::unique_ptr<VideoDevice> device = make_system_video_device();
  const CameraList list = list_cameras(*device);
  std::string text;
  for (const FoundCamera& camera : list.cameras) {
    text += camera.node + ": camera \"name:" + camera.name + "\", \"port:" + camera.port + "\"";
    text += camera.serial.empty() ? "\n" : ", \"serial:" + camera.serial + "\"\n";
  }
  if (!list.closed_node.empty()) {
    text += list.closed_node + ": could not be opened: ";
    text.append(sentence(list.closed_status.code())).append("\n");
  }
  return text.empty() ? "no camera is connected\n" : text;
}

std::vector<fs::path> nodes_of(const fs::path& folder, const std::vector<std::string>& beginnings) {
  std::vector<fs::path> nodes;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    const bool is_one =
        std::any_of(beginnings.begin(), beginnings.end(),
                    [&name](const std::string& beginning) { return name.starts_with(beginning); });
    if (is_one) nodes.push_back(entry.path());
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

std::string describe_chip(const fs::path& node) {
  const FileDescriptor chip(::open(node.c_str(), O_RDONLY | O_CLOEXEC));
  gpiochip_info info{};
  if (!chip.is_open() || ::ioctl(chip.number(), GPIO_GET_CHIPINFO_IOCTL, &info) != 0) {
    return node.string() + ": could not be opened: " + std::system_category().message(errno) + "\n";
  }
  const std::string name(info.name, strnlen(info.name, sizeof info.name));
  const std::string label(info.label, strnlen(info.label, sizeof info.label));
  return node.string() + ": chip " + name + " [" + label + "], " + std::to_string(info.lines) + " lines\n";
}

}  // namespace

std::string describe_devices() {
  std::string text = describe_cameras();
  const std::vector<fs::path> chips = nodes_of("/dev", {"gpiochip"});
  for (const fs::path& chip : chips) text += describe_chip(chip);
  if (chips.empty()) text += "no chip with lines for button and lamp is there\n";
  const std::vector<fs::path> ports = nodes_of("/dev/serial/by-id", {""});
  for (const fs::path& port : ports) text += port.string() + ": serial port\n";
  for (const fs::path& port : nodes_of("/dev", {"ttyUSB", "ttyACM", "ttyAMA"}))
    text += port.string() + ": serial port\n";
  return text;
}

}  // namespace traygauge
