#include "firmware/base/csv_fields.hpp"

#include <cmath>

#include "firmware/base/text.hpp"

namespace traygauge {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_number(double value, int decimals) {
  return std::isnan(value) ? "" : fixed(value, decimals);
}

std::string csv_number(const std::optional<double>& value, int decimals) {
  return value ? fixed(*value, decimals) : "";
}

}  // namespace traygauge
