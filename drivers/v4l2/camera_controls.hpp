// Exposure, gain, white balance and focus: the same for both views, proved by reading them back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "drivers/device_status.hpp"
#include "drivers/v4l2/video_device.hpp"

namespace traygauge {

enum class CameraControl : std::uint8_t { exposure, gain, white_balance, focus };
inline constexpr std::size_t kCameraControlCount = static_cast<std::size_t>(CameraControl::focus) + 1;
// As the configuration spells it, with its unit: exposure_us, gain, white_balance_k, focus.
const char* name(CameraControl control);

struct ControlWish {
  enum class Kind : std::uint8_t {
    // The camera's automatic settles, then keeps its value. Nothing where there is no such control, but for
    // exposure, which every camera has: that it cannot be held is told.
    hold,
    value,  // this value, from the start
    leave,  // as it is
  };
  Kind kind = Kind::hold;
  int value = 0;  // in the unit of the name; gain and focus: the camera's own
};
using ControlWishes = std::array<ControlWish, kCameraControlCount>;

class CameraControls {
 public:
  explicit CameraControls(VideoDevice& device) : device_(device) {}

  // Sets the given values, and switches the automatics of those to hold on. `width_px`: of the mode, which is
  // set; a sensor's line takes as long as its pixels.
  DeviceStatus prepare(const ControlWishes& wishes, int width_px);
  // Switches the automatics of those to hold on again, but for focus: the lens was calibrated at the one that
  // is held.
  DeviceStatus release(const ControlWishes& wishes);
  // Whether any automatic is on that lock() will switch off.
  bool is_automatic() const { return is_automatic_; }
  // After the picture has settled: switches every automatic off and sets what it found. Then each value that
  // was set or is held is what the camera says.
  DeviceStatus lock(const ControlWishes& wishes);
  // Which control, what was set and what the camera says; after a failure.
  const std::string& problem() const { return problem_; }
  // What is held of a control, in the unit of its name; nothing where the camera has none, or it may vary,
  // or counts lines and does not say how long one takes.
  std::optional<int> held(CameraControl control) const;
  // "exposure_us 15600, focus 30": what is held, after lock().
  std::string describe() const;

 private:
  struct Held {
    std::uint32_t id = 0;  // 0: the camera has no such control
    int value = 0;
    double unit = 1.0;  // how much of the name's unit a step of the camera is; 0: not known
  };
  DeviceStatus set_value(CameraControl control, int value);
  DeviceStatus find_settled(const ControlWishes& wishes);
  DeviceStatus hold(CameraControl control);
  DeviceStatus verify();
  DeviceStatus switch_automatic(CameraControl control, bool on);
  DeviceStatus fail(CameraControl control, DeviceStatus status, const std::string& what);

  VideoDevice& device_;
  std::array<Held, kCameraControlCount> held_{};
  bool is_automatic_ = false;
  double line_us_ = 0.0;  // 0: not known
  std::string problem_;
};

}  // namespace traygauge
