// `traygauge collect`: the store behind the broker.
#pragma once

#include <atomic>
#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

struct CollectCommand {
  std::string config;
  bool only_check = false;  // says whether the file and what it names are as expected
};

void add_collect_options(Program& program, CollectCommand& command);

// Runs until `stop`. Throws UsageError and InputError before anything is done.
int run_collect(const CollectCommand& command, const std::atomic<bool>& stop, std::ostream& out,
                std::ostream& log);

}  // namespace traygauge
