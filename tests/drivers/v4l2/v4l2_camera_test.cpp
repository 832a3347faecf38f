// What the camera driver chooses, what it does with every fault, and what it leaves behind.
#include <cerrno>

#include "tests/drivers/v4l2/v4l2_fixture.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

TEST_F(V4l2, SaysWhatTheCameraOffersWhenItLacksWhatIsAskedFor) {
  kernel_.modes = {
      {V4L2_PIX_FMT_YUYV, 64, 48, {30, 15}}, {V4L2_PIX_FMT_MJPEG, 128, 96, {30}}, {0x12345678, 8, 8, {}}};
  params_.mode = {128, 96, "YUYV", 10.0};
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_EQ(
      camera().detail(),
      "asked for YUYV 128x96 at 10 a second; it offers YUYV 64x48 (30, 15 a second), MJPEG 128x96 (30 a "
      "second); formats of no use here: strange");
}

TEST_F(V4l2, ChoosesTheFormatWithoutLossThatIsFastEnough) {
  const auto chosen = [this](const ModeWish& wish) {
    params_.mode = wish;
    camera_.reset();
    EXPECT_EQ(start(), DeviceCode::ok) << camera().detail();
    return camera().describe_setup();
  };
  kernel_.modes = {{V4L2_PIX_FMT_GREY, 64, 48, {60}},
                   {V4L2_PIX_FMT_MJPEG, 64, 48, {60, 30}},
                   {V4L2_PIX_FMT_YUYV, 64, 48, {15, 5}}};
  params_.settle_frames = 0;
  EXPECT_EQ(chosen({64, 48, "", 0.0}), "/dev/video7: YUYV 64x48 at 15 a second; exposure_us 15600");
  EXPECT_EQ(chosen({64, 48, "", 5.0}), "/dev/video7: YUYV 64x48 at 5 a second; exposure_us 15600");
  EXPECT_EQ(chosen({64, 48, "", 20.0}), "/dev/video7: MJPEG 64x48 at 30 a second; exposure_us 15600");
  EXPECT_EQ(chosen({64, 48, "GREY", 0.0}), "/dev/video7: GREY 64x48 at 60 a second; exposure_us 15600");
  EXPECT_EQ(camera().format().pixels, PixelFormat::gray8);
}

TEST_F(V4l2, KnowsTheRateAtTheSizeThatIsAskedForAndTheOneThatItGot) {
  kernel_.modes = {{V4L2_PIX_FMT_YUYV, 1600, 1200, {5}, 64, 48, {30}}};
  params_.mode = {64, 48, "", 20.0};
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_EQ(camera().describe_setup(), "/dev/video7: YUYV 64x48 at 30 a second; exposure_us 15600");
  camera_.reset();
  kernel_.granted_rate_per_s = 12;
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  EXPECT_EQ(camera().describe_setup(), "/dev/video7: YUYV 64x48 at 12 a second; exposure_us 15600");
}

TEST_F(V4l2, SaysWhyTheNodeCannotBeOpened) {
  params_.device = "/dev/video9";
  EXPECT_EQ(start(), DeviceCode::device_gone);
  camera_.reset();
  params_.device = kernel_.node;
  kernel_.may_not_open = true;
  EXPECT_EQ(start(), DeviceCode::no_permission);
  EXPECT_EQ(camera().detail(), "/dev/video7");
  kernel_.may_not_open = false;
  kernel_.errors[VIDIOC_S_FMT] = EBUSY;
  EXPECT_EQ(start(), DeviceCode::in_use);
  kernel_.errors[VIDIOC_QUERYCAP] = ENOTTY;
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_EQ(start(), DeviceCode::ok);
}

TEST_F(V4l2, SaysWhichNodesAreOfNoUse) {
  kernel_.capabilities = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_TRUE(detail_has("/dev/video7 keeps a picture in several memories")) << camera().detail();
  kernel_.capabilities = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_TRUE(detail_has("/dev/video7 delivers no pictures")) << camera().detail();
}

TEST_F(V4l2, SaysThatTheLinksBehindANodeHaveToBeSet) {
  kernel_.errors[VIDIOC_STREAMON] = EPIPE;
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_TRUE(detail_has("media-ctl")) << camera().detail();
}

TEST_F(V4l2, SaysThatTheBusIsFull) {
  kernel_.errors[VIDIOC_STREAMON] = ENOSPC;
  EXPECT_EQ(start(), DeviceCode::unsupported);
  EXPECT_TRUE(detail_has("the USB bus has too little room left")) << camera().detail();
  EXPECT_TRUE(detail_has("another USB controller")) << camera().detail();
  EXPECT_EQ(start(), DeviceCode::ok);
}

