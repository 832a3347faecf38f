// The seed of a test over random inputs.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>

namespace traygauge::test {

// TRAYGAUGE_SEED where it is set. Where CI is set always the same, so that a failure there comes from the
// change; else another each time. Printed at once: a crash must not swallow it.
inline std::uint32_t random_seed() {
  constexpr std::uint32_t kSeedOnCi = 1;
  std::uint32_t seed = kSeedOnCi;
  if (const char* given = std::getenv("TRAYGAUGE_SEED")) {
    seed = static_cast<std::uint32_t>(std::strtoul(given, nullptr, 10));
  } else if (std::getenv("CI") == nullptr) {
    seed = std::random_device{}();
  }
  std::cout << "TRAYGAUGE_SEED=" << seed << std::endl;
  return seed;
}

}  // namespace traygauge::test
