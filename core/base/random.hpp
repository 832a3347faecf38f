// The one source of randomness: a seed gives the same samples with every compiler and standard library.
#pragma once

#include <cstdint>

namespace traygauge {

// Where any sequence will do, as long as it is the same at each call.
inline constexpr std::uint64_t kFixedSeed = 1;

// PCG32 (O'Neill 2014, XSH-RR): 64 bits of state, 32 bits out.
class Random {
 public:
  constexpr explicit Random(std::uint64_t seed) {
    next();
    state_ += seed;
    next();
  }

  constexpr std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ULL + kIncrement;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
    const auto rotation = static_cast<std::uint32_t>(old >> 59U);
    return (shifted >> rotation) | (shifted << ((32U - rotation) & 31U));
  }

  // Uniform in [0, bound); bound > 0. Lemire's multiply-shift: the bias is below bound / 2^32.
  constexpr std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(next()) * bound) >> 32U);
  }

  // Uniform in [0, 1).
  constexpr double uniform() { return next() * (1.0 / 4294967296.0); }

 private:
  // O'Neill's own stream.
  static constexpr std::uint64_t kIncrement = 1442695040888963407ULL;
  std::uint64_t state_ = 0;
};

}  // namespace traygauge
