#include "firmware/base/wall_clock.hpp"

#include <sys/timex.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>

namespace traygauge {
namespace {

constexpr std::int64_t kMsPerSecond = 1000;
constexpr std::int64_t kMsPerDay = kMsPerSecond * 3600 * 24;

// `count` digits at `at`; none where something else stands there.
std::optional<int> digits_at(std::string_view text, std::size_t at, std::size_t count) {
  if (text.size() < at + count) return std::nullopt;
  int number = 0;
  for (const char character : text.substr(at, count)) {
    if (character < '0' || character > '9') return std::nullopt;
    number = 10 * number + (character - '0');
  }
  return number;
}

// ".5" is 500; empty is 0.
std::optional<std::int64_t> fraction_ms(std::string_view text) {
  if (text.empty()) return 0;
  constexpr std::size_t kMaxDigits = 9;
  if (text.front() != '.' || text.size() < 2 || text.size() > 1 + kMaxDigits) return std::nullopt;
  std::array<char, 3> thousandths{'0', '0', '0'};
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] < '0' || text[i] > '9') return std::nullopt;
    if (i <= thousandths.size()) thousandths[i - 1] = text[i];
  }
  return digits_at({thousandths.data(), thousandths.size()}, 0, thousandths.size());
}

}  // namespace

WallTime read_wall_clock() {
  timex kernel{};
  const int state = ::adjtimex(&kernel);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return {std::chrono::duration_cast<std::chrono::milliseconds>(now).count(),
          state >= 0 && state != TIME_ERROR && (kernel.status & STA_UNSYNC) == 0};
}

std::string utc_text(std::int64_t unix_ms) {
  unix_ms = std::clamp(unix_ms, std::int64_t{0}, kEndOf9999Ms);
  const std::chrono::sys_days day{std::chrono::days(unix_ms / kMsPerDay)};
  const std::chrono::year_month_day date(day);
  const std::int64_t ms = unix_ms % kMsPerDay;
  const auto of_day = [&](std::int64_t unit_ms, std::int64_t units) {
    return static_cast<int>(ms / unit_ms % units);
  };
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02uT%02d:%02d:%02d.%03dZ",
                static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()), of_day(3600 * kMsPerSecond, 24),
                of_day(60 * kMsPerSecond, 60), of_day(kMsPerSecond, 60), of_day(1, kMsPerSecond));
  return text.data();
}

std::optional<std::int64_t> parse_utc(std::string_view text) {
  constexpr std::string_view kForm = "dddd-dd-ddTdd:dd:dd";
  if (text.size() <= kForm.size() || text.back() != 'Z') return std::nullopt;
  for (std::size_t i = 0; i < kForm.size(); ++i) {
    if (kForm[i] != 'd' && text[i] != kForm[i]) return std::nullopt;
  }
  const auto year = digits_at(text, 0, 4);
  const auto month = digits_at(text, 5, 2);
  const auto day = digits_at(text, 8, 2);
  const auto hour = digits_at(text, 11, 2);
  const auto minute = digits_at(text, 14, 2);
  const auto second = digits_at(text, 17, 2);
  const auto ms = fraction_ms(text.substr(kForm.size(), text.size() - kForm.size() - 1));
  if (!year || !month || !day || !hour || !minute || !second || !ms) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok() || *year < 1970 || *hour > 23 || *minute > 59 || *second > 59) return std::nullopt;
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  return days * kMsPerDay + ((*hour * 60 + *minute) * 60 + *second) * kMsPerSecond + *ms;
}

}  // namespace traygauge
