// The devices that every contract test runs on: simulated ones, the drivers on models of the kernel, and
// where TRAYGAUGE_BOARD_GPIO and TRAYGAUGE_BOARD_CAMERAS are set, on a kernel's own devices (tests/board). A
// rig holds one device and what it needs.
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "drivers/arm.hpp"
#include "drivers/camera.hpp"
#include "drivers/clock.hpp"
#include "drivers/indicator.hpp"
#include "drivers/trigger.hpp"

namespace traygauge {

template <class Device>
class Rig {
 public:
  virtual ~Rig() = default;
  virtual Device& device() = 0;
  virtual Clock& clock() = 0;
};

class TriggerRig : public Rig<Trigger> {
 public:
  virtual void press_after(Nanoseconds delay, Nanoseconds held) = 0;  // from now; once
};

template <class RigType>
struct RigMaker {
  std::string name;
  std::function<std::unique_ptr<RigType>()> make;

  friend std::ostream& operator<<(std::ostream& out, const RigMaker& maker) { return out << maker.name; }
};

template <class RigType>
using RigMakers = std::vector<RigMaker<RigType>>;

RigMakers<Rig<Camera>> camera_rigs();
RigMakers<Rig<Arm>> arm_rigs();
RigMakers<Rig<Indicator>> indicator_rigs();
RigMakers<TriggerRig> trigger_rigs();

// What the above are made of.
RigMakers<Rig<Camera>> simulated_camera_rigs();
RigMakers<Rig<Arm>> simulated_arm_rigs();
RigMakers<Rig<Indicator>> simulated_indicator_rigs();
RigMakers<TriggerRig> simulated_trigger_rigs();
RigMakers<Rig<Camera>> v4l2_rigs();
RigMakers<Rig<Arm>> gpio_arm_rigs();  // and the serial one
RigMakers<Rig<Indicator>> gpio_indicator_rigs();
RigMakers<TriggerRig> gpio_trigger_rigs();

}  // namespace traygauge
