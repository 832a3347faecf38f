#include "drivers/gpio/gpio_indicator.hpp"

#include <utility>

namespace traygauge {

GpioIndicator::GpioIndicator(std::vector<std::unique_ptr<GpioLine>> lamps, const LampTable& table)
    : Indicator("lamp"), lamps_(std::move(lamps)), table_(table) {
  table_[static_cast<std::size_t>(Signal::off)] = 0;
}

DeviceStatus GpioIndicator::do_start() {
  set_detail({});
  for (const auto& lamp : lamps_) {
    const DeviceStatus status = lamp->open_output(false);
    if (status.ok()) continue;
    set_detail(lamp->problem());
    for (const auto& opened : lamps_) opened->close();
    return status;
  }
  return DeviceCode::ok;
}

void GpioIndicator::do_stop() {
  static_cast<void>(light(0));  // a line that has gone is dark
  for (const auto& lamp : lamps_) lamp->close();
}

DeviceStatus GpioIndicator::do_show(Signal signal) {
  return light(table_[static_cast<std::size_t>(signal)]);
}

// All lamps are tried: one that failed does not leave the others wrong.
DeviceStatus GpioIndicator::light(std::uint32_t lamps) {
  DeviceStatus status = DeviceCode::ok;
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    const DeviceStatus written = lamps_[i]->write((lamps >> i & 1U) != 0);
    if (written.ok()) continue;
    status = written;
    set_detail(lamps_[i]->problem());
  }
  return status;
}

}  // namespace traygauge
