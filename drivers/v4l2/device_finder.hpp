// Cameras by a name that stays when the cable is plugged in again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/device_status.hpp"
#include "drivers/v4l2/video_device.hpp"

struct v4l2_capability;

namespace traygauge {

// A node that delivers pictures.
struct FoundCamera {
  std::string node;    // "/dev/video0"
  std::string name;    // of the product
  std::string port;    // where it is plugged in: "usb-0000:00:14.0-2"
  std::string serial;  // of the USB device; empty where it has none
};

struct CameraFolders {
  std::filesystem::path classes = "/sys/class/video4linux";
  std::filesystem::path nodes = "/dev";
};

struct CameraList {
  std::vector<FoundCamera> cameras;  // by node
  std::string closed_node;           // one that is there and could not be opened; empty: none
  DeviceStatus closed_status;        // why
};

// What a node itself can do, of V4L2_CAP_….
std::uint32_t node_capabilities(const v4l2_capability& capability);

// `device` is closed, and is again.
CameraList list_cameras(VideoDevice& device, const CameraFolders& folders = {});

// The node that `wanted` names: a path ("/dev/video0", "/dev/v4l/by-id/…"), "serial:…", "port:…" or "name:…".
// device_gone when there is none, no_permission, in_use when it may be one that could not be opened,
// invalid_argument when several have that name; `problem` then says what is there.
DeviceStatus find_camera(VideoDevice& device, const std::string& wanted, std::string& node,
                         std::string& problem, const CameraFolders& folders = {});

// Whether `wanted` has one of these forms.
bool is_camera_name(const std::string& wanted);

}  // namespace traygauge
