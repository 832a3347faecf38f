// Time per stage, on the steady clock.
#pragma once

#include <array>
#include <chrono>

#include "core/pipeline/measurement.hpp"

namespace traygauge {

// Each lap goes to the stage named last; stop() ends the current lap.
class StageClock {
 public:
  void enter(Stage stage) {
    stop();
    current_ = static_cast<std::size_t>(stage);
    running_ = true;
    start_ = std::chrono::steady_clock::now();
  }
  void stop() {
    if (!running_) return;
    const std::chrono::duration<double, std::milli> lap = std::chrono::steady_clock::now() - start_;
    stage_ms_[current_] += lap.count();
    running_ = false;
  }
  const std::array<double, kStageCount>& stage_ms() const { return stage_ms_; }
  double total_ms() const {
    double total = 0.0;
    for (const double ms : stage_ms_) total += ms;
    return total;
  }

 private:
  std::array<double, kStageCount> stage_ms_{};
  std::size_t current_ = 0;
  bool running_ = false;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace traygauge
