// The place under the camera: which recorded tray lies there, and what is seen from where.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "drivers/indicator.hpp"
#include "simulator/devices/capture_source.hpp"

namespace traygauge {

enum class CameraMover : std::uint8_t {
  arm,
  hand,  // every other press comes from a person who has moved the camera to the second view
};

// A frame that the camera has delivered.
struct PlayedFrame {
  std::uint64_t sequence = 0;
  int view = -1;         // 0 or 1
  double off_deg = 0.0;  // from where the arm stood to where the view was recorded
};

// `captures` outlives the player.
class TrayPlayer {
 public:
  explicit TrayPlayer(CaptureSource& captures, CameraMover mover = CameraMover::arm)
      : captures_(captures), mover_(mover) {}

  // A person presses the button, having put the next tray there (after the last, the first again), or having
  // moved the camera.
  void handle_press();
  // The person sees the lamp: done, try_again and fault end the scan, so that the next press comes with the
  // next tray although the second view was not taken. At move_on the hand moves the camera there.
  void handle_signal(Signal signal);

  // Whether a tray lies there and its pictures could be read; problem() says why not.
  bool has_tray() const { return has_tray_; }
  std::string_view problem() const { return captures_.problem(); }
  const CaptureSource& captures() const { return captures_; }
  // Position in the captures' order of the tray that lies there; after the first press.
  std::size_t capture_index() const { return capture_index_; }

  // The angle from the first to the second view as recorded; none without angles, or when both are the same.
  std::optional<double> second_view_angle_deg() const;
  // The view of the active pair, 0 or 1, that a camera at this angle from the first one sees: the nearer one.
  // Without recorded angles the second counts as recorded where the arm was last sent, at `aimed_deg`.
  int view_seen_at(double arm_angle_deg, double aimed_deg) const;
  // The same where a hand holds the camera.
  int view_seen_by_hand() const { return at_second_view_ ? 1 : 0; }

  // The camera reports what it has played, so that the frame's number finds it again.
  void note_played(const PlayedFrame& frame);
  // The same for a frame that showed once more what the last one showed. When that was another tray, `frame`
  // says what should have been seen.
  void note_repeated(PlayedFrame frame);
  // What a frame of this tray showed; nothing when it is not among the last two.
  std::optional<PlayedFrame> find_played(std::uint64_t sequence) const;

 private:
  CaptureSource& captures_;
  CameraMover mover_;
  std::size_t next_capture_ = 0;
  std::size_t capture_index_ = 0;
  bool has_tray_ = false;
  bool second_press_is_due_ = false;
  bool at_second_view_ = false;
  bool scan_has_ended_ = false;
  std::array<PlayedFrame, 2> last_played_;  // newest first
};

}  // namespace traygauge
