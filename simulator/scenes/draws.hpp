// Random draws of a scene: the same seed gives the same scene on every machine.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string_view>

#include "core/base/random.hpp"

namespace traygauge {

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed) {}
  // Independent of the draws of every other `name`, and of their count.
  Draws(std::uint64_t seed, std::string_view name) : random_(mixed(seed, name)) {}

  double between(double low, double high) { return low + (high - low) * random_.uniform(); }
  int whole(int low, int high) {  // both included
    return low + static_cast<int>(random_.below(static_cast<std::uint32_t>(high - low + 1)));
  }
  bool chance(double share) { return random_.uniform() < share; }
  double angle_rad() { return between(0.0, 2.0 * std::numbers::pi); }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random_.uniform()));
    return radius * std::cos(angle_rad());
  }
  std::uint32_t seed() { return random_.next(); }

  template <class T>
  const T& pick(std::span<const T> choices) {
    return choices[random_.below(static_cast<std::uint32_t>(choices.size()))];
  }
  template <class T>
  void shuffle(std::span<T> items) {
    for (std::size_t i = items.size(); i > 1; --i)
      std::swap(items[i - 1], items[random_.below(static_cast<std::uint32_t>(i))]);
  }

 private:
  // FNV-1a over the name.
  static std::uint64_t mixed(std::uint64_t seed, std::string_view name) {
    std::uint64_t hash = 14695981039346656037ULL ^ (seed * 0x9E3779B97F4A7C15ULL);
    for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
    return hash;
  }

  Random random_;
};

}  // namespace traygauge
