// The devices that every contract test runs on. A rig holds one device and what it needs; hardware joins by a
// rig of its own, whose maker returns null where the hardware is absent (the test is then skipped).
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
  virtual void press_after(Nanoseconds delay) = 0;  // from now; once
};

template <class RigType>
struct RigMaker {
  std::string name;
  std::function<std::unique_ptr<RigType>()> make;

  friend std::ostream& operator<<(std::ostream& out, const RigMaker& maker) { return out << maker.name; }
};

std::vector<RigMaker<Rig<Camera>>> camera_rigs();
std::vector<RigMaker<Rig<Arm>>> arm_rigs();
std::vector<RigMaker<Rig<Indicator>>> indicator_rigs();
std::vector<RigMaker<TriggerRig>> trigger_rigs();

}  // namespace traygauge
