// Exposure, gain, white balance and focus: held, set, read back.
#include <algorithm>

#include "tests/drivers/v4l2/v4l2_fixture.hpp"

namespace traygauge {
namespace {

class V4l2Controls : public V4l2 {
 protected:
  V4l2Controls() {
    kernel_.controls[V4L2_CID_AUTO_WHITE_BALANCE] = {0, 1, 1, 1};
    kernel_.controls[V4L2_CID_WHITE_BALANCE_TEMPERATURE] = {2800, 6500, 10, 4600};
    kernel_.controls[V4L2_CID_FOCUS_AUTO] = {0, 1, 1, 1};
    kernel_.controls[V4L2_CID_FOCUS_ABSOLUTE] = {0, 250, 5, 30};
  }
  ControlWish& wish(CameraControl control) { return params_.controls[static_cast<std::size_t>(control)]; }
  int value(std::uint32_t id) { return kernel_.controls[id].value; }
};

TEST_F(V4l2Controls, AutomaticsSettleAndAreThenSwitchedOff) {
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(value(V4L2_CID_AUTO_WHITE_BALANCE), 0);
  EXPECT_EQ(value(V4L2_CID_FOCUS_AUTO), 0);
  EXPECT_EQ(camera().describe_setup(),
            "/dev/video7: YUYV 64x48 at 30 a second; exposure_us 15600, white_balance_k 4600, focus 30");
}

// Exposure's automatic sets the gain too, where that has none of its own.
TEST_F(V4l2Controls, WhatTheAutomaticsFoundStaysWhereTheCameraWouldGoBackToItsOwn) {
  kernel_.controls[V4L2_CID_GAIN] = {0, 255, 1, 77, false, V4L2_CID_EXPOSURE_AUTO, 0};
  kernel_.controls[V4L2_CID_EXPOSURE_ABSOLUTE] = {1, 5000, 1, 156, false, V4L2_CID_EXPOSURE_AUTO, 3};
  kernel_.controls[V4L2_CID_FOCUS_ABSOLUTE] = {0, 250, 5, 30, false, V4L2_CID_FOCUS_AUTO, 0};
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_ABSOLUTE), 156);
  EXPECT_EQ(value(V4L2_CID_GAIN), 77);
  EXPECT_EQ(value(V4L2_CID_FOCUS_ABSOLUTE), 30);
  EXPECT_EQ(camera().held(CameraControl::gain), 77);
}

TEST_F(V4l2Controls, WhatGoesBackToItsOwnAndStaysThereIsTold) {
  kernel_.controls[V4L2_CID_EXPOSURE_ABSOLUTE] = {1, 5000, 1, 156, true, V4L2_CID_EXPOSURE_AUTO, 3};
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_EQ(camera().detail(), "exposure_us: it settled at 15600, held the camera says 300");
}

TEST_F(V4l2Controls, GivenValuesAreSetAfterTheirAutomaticIsOffAndReadBack) {
  wish(CameraControl::exposure) = {ControlWish::Kind::value, 20'000};
  wish(CameraControl::focus) = {ControlWish::Kind::value, 120};
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_ABSOLUTE), 200);
  EXPECT_EQ(value(V4L2_CID_FOCUS_ABSOLUTE), 120);
  const auto at = [this](std::uint32_t id, int number) {
    const auto text = std::to_string(id) + "=" + std::to_string(number);
    const auto& list = kernel_.set_controls;
    return std::find(list.begin(), list.end(), text) - list.begin();
  };
  EXPECT_LT(at(V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL), at(V4L2_CID_EXPOSURE_ABSOLUTE, 200));
  EXPECT_LT(at(V4L2_CID_FOCUS_AUTO, 0), at(V4L2_CID_FOCUS_ABSOLUTE, 120));
}

TEST_F(V4l2Controls, AControlThatKeepsItsOwnValueIsTold) {
  wish(CameraControl::focus) = {ControlWish::Kind::value, 120};
  kernel_.controls[V4L2_CID_FOCUS_ABSOLUTE].is_stubborn = true;
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_EQ(camera().detail(), "focus: 120 was set, the camera says 30");
}

