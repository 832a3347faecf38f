// What people are told when they try a station's devices.
#include "firmware/check/device_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>

#include "tests/firmware/command_runner.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

// A camera that sees one grey, or fails.
class GreyCamera final : public Camera {
 public:
  GreyCamera() : Camera("grey camera") {}
  int grey = 128;
  DeviceStatus start_status;
  DeviceStatus capture_status;

 private:
  DeviceStatus do_start() override {
    if (!start_status.ok()) set_detail("/dev/video3");
    return start_status;
  }
  void do_stop() override {}
  CameraFormat do_format() const override { return {32, 16, PixelFormat::bgr8}; }
  DeviceStatus do_capture(std::span<std::uint8_t> buffer, Nanoseconds, CapturedFrame& frame) override {
    if (!capture_status.ok()) return capture_status;
    std::fill(buffer.begin(), buffer.end(), static_cast<std::uint8_t>(grey));
    frame.view = {buffer.data(), 32, 16, 96, PixelFormat::bgr8};
    frame.sequence = ++sequence_;
    return DeviceCode::ok;
  }
  std::uint64_t sequence_ = 0;
};

TEST(DeviceCheck, LooksAtTheBrightness) {
  GreyCamera camera;
  TakenPicture picture;
  EXPECT_TRUE(check_camera(camera, picture).is_good);
  EXPECT_EQ(check_camera(camera, picture).text, "mean brightness 128 of 255");
  camera.grey = 12;
  EXPECT_FALSE(check_camera(camera, picture).is_good);
  EXPECT_EQ(check_camera(camera, picture).text,
            "The picture is too dark, mean brightness 12 of 255; add light, or raise exposure_us or gain.");
  camera.grey = 250;
  EXPECT_EQ(check_camera(camera, picture).text,
            "The picture is too bright, mean brightness 250 of 255; lower exposure_us or gain.");
}

TEST(DeviceCheck, SaysWhatIsWrongInPlainWords) {
  GreyCamera camera;
  camera.start_status = {DeviceCode::no_permission, EACCES};
  TakenPicture picture;
  const CheckResult result = check_camera(camera, picture);
  EXPECT_FALSE(result.is_good);
  EXPECT_EQ(result.device, "grey camera");
  EXPECT_EQ(result.text,
            "This user may not open the device; add the user to its group and log in again: video for "
            "cameras, dialout "
            "for serial lines, gpio for lines of the board once config/60-traygauge-gpio.rules is installed. "
            "(/dev/video3) [Permission denied]");
  GreyCamera torn;
  torn.capture_status = DeviceCode::torn_frame;
  EXPECT_FALSE(check_camera(torn, picture).is_good);
}

TEST(DeviceCheck, MeanGreyLeavesPaddingOut) {
  std::vector<std::uint8_t> pixels(4 * 10, 200);
  for (std::size_t y = 0; y < 4; ++y)
    std::fill_n(pixels.begin() + static_cast<std::ptrdiff_t>(10 * y), 6, 50);
  EXPECT_EQ(mean_grey({pixels.data(), 6, 4, 10, PixelFormat::gray8}), 50.0);
}

class CommandsOnAbsentDevices : public testing::Test {
 protected:
  std::string station() {
    const auto file = folder_.path() / "station.toml";
    write_text(file, "[camera]\ndevice = \"serial:none-such\"\n[button]\nline = \"none-such/3\"\n");
    return file.string();
  }
  TemporaryFolder folder_;
};

TEST_F(CommandsOnAbsentDevices, CheckTriesEveryDeviceAndEndsWithOne) {
  const CommandResult result = run({"check", station()});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("FAIL  camera serial:none-such: "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("FAIL  button none-such/3: "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("FAIL  lens and card: "), std::string::npos) << result.out;
  EXPECT_EQ(result.error, "");
}

TEST_F(CommandsOnAbsentDevices, StationAndRecordNeedTheLensBeforeAnythingIsOpened) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"station", "--devices", "hardware:" + station()},
        std::vector<std::string>{"record", station(), "--out", (folder_.path() / "out").string()}}) {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments[0];
    EXPECT_NE(result.error.find(": lens: expected fx, fy, cx, cy and distortion of the lens"),
              std::string::npos)
        << result.error;
  }
}

TEST_F(CommandsOnAbsentDevices, AnAbsentFileAndFaultsOnHardwareAreRefused) {
  EXPECT_EQ(run({"check", "/no/such/station.toml"}).status, 2);
  EXPECT_EQ(run({"station", "--devices", "hardware:" + station(), "--faults", "x.toml"}).status, 2);
  EXPECT_EQ(run({"station", "--devices", "toaster"}).error,
            "traygauge: --devices: expected hardware:FILE or simulator:FOLDER, found toaster\n");
}

}  // namespace
}  // namespace traygauge
