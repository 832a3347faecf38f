// Lamps on GPIO lines.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/gpio/gpio_line.hpp"
#include "drivers/indicator.hpp"

namespace traygauge {

// Which lamps are lit for each signal: bit i is lamp i. None for `off`.
using LampTable = std::array<std::uint32_t, kSignalCount>;

class GpioIndicator final : public Indicator {
 public:
  // At most 32 lamps.
  GpioIndicator(std::vector<std::unique_ptr<GpioLine>> lamps, const LampTable& table);
  ~GpioIndicator() override { stop(); }

 private:
  DeviceStatus do_start() override;
  void do_stop() override;
  DeviceStatus do_show(Signal signal) override;
  DeviceStatus light(std::uint32_t lamps);

  std::vector<std::unique_ptr<GpioLine>> lamps_;
  LampTable table_;
};

}  // namespace traygauge
