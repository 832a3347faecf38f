#include "tests/drivers/device_rigs.hpp"

namespace traygauge {
namespace {

template <class List>
List join(List all, const List& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

RigMakers<Rig<Camera>> camera_rigs() {
  return join(simulated_camera_rigs(), v4l2_rigs());
}
RigMakers<Rig<Arm>> arm_rigs() {
  return join(simulated_arm_rigs(), gpio_arm_rigs());
}
RigMakers<Rig<Indicator>> indicator_rigs() {
  return join(simulated_indicator_rigs(), gpio_indicator_rigs());
}
RigMakers<TriggerRig> trigger_rigs() {
  return join(simulated_trigger_rigs(), gpio_trigger_rigs());
}

}  // namespace traygauge
