// What pictures are once the camera has started: how long it waits for its automatics, and that it lets them
// settle again.
#include <algorithm>
#include <tuple>

#include "tests/drivers/v4l2/v4l2_fixture.hpp"

namespace traygauge {
namespace {

class V4l2Settling : public V4l2 {
 protected:
  // Frames get brighter from `from` on, for so many.
  void brighten(int from, int frames) {
    for (int i = 0; i <= frames; ++i) kernel_.pictures[from + i] = grey(20 + 180 * i / frames);
  }
  std::vector<std::uint8_t> grey(int level) const {
    return std::vector<std::uint8_t>(fake_frame_bytes(kernel_.modes[0]), static_cast<std::uint8_t>(level));
  }
  long times_set(std::uint32_t id, int number) const {
    const auto text = std::to_string(id) + "=" + std::to_string(number);
    return std::count(kernel_.set_controls.begin(), kernel_.set_controls.end(), text);
  }
};

TEST_F(V4l2Settling, WaitsUntilTheBrightnessRests) {
  brighten(0, 30);
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_GE(kernel_.frame_count, 34);
  EXPECT_LE(kernel_.frame_count, 40);
}

TEST_F(V4l2Settling, DropsNoMoreThanTheFirstFramesOfAPictureAtRest) {
  kernel_.pictures[0] = grey(100);
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_LE(kernel_.frame_count, 13);
}

TEST_F(V4l2Settling, DoesNotWaitForEverUnderLightThatNeverRests) {
  for (int i = 0; i < 1000; ++i) kernel_.pictures[i] = grey(i % 2 == 0 ? 80 : 120);
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_GE(kernel_.frame_count, 60);
  EXPECT_LE(kernel_.frame_count, 64);
}

TEST_F(V4l2Settling, DoesNotWatchWhatNoAutomaticChanges) {
  brighten(0, 200);
  params_.controls[0] = {ControlWish::Kind::value, 10'000};
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_LE(kernel_.frame_count, 13);
}

TEST_F(V4l2Settling, SettlesAgainOnRequestAndLeavesTheFocusAlone) {
  kernel_.controls[V4L2_CID_FOCUS_AUTO] = {0, 1, 1, 1};
  kernel_.controls[V4L2_CID_FOCUS_ABSOLUTE] = {0, 250, 5, 30};
  kernel_.pictures[0] = grey(20);
  EXPECT_EQ(camera().settle_again().code(), DeviceCode::not_started);
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  const long focused = times_set(V4L2_CID_FOCUS_AUTO, 1);
  const int before = kernel_.frame_count;
  brighten(before + 5, 30);
  kernel_.controls[V4L2_CID_EXPOSURE_ABSOLUTE].value = 40;
  ASSERT_TRUE(camera().settle_again().ok()) << camera().detail();
  EXPECT_GE(kernel_.frame_count, before + 35);
  EXPECT_EQ(camera().held(CameraControl::exposure), 4000);
  EXPECT_EQ(times_set(V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_AUTO), 2);
  EXPECT_EQ(kernel_.controls[V4L2_CID_EXPOSURE_AUTO].value, V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(times_set(V4L2_CID_FOCUS_AUTO, 1), focused);
  EXPECT_EQ(camera().held(CameraControl::focus), 30);
  EXPECT_EQ(capture(), DeviceCode::ok);
}

TEST_F(V4l2Settling, GreyHasTheRangeThatTheCameraSays) {
  auto picture = grey(128);
  for (std::size_t i = 0; i < picture.size(); i += 2) picture[i] = 250;
  kernel_.pictures[0] = picture;
  params_.may_repeat = true;
  for (const auto& [colorspace, quantization, expected] :
       {std::tuple{V4L2_COLORSPACE_SRGB, V4L2_QUANTIZATION_DEFAULT, 255},
        std::tuple{V4L2_COLORSPACE_SRGB, V4L2_QUANTIZATION_FULL_RANGE, 250},
        std::tuple{V4L2_COLORSPACE_JPEG, V4L2_QUANTIZATION_DEFAULT, 250}}) {
    kernel_.colorspace = colorspace;
    kernel_.quantization = quantization;
    camera_.reset();
    ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
    ASSERT_EQ(capture(), DeviceCode::ok) << camera().detail();
    EXPECT_EQ(buffer_[0], expected);
  }
}

TEST_F(V4l2Settling, CostsNothingWhereEverythingIsGiven) {
  params_.controls[0] = {ControlWish::Kind::value, 10'000};
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  const int before = kernel_.frame_count;
  ASSERT_TRUE(camera().settle_again().ok());
  EXPECT_EQ(kernel_.frame_count, before);
}

}  // namespace
}  // namespace traygauge
