#include <charconv>

#include "drivers/gpio/gpio_line.hpp"

namespace traygauge {

bool parse_gpio_place(const std::string& line, GpioPlace& place) {
  place = {};
  const std::size_t slash = line.rfind('/');
  if (slash == std::string::npos) {
    place.name = line;
    return !line.empty();
  }
  place.chip = line.substr(0, slash);
  const char* const begin = line.data() + slash + 1;
  const char* const end = line.data() + line.size();
  const auto [rest, error] = std::from_chars(begin, end, place.offset);
  return !place.chip.empty() && begin != end && rest == end && error == std::errc();
}

std::string describe_line(const std::string& line, DeviceStatus status, const std::string& consumer) {
  std::string text = "line " + line;
  switch (status.code()) {
    case DeviceCode::device_gone:
      return text + ": no chip has it; gpioinfo lists those that there are";
    case DeviceCode::invalid_argument:
      return text + ": neither a name, nor chip and number such as gpiochip0/17";
    case DeviceCode::in_use:
      return consumer.empty() ? text : text + ", which \"" + consumer + "\" has taken";
    default:
      return text;
  }
}

}  // namespace traygauge
