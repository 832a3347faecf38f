// How a command ends.
#pragma once

#include <stdexcept>

namespace traygauge {

inline constexpr int kExitMeasured = 0;       // or: done
inline constexpr int kExitNotMeasurable = 1;  // the status says why
inline constexpr int kExitWrongUse = 2;       // wrong options, unreadable input, unwritable output

// The command was called wrongly; what() is one sentence that says what to do.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace traygauge
