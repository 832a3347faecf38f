#include "simulator/devices/tray_player.hpp"

#include <cmath>

namespace traygauge {
namespace {

// An arm nearer to home than this has not left it: below what the arm's drive resolves.
constexpr double kHomeTolerance_deg = 0.05;

}  // namespace

void TrayPlayer::handle_press() {
  if (second_press_is_due_ && has_tray_ && !scan_has_ended_) {
    second_press_is_due_ = false;
    at_second_view_ = true;
    return;
  }
  second_press_is_due_ = mover_ == CameraMover::hand;
  scan_has_ended_ = false;
  at_second_view_ = false;
  last_played_ = {};
  capture_index_ = next_capture_;
  has_tray_ = captures_.open(capture_index_);
  next_capture_ = (capture_index_ + 1) % captures_.capture_count();
}

void TrayPlayer::handle_signal(Signal signal) {
  if (signal == Signal::done || signal == Signal::try_again || signal == Signal::fault)
    scan_has_ended_ = true;
  if (signal == Signal::hold_still) scan_has_ended_ = false;  // the next one may have begun before
  if (signal == Signal::move_on && second_press_is_due_) at_second_view_ = true;
}

std::optional<double> TrayPlayer::second_view_angle_deg() const {
  if (!has_tray_) return std::nullopt;
  const auto& [first, second] = captures_.pair();
  if (!first.arm_angle_deg || !second.arm_angle_deg) return std::nullopt;
  const double angle_deg = *second.arm_angle_deg - *first.arm_angle_deg;
  if (std::abs(angle_deg) < kHomeTolerance_deg) return std::nullopt;
  return angle_deg;
}

int TrayPlayer::view_seen_at(double arm_angle_deg, double aimed_deg) const {
  const double second_deg = second_view_angle_deg().value_or(aimed_deg);
  return std::abs(arm_angle_deg) <= std::abs(arm_angle_deg - second_deg) ? 0 : 1;
}

void TrayPlayer::note_played(const PlayedFrame& frame) {
  last_played_[1] = last_played_[0];
  last_played_[0] = frame;
}

void TrayPlayer::note_repeated(PlayedFrame frame) {
  if (last_played_[0].view >= 0) frame.view = last_played_[0].view;
  note_played(frame);
}

std::optional<PlayedFrame> TrayPlayer::find_played(std::uint64_t sequence) const {
  for (const PlayedFrame& played : last_played_) {
    if (played.view >= 0 && played.sequence == sequence) return played;
  }
  return std::nullopt;
}

}  // namespace traygauge
