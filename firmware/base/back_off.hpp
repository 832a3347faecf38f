// How long to wait before the next attempt.
#pragma once

#include <chrono>
#include <cstdint>
#include <random>

namespace traygauge {

// Twice as long after each failure, up to a longest wait. Chance takes up to a quarter off each, so that hubs
// whose receiver was away do not all come back at the same moment.
class BackOff {
 public:
  using Milliseconds = std::chrono::milliseconds;

  BackOff(Milliseconds shortest, Milliseconds longest, std::uint32_t seed)
      : shortest_(shortest), longest_(longest), next_(shortest), random_(seed) {}

  Milliseconds after_failure();
  // Where trying soon cannot help: the longest wait, now and at the next failure.
  Milliseconds after_refusal();
  void reset() { next_ = shortest_; }

 private:
  Milliseconds shortened(Milliseconds wait);

  Milliseconds shortest_;
  Milliseconds longest_;
  Milliseconds next_;
  std::minstd_rand random_;
};

}  // namespace traygauge
