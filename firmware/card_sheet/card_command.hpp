// `traygauge card`: the reference card to print, its picture, and what a caliper says of the finished one.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

struct CardOptions {
  int pattern = 1;
  std::string paper = "a4";
  std::filesystem::path out = ".";
  std::string measured;  // "84.9x53.6"; empty: the card is made
};

void add_card_command(Program& program, CardOptions& options);

// Writes card.pdf and card.png, or says the [card] lines of a measured card. Exit status 0. Throws
// UsageError, OutputError.
int run_card(const CardOptions& options, std::ostream& out);

}  // namespace traygauge
