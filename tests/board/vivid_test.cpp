// The camera driver on vivid, which fails on request.
#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "drivers/v4l2/device_finder.hpp"
#include "tests/board/kernel_devices.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

// vivid's own controls, by name.
void set_vivid(const std::string& node, const std::string& control, int value) {
  const int descriptor = open(node.c_str(), O_RDWR | O_NONBLOCK);
  ASSERT_GE(descriptor, 0);
  v4l2_queryctrl query{};
  query.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  bool is_set = false;
  while (!is_set && ioctl(descriptor, VIDIOC_QUERYCTRL, &query) == 0) {
    if (control == reinterpret_cast<const char*>(query.name)) {
      v4l2_control wanted{query.id, value};
      is_set = ioctl(descriptor, VIDIOC_S_CTRL, &wanted) == 0;
      break;
    }
    query.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  close(descriptor);
  EXPECT_TRUE(is_set) << control;
}

class Vivid : public CameraOnKernel {
 protected:
  Vivid() {
    const auto device = make_system_video_device();
    std::string problem;
    EXPECT_TRUE(find_camera(*device, "name:vivid", node_, problem).ok()) << problem;
    params_.device = "name:vivid";
    params_.mode = {640, 360, "YUYV", 15.0};
    params_.settle_frames = 1;
    params_.controls[static_cast<std::size_t>(CameraControl::exposure)].kind =
        ControlWish::Kind::leave;  // vivid has none
    params_.burst = 2;
    params_.may_repeat = true;
    make_camera();
  }
  std::string node_;
};

TEST_F(Vivid, RequestsThatFailOnceAreToldAndTheNextStartWorks) {
  for (const char* what : {"Inject VIDIOC_STREAMON Error", "Inject VIDIOC_REQBUFS Error"}) {
    set_vivid(node_, what, 1);
    EXPECT_NE(start(), DeviceCode::ok) << what;
    ASSERT_EQ(start(), DeviceCode::ok) << what;
    EXPECT_EQ(capture(), DeviceCode::ok);
    camera_->stop();
  }
}

TEST_F(Vivid, FlaggedFramesAreLeftOut) {
  ASSERT_EQ(start(), DeviceCode::ok) << camera_->detail();
  for (int i = 0; i < 5; ++i) {
    set_vivid(node_, "Inject V4L2_BUF_FLAG_ERROR", 1);
    ASSERT_EQ(capture(), DeviceCode::ok) << camera_->detail();
  }
  EXPECT_GE(camera_->counters().damaged, 1U);
}

TEST_F(Vivid, DroppedFramesAreCounted) {
  set_vivid(node_, "Percentage of Dropped Buffers", 50);
  ASSERT_EQ(start(), DeviceCode::ok) << camera_->detail();
  for (int i = 0; i < 5; ++i) ASSERT_EQ(capture(), DeviceCode::ok);
  set_vivid(node_, "Percentage of Dropped Buffers", 0);
  EXPECT_GE(camera_->counters().missed, 1U);
}

TEST_F(Vivid, AFatalErrorOfTheStreamIsToldAndTheNextStartWorks) {
  ASSERT_EQ(start(), DeviceCode::ok) << camera_->detail();
  set_vivid(node_, "Inject Fatal Streaming Error", 1);
  DeviceCode code = DeviceCode::ok;
  for (int i = 0; i < 10 && code == DeviceCode::ok; ++i) code = capture(1s);
  EXPECT_EQ(code, DeviceCode::io_error);
  camera_->stop();
  ASSERT_EQ(start(), DeviceCode::ok) << camera_->detail();
  EXPECT_EQ(capture(), DeviceCode::ok);
}

TEST_F(Vivid, ADisconnectIsToldAtOnce) {
  ASSERT_EQ(start(), DeviceCode::ok) << camera_->detail();
  set_vivid(node_, "Disconnect", 1);
  EXPECT_EQ(capture(), DeviceCode::device_gone);
  camera_->stop();
  ASSERT_TRUE(comes_true(3s, [this] { return start() == DeviceCode::ok; })) << camera_->detail();
  EXPECT_EQ(capture(), DeviceCode::ok);
}

TEST_F(Vivid, AThousandStartsLeaveNoDescriptorOpen) {
  params_.settle_frames = 0;
  make_camera();
  ASSERT_EQ(start(), DeviceCode::ok);
  camera_->stop();
  const int descriptors = open_descriptors();
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(start(), DeviceCode::ok) << i << " " << camera_->detail();
    camera_->stop();
    ASSERT_EQ(open_descriptors(), descriptors) << i;
  }
}

TEST_F(Vivid, WhatIsNotOfferedIsRefusedWithWhatIs) {
  params_.mode = {1600, 1200, "MJPEG", 0.0};
  make_camera();
  EXPECT_EQ(start(), DeviceCode::unsupported);
  const std::string detail(camera_->detail());
  EXPECT_NE(detail.find("asked for MJPEG 1600x1200; it offers "), std::string::npos) << detail;
  EXPECT_NE(detail.find("YUYV 640x360"), std::string::npos) << detail;
}

TEST_F(Vivid, ACameraThatAnotherProgramStreamsFromIsInUse) {
  ASSERT_EQ(start(), DeviceCode::ok);
  V4l2Camera second(make_system_video_device(), clock_, params_);
  EXPECT_EQ(second.start().code(), DeviceCode::in_use);
}

}  // namespace
}  // namespace traygauge
