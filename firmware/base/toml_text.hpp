// Values as TOML writes them.
#pragma once

#include <string>

namespace traygauge {

// The shortest decimal that reads back as the same number, with a point: TOML keeps integers apart.
std::string toml_number(double value);

// A basic string, whatever the text holds.
std::string toml_text(const std::string& text);

}  // namespace traygauge
