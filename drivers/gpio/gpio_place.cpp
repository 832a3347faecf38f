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

}  // namespace traygauge
