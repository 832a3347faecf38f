// A lens from sightings of a chessboard (Zhang 2000), by OpenCV's calibrateCamera.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "firmware/calibrate/chessboard.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

// How much of OpenCV's model is fitted; the rest is zero.
enum class LensTerms : std::uint8_t {
  radial,      // k1, k2
  tangential,  // p1, p2 as well: the sensor is tilted
  all,         // k3 as well: wide angles
};

struct LensFit {
  CameraDescription camera;
  std::vector<double> picture_rms_px;  // of each sighting's corners
  std::vector<Vec3> board_normals;     // of each board, in the camera's axes

  double rms_px() const;
};

// Nothing when the sightings do not fix a lens.
std::optional<LensFit> fit_lens(std::span<const BoardSighting* const> sightings, const Chessboard& board,
                                PictureSize size, LensTerms terms);

// Root mean square of the corners' distances from where this lens puts them, the board placed where it fits
// best.
double reprojection_rms_px(const BoardSighting& sighting, const Chessboard& board,
                           const CameraDescription& camera);

}  // namespace traygauge
