#include "firmware/check/device_check.hpp"

#include <cstring>

#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

constexpr Nanoseconds kPictureTimeout = std::chrono::seconds(2);
constexpr Nanoseconds kSignalShown = std::chrono::milliseconds(300);

CheckResult good(const Device& device, const std::string& text) {
  return {std::string(device.description()), true, text};
}

}  // namespace

CheckResult describe_failure(const Device& device, DeviceStatus status) {
  std::string text = sentence(status.code());
  if (!device.detail().empty()) text += " (" + std::string(device.detail()) + ")";
  if (status.error_number() != 0) text += std::string(" [") + std::strerror(status.error_number()) + "]";
  return {std::string(device.description()), false, text};
}

double mean_grey(const FrameView& frame) {
  double sum = 0.0;
  const int row_bytes = frame.width * bytes_per_pixel(frame.format);
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* const row = frame.data + y * frame.stride_bytes;
    std::uint64_t row_sum = 0;
    for (int i = 0; i < row_bytes; ++i) row_sum += row[i];
    sum += static_cast<double>(row_sum);
  }
  return sum / (static_cast<double>(row_bytes) * frame.height);
}

DeviceStatus take_pictures(Camera& camera, int count, TakenPicture& picture) {
  picture.pixels.resize(camera.format().frame_bytes());
  DeviceStatus status;
  for (int i = 0; i < count && status.ok(); ++i)
    status = camera.capture(picture.pixels, kPictureTimeout, picture.frame);
  return status;
}

CheckResult check_camera(Camera& camera, TakenPicture& picture, const PictureCheckParams& params) {
  DeviceStatus status = camera.start();
  if (status.ok()) status = take_pictures(camera, params.pictures, picture);
  if (!status.ok()) return describe_failure(camera, status);
  const double mean = mean_grey(picture.frame.view);
  const std::string brightness = "mean brightness " + fixed(mean, 0) + " of 255";
  const std::string name(camera.description());
  if (mean < params.darkest_mean) {
    return {name, false,
            "The picture is too dark, " + brightness + "; add light, or raise exposure_us or gain."};
  }
  if (mean > params.brightest_mean) {
    return {name, false, "The picture is too bright, " + brightness + "; lower exposure_us or gain."};
  }
  return {name, true, brightness};
}

CheckResult check_press(Trigger& trigger, Nanoseconds timeout) {
  DeviceStatus status = trigger.start();
  if (!status.ok()) return describe_failure(trigger, status);
  Press press;
  status = trigger.wait_for_press(timeout, press);
  trigger.stop();
  if (status.code() == DeviceCode::timed_out) {
    return {std::string(trigger.description()), false,
            "No press came; check the wire, active_low and bias of [button]."};
  }
  return status.ok() ? good(trigger, "pressed") : describe_failure(trigger, status);
}

CheckResult check_lamp(Indicator& lamp, Clock& clock) {
  DeviceStatus status = lamp.start();
  for (std::size_t i = 1; status.ok() && i < kSignalCount; ++i) {
    status = lamp.show(static_cast<Signal>(i));
    clock.sleep_for(kSignalShown);
  }
  lamp.stop();
  return status.ok() ? good(lamp, "showed every signal") : describe_failure(lamp, status);
}

CheckResult check_homing(Arm& arm, Nanoseconds timeout) {
  DeviceStatus status = arm.start();
  if (status.ok()) status = arm.home(timeout);
  return status.ok() ? good(arm, "at home") : describe_failure(arm, status);
}

CheckResult check_turn(Arm& arm, double angle_deg, Nanoseconds timeout) {
  const DeviceStatus status = arm.move_to(angle_deg, timeout);
  return status.ok() ? good(arm, "at " + fixed(angle_deg, 1) + " degrees") : describe_failure(arm, status);
}

}  // namespace traygauge
