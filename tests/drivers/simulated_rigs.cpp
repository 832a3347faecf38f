#include "simulator/devices/simulated_arm.hpp"
#include "simulator/devices/simulated_camera.hpp"
#include "simulator/devices/simulated_clock.hpp"
#include "simulator/devices/simulated_indicator.hpp"
#include "simulator/devices/simulated_trigger.hpp"
#include "tests/drivers/device_rigs.hpp"
#include "tests/simulator/devices/synthetic_captures.hpp"

namespace traygauge {
namespace {

class SimulatedCameraRig final : public Rig<Camera> {
 public:
  SimulatedCameraRig() { player_.handle_press(); }
  Camera& device() override { return camera_; }
  Clock& clock() override { return clock_; }

 private:
  SimulatedClock clock_;
  SyntheticCaptures captures_{1};
  TrayPlayer player_{captures_};
  SimulatedArm arm_{clock_, &player_};
  SimulatedCamera camera_{clock_, player_, &arm_};
};

class SimulatedArmRig final : public Rig<Arm> {
 public:
  Arm& device() override { return arm_; }
  Clock& clock() override { return clock_; }

 private:
  SimulatedClock clock_;
  SimulatedArm arm_{clock_};
};

class SimulatedIndicatorRig final : public Rig<Indicator> {
 public:
  Indicator& device() override { return lamp_; }
  Clock& clock() override { return clock_; }

 private:
  SimulatedClock clock_;
  SimulatedIndicator lamp_{clock_};
};

class SimulatedTriggerRig final : public TriggerRig {
 public:
  Trigger& device() override { return trigger_; }
  Clock& clock() override { return clock_; }
  void press_after(Nanoseconds delay, Nanoseconds held) override {
    trigger_.add_press(clock_.now() + delay);
    trigger_.hold_press(clock_.now() + delay, held);
  }

 private:
  SimulatedClock clock_;
  SimulatedTrigger trigger_{clock_, {Instant(std::chrono::hours(1))}};
};

}  // namespace

RigMakers<Rig<Camera>> simulated_camera_rigs() {
  return {{"simulated", [] { return std::make_unique<SimulatedCameraRig>(); }}};
}
RigMakers<Rig<Arm>> simulated_arm_rigs() {
  return {{"simulated", [] { return std::make_unique<SimulatedArmRig>(); }}};
}
RigMakers<Rig<Indicator>> simulated_indicator_rigs() {
  return {{"simulated", [] { return std::make_unique<SimulatedIndicatorRig>(); }}};
}
RigMakers<TriggerRig> simulated_trigger_rigs() {
  return {{"simulated", [] { return std::make_unique<SimulatedTriggerRig>(); }}};
}

}  // namespace traygauge
