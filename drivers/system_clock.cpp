#include <cerrno>
#include <ctime>

#include "drivers/clock.hpp"

namespace traygauge {

Instant SystemClock::do_now() const {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);  // cannot fail for this clock
  return Instant(std::chrono::seconds(time.tv_sec) + Nanoseconds(time.tv_nsec));
}

void SystemClock::do_sleep_until(Instant instant) {
  const auto since_start = instant.time_since_epoch();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(since_start);
  timespec time{};
  time.tv_sec = static_cast<time_t>(seconds.count());
  time.tv_nsec = static_cast<decltype(time.tv_nsec)>((since_start - seconds).count());
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
  }
}

}  // namespace traygauge
