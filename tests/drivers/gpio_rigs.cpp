#include <cstdlib>
#include <thread>

#include "drivers/gpio/gpio_indicator.hpp"
#include "drivers/gpio/gpio_trigger.hpp"
#include "drivers/serial/serial_arm.hpp"
#include "tests/drivers/arm_plant.hpp"
#include "tests/drivers/device_rigs.hpp"
#include "tests/drivers/serial/arm_controller.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

using MakeBench = std::function<std::unique_ptr<GpioBench>()>;

class GpioTriggerRig final : public TriggerRig {
 public:
  explicit GpioTriggerRig(const MakeBench& make) : bench_(make()) { bench_->set_input("TRIGGER", false); }
  ~GpioTriggerRig() override {
    for (std::thread& finger : fingers_) finger.join();
  }
  Trigger& device() override { return trigger_; }
  Clock& clock() override { return clock_; }
  void press_after(Nanoseconds delay, Nanoseconds held) override {
    const Instant at = clock_.now() + delay;
    fingers_.emplace_back([this, at, held] {
      clock_.sleep_until(at);
      bench_->set_input("TRIGGER", true);
      clock_.sleep_for(held);
      bench_->set_input("TRIGGER", false);
    });
  }

 private:
  SystemClock clock_;
  std::unique_ptr<GpioBench> bench_;
  std::vector<std::thread> fingers_;
  GpioTrigger trigger_{bench_->make_line("TRIGGER"), clock_, {}};
};

class GpioIndicatorRig final : public Rig<Indicator> {
 public:
  explicit GpioIndicatorRig(const MakeBench& make) : bench_(make()), lamp_(make_lamps(), table()) {}
  Indicator& device() override { return lamp_; }
  Clock& clock() override { return clock_; }

 private:
  static LampTable table() { return {0, 1, 2, 3, 4, 5, 6, 7, 1, 2}; }
  std::vector<std::unique_ptr<GpioLine>> make_lamps() {
    std::vector<std::unique_ptr<GpioLine>> lamps;
    for (const char* name : {"GREEN", "YELLOW", "RED"}) lamps.push_back(bench_->make_line(name));
    return lamps;
  }
  SystemClock clock_;
  std::unique_ptr<GpioBench> bench_;
  GpioIndicator lamp_;
};

class StepperRig final : public Rig<Arm> {
 public:
  explicit StepperRig(const MakeBench& make) : bench_(make()) {}
  Arm& device() override { return arm_; }
  Clock& clock() override { return clock_; }

 private:
  SystemClock clock_;
  std::unique_ptr<GpioBench> bench_;
  ArmPlant plant_{*bench_};
  StepperArm arm_{plant_.lines(), clock_, ArmPlant::params()};
};

class SerialArmRig final : public Rig<Arm> {
 public:
  Arm& device() override { return arm_; }
  Clock& clock() override { return clock_; }

 private:
  static SerialArmParams params(const ArmController& controller) {
    SerialArmParams params;
    params.device = controller.path();
    params.settling_time = 10ms;
    return params;
  }
  SystemClock clock_;
  ArmController controller_;
  SerialArm arm_{clock_, params(controller_)};
};

// TRAYGAUGE_BOARD_GPIO: the folder of gpio-sim's chip in sysfs.
std::vector<std::pair<std::string, MakeBench>> benches() {
  std::vector<std::pair<std::string, MakeBench>> list = {{"model", make_model_bench}};
  if (const char* const folder = std::getenv("TRAYGAUGE_BOARD_GPIO")) {
    list.emplace_back("gpio_sim", [folder] {
      return make_gpio_sim_bench(
          folder, {"TRIGGER", "GREEN", "YELLOW", "RED", "BLUE", "STEP", "DIR", "ENABLE", "HOME"});
    });
  }
  return list;
}

template <class RigType, class Base>
RigMakers<Base> makers(const std::string& prefix) {
  RigMakers<Base> list;
  for (const auto& [name, make] : benches()) {
    list.push_back({prefix + "_" + name, [make = make] { return std::make_unique<RigType>(make); }});
  }
  return list;
}

}  // namespace

RigMakers<TriggerRig> gpio_trigger_rigs() {
  return makers<GpioTriggerRig, TriggerRig>("gpio");
}
RigMakers<Rig<Indicator>> gpio_indicator_rigs() {
  return makers<GpioIndicatorRig, Rig<Indicator>>("gpio");
}
RigMakers<Rig<Arm>> gpio_arm_rigs() {
  auto list = makers<StepperRig, Rig<Arm>>("stepper");
  list.push_back({"serial", [] { return std::make_unique<SerialArmRig>(); }});
  return list;
}

}  // namespace traygauge
