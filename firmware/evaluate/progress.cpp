#include "firmware/evaluate/progress.hpp"

#include <cmath>
#include <cstdint>
#include <ostream>

#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kBarWidth = 30;
constexpr std::size_t kLineWidth = 79;  // of the narrowest usual terminal, less one
constexpr std::chrono::milliseconds kRedraw{200};
constexpr std::chrono::seconds kLineEvery{30};

std::string two_digits(std::int64_t number) {
  std::string text = number < 10 ? "0" : "";
  text += std::to_string(number);
  return text;
}

}  // namespace

std::string compose_duration(double seconds) {
  const std::int64_t whole = std::lround(std::fmax(seconds, 0.0));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + two_digits(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + two_digits(whole % 3600 / 60) + " min";
}

std::string compose_progress(std::size_t done, std::size_t all, double elapsed_s, const std::string& what) {
  const std::size_t filled = kBarWidth * done / all;
  const double left_s = elapsed_s / static_cast<double>(done) * static_cast<double>(all - done);
  const std::string bar = pad_right(std::string(filled, '#'), kBarWidth);
  const std::string percent = pad_left(std::to_string(100 * done / all), 3);
  std::string text = "[";
  text += bar + "] " + percent + " %, " + std::to_string(done) + " of " + std::to_string(all) + " " + what +
          ", " + compose_duration(left_s) + " left";
  return text;
}

Progress::~Progress() {
  erase();
}

void Progress::erase() {
  if (is_shown_) stream_ << "\r" << std::string(kLineWidth, ' ') << "\r" << std::flush;
  is_shown_ = false;
}

void Progress::show(std::size_t done, std::size_t all) {
  const Clock::time_point now = Clock::now();
  if (done == 0 || now - last_ < (is_terminal_ ? Clock::duration(kRedraw) : Clock::duration(kLineEvery)))
    return;
  last_ = now;
  const std::string text =
      compose_progress(done, all, std::chrono::duration<double>(now - start_).count(), what_);
  if (is_terminal_) {
    stream_ << "\r" << pad_right(text, kLineWidth) << std::flush;
    is_shown_ = true;
  } else {
    stream_ << text << std::endl;
  }
}

}  // namespace traygauge