TEST_F(V4l2, EveryRequestMayFailOnceAndNothingStaysBehind) {
  for (const IoctlCode code : {VIDIOC_QUERYCAP, VIDIOC_ENUM_FMT, VIDIOC_S_FMT, VIDIOC_REQBUFS,
                               VIDIOC_QUERYBUF, VIDIOC_QBUF, VIDIOC_STREAMON, VIDIOC_DQBUF}) {
    for (const int error : {EIO, ENODEV, EBUSY}) {
      kernel_.errors[code] = error;
      EXPECT_NE(start(), DeviceCode::ok) << code;
      EXPECT_EQ(kernel_.open_now, 0);
      EXPECT_EQ(kernel_.mapped_now, 0);
      ASSERT_EQ(start(), DeviceCode::ok) << code << " " << camera().detail();
      EXPECT_EQ(capture(), DeviceCode::ok);
      camera().stop();
    }
  }
}

TEST_F(V4l2, DropsTheFirstFrames) {
  params_.settle_frames = 12;
  params_.burst = 1;
  ASSERT_EQ(start(), DeviceCode::ok);
  EXPECT_GE(kernel_.frame_count, 12);
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_GE(frame_.sequence, 13U);
}

TEST_F(V4l2, DeliversOnlyWhatWasExposedAfterTheRequest) {
  for (const std::uint32_t source :
       {std::uint32_t{V4L2_BUF_FLAG_TSTAMP_SRC_SOE}, std::uint32_t{V4L2_BUF_FLAG_TSTAMP_SRC_EOF}}) {
    kernel_.stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | source;
    ASSERT_EQ(start(), DeviceCode::ok);
    clock_.sleep_for(10s);  // the buffers fill with what is old by then
    for (int i = 0; i < 20; ++i) {
      const Instant asked_at = clock_.now();
      ASSERT_EQ(capture(), DeviceCode::ok);
      EXPECT_GE(frame_.exposed_at, asked_at);
      EXPECT_LE(frame_.delivered_at, clock_.now());
      clock_.sleep_for(i * 17ms);
    }
    camera().stop();
  }
}

// A driver that says it stamps frames, and does not, or always alike: the time of arrival counts.
TEST_F(V4l2, StampsThatStandStillAreNotBelieved) {
  for (const Nanoseconds stamp : {Nanoseconds(0), Nanoseconds(5s)}) {
    kernel_.fixed_stamp = stamp;
    camera_.reset();
    kernel_.begun_at.clear();
    kernel_.frame_count = 0;
    ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
    clock_.sleep_for(10s);  // the buffers fill with what is old by then
    for (int i = 0; i < 20; ++i) {
      const Instant asked_at = clock_.now();
      ASSERT_EQ(capture(), DeviceCode::ok) << camera().detail();
      EXPECT_GE(frame_.exposed_at, asked_at);
      EXPECT_GE(kernel_.begun_at.at(frame_.sequence - 1), asked_at);
      clock_.sleep_for(i * 17ms);
    }
    camera().stop();
  }
}

// uvcvideo stamps the first bytes, which come once the exposure is over, and calls them its start.
TEST_F(V4l2, AStampIsNotBelievedToBeTheStartOfTheExposure) {
  params_.burst = 1;
  for (const int exposure_ms : {20, 100}) {
    params_.controls[0] = {ControlWish::Kind::value, exposure_ms * 1000};
    camera_.reset();
    kernel_.begun_at.clear();
    kernel_.frame_count = 0;
    ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
    for (int i = 0; i < 20; ++i) {
      const Instant asked_at = clock_.now();
      ASSERT_EQ(capture(), DeviceCode::ok);
      const Instant first_bytes_at = kernel_.begun_at.at(frame_.sequence - 1);
      EXPECT_GE(first_bytes_at - std::chrono::milliseconds(exposure_ms) - 30ms, asked_at);
      clock_.sleep_for(i * 7ms);
    }
  }
}

TEST_F(V4l2, NoPictureComesFromTheFuture) {
  kernel_.stamp_offset = 15ms;
  for (const std::uint32_t source :
       {std::uint32_t{V4L2_BUF_FLAG_TSTAMP_SRC_SOE}, std::uint32_t{V4L2_BUF_FLAG_TSTAMP_SRC_EOF}}) {
    kernel_.stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | source;
    ASSERT_EQ(start(), DeviceCode::ok);
    for (int i = 0; i < 10; ++i) {
      ASSERT_EQ(capture(), DeviceCode::ok);
      EXPECT_LE(frame_.delivered_at, clock_.now());
      EXPECT_LE(frame_.exposed_at, clock_.now());
    }
    camera().stop();
  }
}

