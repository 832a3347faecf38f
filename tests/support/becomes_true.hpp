// Waiting for what another thread or program does.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace traygauge::test {

// Asks every 10 ms, for ten seconds: a busy machine gets there late.
inline bool becomes_true(const std::function<bool()>& condition) {
  for (int i = 0; i < 1000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return condition();
}

}  // namespace traygauge::test
