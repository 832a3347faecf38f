// What a person is told about an input that cannot be used.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace traygauge {

// A file, and the entry (of capture.json, say) that names it; `key` may be empty.
struct InputFile {
  std::filesystem::path path;
  std::string key;
};

// Which file, where in it, what was expected there, what was found, and what to do.
struct InputProblem {
  std::filesystem::path file;
  std::string key;
  std::string expected;
  std::string found;
  std::string hint;
  int line = 0;  // from 1; 0: not known
};

// what() is the whole sentence, on one line.
class InputError : public std::runtime_error {
 public:
  explicit InputError(InputProblem problem);
  InputError(const InputFile& file, std::string expected, std::string found, std::string hint);

  const InputProblem& problem() const { return problem_; }

 private:
  InputProblem problem_;
};

// Text from a file or a command line, made safe for one line on a terminal.
std::string printable(const std::string& text);

}  // namespace traygauge
