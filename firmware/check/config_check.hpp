// `traygauge config check`: whether a station file is as expected, without a look at the devices.
#pragma once

#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

struct ConfigCheckOptions {
  std::string station;  // a station file
};

void add_config_command(Program& program, ConfigCheckOptions& options);

// Reads what station and hub would read at their start: the file, dishes, card and labels, files of tokens.
// Throws InputError with file, line, key, what was expected and found. Exit status: 0, or the hub's.
int run_config_check(const ConfigCheckOptions& options, std::ostream& out);

}  // namespace traygauge
