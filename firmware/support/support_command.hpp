// `traygauge support`: one file for a developer, when a station misbehaves.
#pragma once

#include <filesystem>
#include <iosfwd>

namespace traygauge {

class Program;

struct SupportOptions {
  std::filesystem::path station;  // a station file, which may be bad or absent
  std::filesystem::path out;      // a tar.gz
};

void add_support_command(Program& program, SupportOptions& options);

// Writes texts only: no picture, no capture, no database. Exit status: 0. Throws UsageError where the file
// cannot be written.
int run_support(const SupportOptions& options, std::ostream& out);

}  // namespace traygauge
