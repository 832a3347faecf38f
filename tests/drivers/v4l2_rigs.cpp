#include <cstdlib>
#include <sstream>

#include "drivers/v4l2/v4l2_camera.hpp"
#include "tests/drivers/device_rigs.hpp"
#include "tests/drivers/v4l2/fake_video_device.hpp"

namespace traygauge {
namespace {

class ModelCameraRig final : public Rig<Camera> {
 public:
  Camera& device() override { return camera_; }
  Clock& clock() override { return clock_; }

 private:
  static V4l2CameraParams params(const FakeCamera& kernel) {
    V4l2CameraParams params;
    params.device = kernel.node;
    params.mode = {64, 48, "", 0.0};
    return params;
  }
  SimulatedClock clock_;
  FakeCamera kernel_{clock_};
  V4l2Camera camera_{make_fake_video_device(kernel_), clock_, params(kernel_)};
};

class KernelCameraRig final : public Rig<Camera> {
 public:
  explicit KernelCameraRig(const V4l2CameraParams& params)
      : camera_(make_system_video_device(), clock_, params) {}
  Camera& device() override { return camera_; }
  Clock& clock() override { return clock_; }

 private:
  SystemClock clock_;
  V4l2Camera camera_;
};

}  // namespace

// TRAYGAUGE_BOARD_CAMERAS: "NODE,WIDTH,HEIGHT,FORMAT" for each, separated by spaces.
RigMakers<Rig<Camera>> v4l2_rigs() {
  RigMakers<Rig<Camera>> makers = {{"v4l2_model", [] { return std::make_unique<ModelCameraRig>(); }}};
  const char* const cameras = std::getenv("TRAYGAUGE_BOARD_CAMERAS");
  std::istringstream list(cameras != nullptr ? cameras : "");
  for (std::string entry; list >> entry;) {
    std::istringstream fields(entry);
    V4l2CameraParams params;
    std::string width;
    std::string height;
    std::getline(fields, params.device, ',');
    std::getline(fields, width, ',');
    std::getline(fields, height, ',');
    std::getline(fields, params.mode.format, ',');
    params.mode.width = std::stoi(width);
    params.mode.height = std::stoi(height);
    params.settle_frames = 2;
    params.controls[static_cast<std::size_t>(CameraControl::exposure)].kind =
        ControlWish::Kind::leave;  // vivid has none
    params.may_repeat = true;
    const std::string name = "v4l2_" + params.mode.format + "_" + std::to_string(makers.size());
    makers.push_back({name, [params] { return std::make_unique<KernelCameraRig>(params); }});
  }
  return makers;
}

}  // namespace traygauge
