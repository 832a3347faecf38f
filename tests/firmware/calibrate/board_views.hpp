// A chessboard in front of a camera whose lens is known: exact corners, and pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "firmware/calibrate/chessboard.hpp"
#include "simulator/capture/picture.hpp"
#include "tests/support/cameras.hpp"

namespace traygauge::test {

inline const Chessboard kBoard{9, 6};

// How a hand shows the board: spread over the picture, tilted by up to so much towards every side.
struct BoardHandling {
  int pictures = 16;
  double tilt_deg = 35.0;
  bool all_over = true;  // else near the middle
};

// board to camera; the unit is the board's field.
std::vector<Pose> hold_board(const Chessboard& board, const LensModel& lens, const BoardHandling& handling,
                             std::uint64_t seed);

// Its corners with normal noise.
BoardSighting project_board(const Chessboard& board, const LensModel& lens, const Pose& camera_from_board,
                            double noise_px, std::uint64_t seed);

// Grey paper with a white margin of a field around the board; edges as soft as a lens makes them, and noise.
Picture draw_board(const Chessboard& board, const LensModel& lens, const Pose& camera_from_board,
                   std::uint64_t seed);

}  // namespace traygauge::test