TEST_F(V4l2, TakesTheSharpestOfABurst) {
  params_.burst = 4;
  params_.settle_frames = 0;
  params_.may_repeat = true;
  const std::vector<std::uint8_t> flat(fake_frame_bytes(kernel_.modes[0]), 100);
  auto sharp = flat;
  for (std::size_t i = 0; i < sharp.size(); i += 4) sharp[i] = 255;
  kernel_.pictures = {{0, flat}, {2, sharp}, {3, flat}};
  ASSERT_EQ(start(), DeviceCode::ok);
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_EQ(frame_.sequence, 3U);  // counted from 1
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_GT(frame_.sequence, 3U);
}

TEST_F(V4l2, TheNextSharpestStandsInForOneThatMayNotBeDelivered) {
  params_.burst = 4;
  params_.settle_frames = 0;
  const std::vector<std::uint8_t> flat(fake_frame_bytes(kernel_.modes[0]), 100);
  auto sharp = flat;
  for (std::size_t i = 0; i < sharp.size(); i += 4) sharp[i] = 255;
  auto medium = flat;
  for (std::size_t i = 0; i < medium.size(); i += 4) medium[i] = 150;
  kernel_.pictures = {{0, sharp}};
  ASSERT_EQ(start(), DeviceCode::ok);
  ASSERT_EQ(capture(), DeviceCode::ok);
  const int next = kernel_.frame_count;
  kernel_.pictures = {{next, flat}, {next + 2, sharp}, {next + 3, medium}, {next + 4, flat}};
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_EQ(frame_.sequence, static_cast<std::uint64_t>(next) + 4);  // counted from 1
  EXPECT_EQ(camera().counters().repeated, 1U);
}

TEST_F(V4l2, NeverDeliversDamagedFramesAndCountsThem) {
  params_.burst = 1;
  params_.settle_frames = 0;
  for (int i = 0; i < 30; i += 2) kernel_.frames[i].flags = V4L2_BUF_FLAG_ERROR;
  for (int i = 31; i < 60; i += 2) kernel_.frames[i].length_fraction = 0.5;
  ASSERT_EQ(start(), DeviceCode::ok);
  for (int i = 0; i < 25; ++i) {
    ASSERT_EQ(capture(), DeviceCode::ok);
    const auto special = kernel_.frames.find(static_cast<int>(frame_.sequence) - 1);
    EXPECT_EQ(special, kernel_.frames.end()) << frame_.sequence;
  }
  EXPECT_GT(camera().counters().damaged, 20U);
  EXPECT_EQ(camera().counters().delivered, 25U);
}

TEST_F(V4l2, SaysTornWhenNothingButDamageCame) {
  for (int i = 0; i < 1000; ++i) kernel_.frames[i].length_fraction = 0.9;
  ASSERT_EQ(start(), DeviceCode::ok);
  EXPECT_EQ(capture(), DeviceCode::torn_frame);
  EXPECT_EQ(camera().detail(), "a picture with rows missing");
  for (int i = 0; i < 1000; ++i) kernel_.frames[i] = {V4L2_BUF_FLAG_ERROR, 1.0, false};
  EXPECT_EQ(capture(), DeviceCode::torn_frame);
  EXPECT_EQ(camera().detail(), "the kernel marks the picture as damaged");
}

TEST_F(V4l2, DamagedJpegPicturesAreNeverDelivered) {
  kernel_.modes = {{V4L2_PIX_FMT_MJPEG, 64, 48, {30}}};
  std::vector<std::uint8_t> junk(2000, 0x55);
  kernel_.pictures[0] = junk;
  ASSERT_EQ(start(), DeviceCode::ok);
  EXPECT_EQ(capture(), DeviceCode::torn_frame);
  EXPECT_TRUE(detail_has("without its beginning"));
  junk[0] = 0xFF, junk[1] = 0xD8, junk[1998] = 0xFF, junk[1999] = 0xD9;
  kernel_.pictures = {{0, junk}};
  EXPECT_EQ(capture(), DeviceCode::torn_frame);
  EXPECT_FALSE(camera().detail().empty());
}

TEST_F(V4l2, CountsLostFramesByTheGapsInTheirNumbers) {
  params_.burst = 1;
  params_.settle_frames = 0;
  for (const int lost : {3, 4, 9}) kernel_.frames[lost].is_lost = true;
  ASSERT_EQ(start(), DeviceCode::ok);
  std::uint64_t last = 0;
  while (kernel_.frame_count < 15) {
    ASSERT_EQ(capture(), DeviceCode::ok);
    EXPECT_GT(frame_.sequence, last);
    last = frame_.sequence;
  }
  EXPECT_EQ(camera().counters().missed, 3U);
}

