// `traygauge verify bodies`: the proof bodies to print.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

struct BodyOptions {
  std::filesystem::path out = "bodies.pdf";
  std::string paper = "a4";
};

void add_bodies_command(Program& program, BodyOptions& options);

// Writes the PDF and says what is in it. Exit status 0. Throws UsageError, OutputError.
int run_bodies(const BodyOptions& options, std::ostream& out);

}  // namespace traygauge
