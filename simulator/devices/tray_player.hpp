// The place under the camera: which recorded tray lies there, and what is seen from where.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "simulator/devices/capture_source.hpp"

namespace traygauge {

enum class CameraMover : std::uint8_t {
  arm,
  hand,  // every other press comes from a person who has moved the camera to the second view
};

// `captures` outlives the player.
class TrayPlayer {
 public:
  explicit TrayPlayer(CaptureSource& captures, CameraMover mover = CameraMover::arm)
      : captures_(captures), mover_(mover) {}

  // A person presses the button, having put the next tray there (after the last, the first again), or having
  // moved the camera.
  void handle_press();

  // Whether a tray lies there and its pictures could be read; problem() says why not.
  bool has_tray() const { return has_tray_; }
  std::string_view problem() const { return captures_.problem(); }
  const CaptureSource& captures() const { return captures_; }
  // Position in the captures' order of the tray that lies there; after the first press.
  std::size_t capture_index() const { return capture_index_; }

  // The angle from the first to the second view as recorded; none without angles, or when both are the same.
  std::optional<double> second_view_angle_deg() const;
  // The view of the active pair, 0 or 1, that a camera at this angle from the first one sees: the nearer one;
  // without recorded angles the second as soon as the arm has left home.
  int view_seen_at(double arm_angle_deg) const;
  // The same where a hand holds the camera.
  int view_seen_by_hand() const { return at_second_view_ ? 1 : 0; }

  // The camera reports what it has played, so that the frame's number finds it again.
  void note_played(std::uint64_t sequence, int view);
  // Which view, 0 or 1, a frame of this tray showed; nothing when it is not among the last two.
  std::optional<int> view_played_as(std::uint64_t sequence) const;

 private:
  struct PlayedFrame {
    std::uint64_t sequence = 0;
    int view = -1;
  };

  CaptureSource& captures_;
  CameraMover mover_;
  std::size_t next_capture_ = 0;
  std::size_t capture_index_ = 0;
  bool has_tray_ = false;
  bool at_second_view_ = false;
  std::array<PlayedFrame, 2> last_played_;  // newest first
};

}  // namespace traygauge
