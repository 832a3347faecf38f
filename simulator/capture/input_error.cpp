#include "simulator/capture/input_error.hpp"

#include <utility>

namespace traygauge {
namespace {

std::string compose(const InputProblem& problem) {
  std::string text = problem.file.string();
  if (problem.line > 0) text += ":" + std::to_string(problem.line);
  if (!problem.key.empty()) text += ": " + problem.key;
  text += ": expected " + problem.expected;
  if (!problem.found.empty()) text += ", found " + problem.found;
  if (!problem.hint.empty()) text += "; " + problem.hint;
  return printable(text);
}

}  // namespace

InputError::InputError(InputProblem problem)
    : std::runtime_error(compose(problem)), problem_(std::move(problem)) {}

InputError::InputError(const InputFile& file, std::string expected, std::string found, std::string hint)
    : InputError(
          InputProblem{file.path, file.key, std::move(expected), std::move(found), std::move(hint), 0}) {}

std::string printable(const std::string& text) {
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    safe += code < 0x20 || code == 0x7f ? '?' : c;
  }
  return safe;
}

}  // namespace traygauge
