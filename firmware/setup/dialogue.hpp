// Questions to a person at a terminal.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace traygauge {

// Thrown where the person leaves, or the input ends: what was set up so far stays.
struct DialogueEnded {};

class Dialogue {
 public:
  Dialogue(std::istream& in, std::ostream& out) : in_(in), out_(out) {}

  // A paragraph.
  void say(const std::string& text);
  // One line, without blanks around it; `usual` where nothing is typed. Throws DialogueEnded.
  std::string ask(const std::string& question, const std::string& usual = {});
  bool confirm(const std::string& question, bool usual);
  // Asks until `take` returns an empty text; else that says what is wrong with the answer.
  void ask_until(const std::string& question, const std::string& usual,
                 const std::function<std::string(const std::string&)>& take);
  // After a failure: true to try again, false to leave this step out. Throws DialogueEnded.
  bool try_again();

  std::ostream& out() { return out_; }

 private:
  std::istream& in_;
  std::ostream& out_;
};

}  // namespace traygauge
