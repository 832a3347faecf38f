#include "firmware/setup/dialogue.hpp"

#include <istream>
#include <ostream>

#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

constexpr const char* kBlanks = " \t\r";

std::string without_blanks(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(kBlanks);
  return begin == std::string::npos ? "" : line.substr(begin, line.find_last_not_of(kBlanks) + 1 - begin);
}

}  // namespace

void Dialogue::say(const std::string& text) {
  out_ << text << std::endl;
}

std::string Dialogue::ask(const std::string& question, const std::string& usual) {
  out_ << question << (usual.empty() ? "" : " [" + printable(usual) + "]") << " > " << std::flush;
  std::string line;
  if (!std::getline(in_, line)) {
    out_ << std::endl;
    throw DialogueEnded();
  }
  line = without_blanks(line);
  return line.empty() ? usual : line;
}

bool Dialogue::confirm(const std::string& question, bool usual) {
  while (true) {
    const std::string answer = ask(question + (usual ? " [Y/n]" : " [y/N]"));
    if (answer.empty()) return usual;
    if (answer == "y" || answer == "Y" || answer == "yes") return true;
    if (answer == "n" || answer == "N" || answer == "no") return false;
    say("Type y or n.");
  }
}

void Dialogue::ask_until(const std::string& question, const std::string& usual,
                         const std::function<std::string(const std::string&)>& take) {
  while (true) {
    const std::string problem = take(ask(question, usual));
    if (problem.empty()) return;
    say(problem);
  }
}

bool Dialogue::try_again() {
  while (true) {
    const std::string answer = ask("Enter: try again; s: leave this step out; q: end");
    if (answer.empty()) return true;
    if (answer == "s") return false;
    if (answer == "q") throw DialogueEnded();
  }
}

}  // namespace traygauge