TEST_F(V4l2, APictureThatStaysTheSameByteByByteIsNotDelivered) {
  const std::vector<std::uint8_t> stuck(fake_frame_bytes(kernel_.modes[0]), 99);
  ASSERT_EQ(start(), DeviceCode::ok);
  ASSERT_EQ(capture(), DeviceCode::ok);
  kernel_.pictures[kernel_.frame_count] = stuck;
  clock_.sleep_for(1s);
  ASSERT_EQ(capture(), DeviceCode::ok);  // new once
  for (int i = 0; i < 3; ++i) EXPECT_EQ(capture(), DeviceCode::stale_frame);
  EXPECT_GE(camera().counters().repeated, 3U);
  kernel_.pictures.clear();
  clock_.sleep_for(1s);
  EXPECT_EQ(capture(), DeviceCode::ok);
}

TEST_F(V4l2, ACameraThatFallsSilentTimesOut) {
  ASSERT_EQ(start(), DeviceCode::ok);
  ASSERT_EQ(capture(), DeviceCode::ok);
  kernel_.is_silent = true;
  const Instant asked_at = clock_.now();
  EXPECT_EQ(capture(), DeviceCode::timed_out);
  EXPECT_LT(clock_.now() - asked_at, 2100ms);
  camera().stop();
  EXPECT_EQ(start(), DeviceCode::timed_out);
  EXPECT_EQ(camera().detail(), "it streams no pictures");
}

TEST_F(V4l2, UnplugIsToldAtOnceAndTheCameraComesBack) {
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(start(), DeviceCode::ok);
    ASSERT_EQ(capture(), DeviceCode::ok);
    kernel_.is_gone = true;
    const Instant asked_at = clock_.now();
    EXPECT_EQ(capture(), DeviceCode::device_gone);
    EXPECT_LT(clock_.now() - asked_at, 100ms);
    camera().stop();
    const Instant closed_at = clock_.now();
    EXPECT_GE(closed_at - asked_at, 200ms) << "closed while the kernel removes it";
    EXPECT_EQ(start(), DeviceCode::device_gone);
    EXPECT_EQ(clock_.now(), closed_at);
    kernel_.is_gone = false;
    kernel_.node = "/dev/video" + std::to_string(i % 3);
    params_.device = kernel_.node;
    camera_.reset();
  }
  EXPECT_EQ(kernel_.open_now, 0);
}

// While a USB camera is removed its buffers fail first.
TEST_F(V4l2, UnplugThatBeginsWithAFailedBufferIsTold) {
  ASSERT_EQ(start(), DeviceCode::ok);
  kernel_.errors[VIDIOC_DQBUF] = EIO;
  kernel_.errors[VIDIOC_QUERYCAP] = ENODEV;
  EXPECT_EQ(capture(), DeviceCode::device_gone);
}

// A wait may end without a frame.
TEST_F(V4l2, NewsThatIsNoFrameIsWaitedOver) {
  kernel_.errors[VIDIOC_DQBUF] = EAGAIN;
  ASSERT_EQ(start(), DeviceCode::ok) << camera().detail();
  kernel_.errors[VIDIOC_DQBUF] = EAGAIN;
  EXPECT_EQ(capture(), DeviceCode::ok) << camera().detail();
}

TEST_F(V4l2, AFailedBufferOfACameraThatIsThereIsNoUnplug) {
  ASSERT_EQ(start(), DeviceCode::ok);
  kernel_.errors[VIDIOC_DQBUF] = EIO;
  EXPECT_EQ(capture(), DeviceCode::io_error);
  EXPECT_EQ(capture(), DeviceCode::ok);
}

TEST_F(V4l2, AThousandStartsLeaveNothingOpen) {
  params_.settle_frames = 0;
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(start(), DeviceCode::ok);
    if (i % 10 == 0) {
      ASSERT_EQ(capture(), DeviceCode::ok);
    }
    camera().stop();
    ASSERT_EQ(kernel_.open_now, 0);
    ASSERT_EQ(kernel_.mapped_now, 0);
  }
  EXPECT_EQ(kernel_.opened, 1000);
}

TEST_F(V4l2, MakesDoWithTwoBuffers) {
  kernel_.buffer_limit = 2;
  ASSERT_EQ(start(), DeviceCode::ok);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(capture(), DeviceCode::ok);
  camera().stop();
  kernel_.buffer_limit = 1;
  EXPECT_EQ(start(), DeviceCode::io_error);
}

}  // namespace
}  // namespace traygauge
