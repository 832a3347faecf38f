// `traygauge hub`: stores what stations measure.
#pragma once

#include <atomic>
#include <iosfwd>
#include <string>
#include <vector>

namespace traygauge {

class Program;

struct HubCommand {
  std::string config;  // a station file; empty: socket and store are given
  std::string socket;
  std::string store;
  std::string last_good;    // where the last good station file is kept; empty: nowhere
  bool only_check = false;  // says whether configuration and store are as expected
  std::vector<std::string> listen;
};

// Adds the command's options; parsing fills `command`.
void add_hub_options(Program& program, HubCommand& command);

// Runs until `stop`. Throws UsageError and InputError before anything is done.
int run_hub(const HubCommand& command, const std::atomic<bool>& stop, std::ostream& out, std::ostream& log);

}  // namespace traygauge
