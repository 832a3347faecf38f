// Fields of CSV files.
#pragma once

#include <optional>
#include <string>

namespace traygauge {

// Quoted where it has to be (RFC 4180).
std::string csv_field(const std::string& text);

// Blank where not defined.
std::string csv_number(double value, int decimals);
std::string csv_number(const std::optional<double>& value, int decimals);

}  // namespace traygauge