TEST_F(V4l2Controls, FocusThatCannotBeLockedIsTold) {
  kernel_.controls[V4L2_CID_FOCUS_AUTO].is_stubborn = true;
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_TRUE(detail_has("focus: the camera does not let its automatic be switched off"));
  camera_.reset();
  wish(CameraControl::focus).kind = ControlWish::Kind::leave;
  EXPECT_EQ(start(), DeviceCode::ok) << camera().detail();
}

TEST_F(V4l2Controls, ValuesBeyondTheCamerasRangeAndAbsentControlsAreTold) {
  wish(CameraControl::exposure) = {ControlWish::Kind::value, 600'000};
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_EQ(camera().detail(), "exposure_us: 600000 is asked for; the camera has 100 to 500000");
  camera_.reset();
  wish(CameraControl::exposure) = {};
  wish(CameraControl::gain) = {ControlWish::Kind::value, 3};
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_EQ(camera().detail(), "gain: the camera has no such control; remove the key from the configuration");
}

// Sensors on the board: their controls are on another node, or count lines.
TEST_F(V4l2Controls, AnExposureThatNothingCanHoldIsTold) {
  kernel_.controls.erase(V4L2_CID_EXPOSURE_AUTO);
  kernel_.controls.erase(V4L2_CID_EXPOSURE_ABSOLUTE);
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_TRUE(detail_has("exposure_us: the camera's node has no control that could hold it"))
      << camera().detail();
  camera_.reset();
  wish(CameraControl::exposure).kind = ControlWish::Kind::leave;
  EXPECT_EQ(start(), DeviceCode::ok) << camera().detail();
}

TEST_F(V4l2Controls, AnExposureInLinesIsHeldButNeverTakenForMicroseconds) {
  kernel_.controls.erase(V4L2_CID_EXPOSURE_AUTO);
  kernel_.controls.erase(V4L2_CID_EXPOSURE_ABSOLUTE);
  kernel_.controls[V4L2_CID_EXPOSURE] = {4, 4000, 1, 1200};
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_FALSE(camera().held(CameraControl::exposure));
  EXPECT_NE(camera().describe_setup().find("exposure_us 1200 of its own"), std::string::npos);
  camera_.reset();
  wish(CameraControl::exposure) = {ControlWish::Kind::value, 2000};
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_TRUE(detail_has("exposure_us: the camera counts lines and does not say how long one takes"))
      << camera().detail();
  EXPECT_EQ(value(V4L2_CID_EXPOSURE), 1200);
}

TEST_F(V4l2Controls, AnExposureInLinesIsConvertedWhereTheSensorSaysHowLongOneTakes) {
  kernel_.controls.erase(V4L2_CID_EXPOSURE_AUTO);
  kernel_.controls.erase(V4L2_CID_EXPOSURE_ABSOLUTE);
  kernel_.controls[V4L2_CID_EXPOSURE] = {4, 4000, 1, 1200};
  kernel_.controls[V4L2_CID_PIXEL_RATE].value = 84'000'000;
  kernel_.controls[V4L2_CID_HBLANK].value = 1616;  // with 64 pixels: 20 us a line
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_EQ(camera().held(CameraControl::exposure), 24'000);
  camera_.reset();
  wish(CameraControl::exposure) = {ControlWish::Kind::value, 2019};
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_EQ(value(V4L2_CID_EXPOSURE), 100);
  EXPECT_EQ(camera().held(CameraControl::exposure), 2000);
  camera_.reset();
  wish(CameraControl::exposure) = {ControlWish::Kind::value, 90'000};
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_TRUE(detail_has("90000 is asked for; the camera has 80 to 80000")) << camera().detail();
}

TEST_F(V4l2Controls, AStepBesideTheWishIsNear) {
  wish(CameraControl::white_balance) = {ControlWish::Kind::value, 4503};
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_EQ(value(V4L2_CID_WHITE_BALANCE_TEMPERATURE), 4500);
}

}  // namespace
}  // namespace traygauge
