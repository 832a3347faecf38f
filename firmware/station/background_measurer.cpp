#include "firmware/station/background_measurer.hpp"

namespace traygauge {

BackgroundMeasurer::BackgroundMeasurer(Measurer& measurer)
    : measurer_(measurer), thread_([this] { work(); }) {}

BackgroundMeasurer::~BackgroundMeasurer() {
  ends_ = true;
  wanted_.release();
  thread_.join();
}

void BackgroundMeasurer::begin_measuring() {
  wanted_.release();
}

const Measurement* BackgroundMeasurer::await_measurement(Nanoseconds timeout) {
  return done_.try_acquire_for(timeout) ? result_ : nullptr;
}

void BackgroundMeasurer::work() {
  while (true) {
    wanted_.acquire();
    if (ends_) return;
    result_ = &measurer_.measure();
    done_.release();
  }
}

}  // namespace traygauge
