#include "drivers/v4l2/device_finder.hpp"

#include <gtest/gtest.h>
#include <linux/videodev2.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <map>

namespace traygauge {
namespace {

namespace fs = std::filesystem;

// Nodes that only say who they are.
class NamedNodes final : public VideoDevice {
 public:
  struct Node {
    std::string name;
    std::string port;
    std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
    int open_error = 0;
  };
  std::map<std::string, Node> nodes;
  int open_now = 0;

  int open(const std::string& path) override {
    const auto found = nodes.find(path);
    if (found == nodes.end()) return ENOENT;
    if (found->second.open_error != 0) return found->second.open_error;
    opened_ = &found->second;
    ++open_now;
    return 0;
  }
  void close() override {
    if (opened_ != nullptr) --open_now;
    opened_ = nullptr;
  }
  int request(IoctlCode code, void* argument) override {
    if (code != VIDIOC_QUERYCAP) return ENOTTY;
    auto& capability = *static_cast<v4l2_capability*>(argument);
    std::copy(opened_->name.begin(), opened_->name.end(), capability.card);
    std::copy(opened_->port.begin(), opened_->port.end(), capability.bus_info);
    capability.capabilities = V4L2_CAP_DEVICE_CAPS;
    capability.device_caps = opened_->capabilities;
    return 0;
  }
  std::span<std::uint8_t> map(std::size_t, std::uint32_t) override { return {}; }
  void unmap(std::span<std::uint8_t>) override {}
  int wait(Nanoseconds, bool&) override { return EIO; }

 private:
  const Node* opened_ = nullptr;
};

class DeviceFinder : public testing::Test {
 protected:
  DeviceFinder() {
    root_ = fs::path(testing::TempDir()) / ("device_finder_" + std::to_string(getpid()));
    folders_ = {root_ / "class", "/nodes"};
    add("video0", {"Doc Cam", "usb-1"}, "A1");
    add("video1", {"Doc Cam", "usb-1", V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING}, "A1");
    add("video2", {"Doc Cam", "usb-2"}, "A2");
    add("video3", {"Other", "platform:soc"}, "");
  }
  ~DeviceFinder() override {
    fs::remove_all(root_);
    EXPECT_EQ(nodes_.open_now, 0);
  }
  void add(const std::string& node, const NamedNodes::Node& what, const std::string& serial) {
    fs::create_directories(root_ / "class" / node / "device");
    if (!serial.empty()) std::ofstream(root_ / "class" / node / "serial") << serial << "\n";
    nodes_.nodes["/nodes/" + node] = what;
  }
  DeviceCode find(const std::string& wanted) {
    problem_.clear();
    return find_camera(nodes_, wanted, node_, problem_, folders_).code();
  }

  fs::path root_;
  CameraFolders folders_;
  NamedNodes nodes_;
  std::string node_;
  std::string problem_;
};

TEST_F(DeviceFinder, FindsByPathSerialPortAndName) {
  EXPECT_EQ(find("/dev/anything"), DeviceCode::ok);
  EXPECT_EQ(node_, "/dev/anything");
  EXPECT_EQ(find("serial:A2"), DeviceCode::ok);
  EXPECT_EQ(node_, "/nodes/video2");
  EXPECT_EQ(find("port:usb-1"), DeviceCode::ok);
  EXPECT_EQ(node_, "/nodes/video0");
  EXPECT_EQ(find("name:Other"), DeviceCode::ok);
  EXPECT_EQ(node_, "/nodes/video3");
}

TEST_F(DeviceFinder, SaysWhatIsThere) {
  EXPECT_EQ(find("serial:B7"), DeviceCode::device_gone);
  EXPECT_EQ(
      problem_,
      "\"serial:B7\" is not there; connected: /nodes/video0 is \"name:Doc Cam\", \"port:usb-1\", "
      "\"serial:A1\"; /nodes/video2 is \"name:Doc Cam\", \"port:usb-2\", \"serial:A2\"; /nodes/video3 is "
      "\"name:Other\", \"port:platform:soc\"");
  EXPECT_EQ(find("name:Doc Cam"), DeviceCode::invalid_argument);
  EXPECT_EQ(problem_.substr(0, 69),
            "several cameras are \"name:Doc Cam\"; name one by its port or serial; c");
  fs::remove_all(root_);
  EXPECT_EQ(find("serial:A1"), DeviceCode::device_gone);
  EXPECT_EQ(problem_, "\"serial:A1\" is not there; no camera is connected");
}

TEST_F(DeviceFinder, TakesANodeThatMayNotBeOpenedForTheReason) {
  nodes_.nodes["/nodes/video2"].open_error = EACCES;
  EXPECT_EQ(find("serial:A2"), DeviceCode::no_permission);
  EXPECT_EQ(problem_, "/nodes/video2 may be \"serial:A2\" and could not be opened");
  EXPECT_EQ(find("serial:A1"), DeviceCode::ok);
}

TEST_F(DeviceFinder, ANodeThatAnotherProgramHasIsInUseAndNotAbsent) {
  nodes_.nodes["/nodes/video2"].open_error = EBUSY;
  EXPECT_EQ(find("serial:A2"), DeviceCode::in_use);
  EXPECT_EQ(problem_, "/nodes/video2 may be \"serial:A2\" and could not be opened");
}

TEST_F(DeviceFinder, KnowsTheFormsOfAName) {
  for (const char* good : {"/dev/video0", "serial:1", "port:usb-1", "name:x"})
    EXPECT_TRUE(is_camera_name(good));
  for (const char* bad : {"", "video0", "serial:", "Serial:1"}) EXPECT_FALSE(is_camera_name(bad));
}

}  // namespace
}  // namespace traygauge
