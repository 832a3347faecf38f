// `traygauge record`: captures from a station's devices.
#pragma once

#include <atomic>
#include <cstdint>
#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

struct RecordOptions {
  std::string station;  // a station file
  std::string out;
  bool pictures = false;    // single ones, for calibrating
  std::uint64_t count = 0;  // 0: until it is stopped
};

void add_record_command(Program& program, RecordOptions& options);

// Exit status: all captures saved, or some not. Throws InputError and OutputError before a device is opened.
int run_record(const RecordOptions& options, const std::atomic<bool>& stop, std::ostream& out,
               std::ostream& log);

}  // namespace traygauge
