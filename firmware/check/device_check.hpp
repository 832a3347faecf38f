// Tries a station's devices, one after the other, and says what is wrong and what to do.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "drivers/arm.hpp"
#include "drivers/camera.hpp"
#include "drivers/clock.hpp"
#include "drivers/device.hpp"
#include "drivers/device_status.hpp"
#include "drivers/indicator.hpp"
#include "drivers/trigger.hpp"

namespace traygauge {

// What became of one device: `text` is a sentence or two for people.
struct CheckResult {
  std::string device;
  bool is_good = false;
  std::string text;
};

// A failure in plain words: the status's sentence, and more where the device knows it.
CheckResult describe_failure(const Device& device, DeviceStatus status);

// What can be said of pictures that a camera delivered.
struct PictureCheckParams {
  int pictures = 5;
  double darkest_mean = 40.0;     // of 255; below, noise drowns the food's texture
  double brightest_mean = 225.0;  // above, white dishes are clipped
};

// A picture with its pixels.
struct TakenPicture {
  std::vector<std::uint8_t> pixels;
  CapturedFrame frame;
};

// Takes so many pictures with a camera that is started; the last one stays.
DeviceStatus take_pictures(Camera& camera, int count, TakenPicture& picture);

// Starts the camera, takes pictures and looks at their brightness; it stays started. The last picture stays
// in `picture`.
CheckResult check_camera(Camera& camera, TakenPicture& picture, const PictureCheckParams& params = {});

// Waits so long for a press; the button is closed afterwards.
CheckResult check_press(Trigger& trigger, Nanoseconds timeout);

// Shows every signal for a moment; the lamp is closed afterwards.
CheckResult check_lamp(Indicator& lamp, Clock& clock);

// The arm stays started.
CheckResult check_homing(Arm& arm, Nanoseconds timeout);
CheckResult check_turn(Arm& arm, double angle_deg, Nanoseconds timeout);

// The mean grey of a picture.
double mean_grey(const FrameView& frame);

}  // namespace traygauge
