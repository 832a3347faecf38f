// How far long work has come.
#pragma once

#include <chrono>
#include <cstddef>
#include <iosfwd>
#include <string>
#include <utility>

namespace traygauge {

// A bar that overwrites itself on a terminal; elsewhere a line every half minute.
class Progress {
 public:
  // `what` is counted, in the plural.
  Progress(std::ostream& stream, bool is_terminal, std::string what = "measurements")
      : stream_(stream), is_terminal_(is_terminal), what_(std::move(what)) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  void show(std::size_t done, std::size_t all);

 private:
  using Clock = std::chrono::steady_clock;
  void erase();

  std::ostream& stream_;
  bool is_terminal_;
  std::string what_;
  bool is_shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

// "[#####     ]  50 %, 4 of 8 measurements, 10 s left"; 0 < done <= all.
std::string compose_progress(std::size_t done, std::size_t all, double elapsed_s,
                             const std::string& what = "measurements");

// "45 s", "3 min 20 s", "1 h 05 min".
std::string compose_duration(double seconds);

}  // namespace traygauge
