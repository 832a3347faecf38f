#include "firmware/base/back_off.hpp"

#include <algorithm>

namespace traygauge {

BackOff::Milliseconds BackOff::after_failure() {
  const Milliseconds wait = next_;
  next_ = std::min(2 * next_, longest_);
  return shortened(wait);
}

BackOff::Milliseconds BackOff::after_refusal() {
  next_ = longest_;
  return shortened(longest_);
}

BackOff::Milliseconds BackOff::shortened(Milliseconds wait) {
  std::uniform_int_distribution<std::int64_t> share(0, wait.count() / 4);
  return wait - Milliseconds(share(random_));
}

}  // namespace traygauge
