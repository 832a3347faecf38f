// A lens with what it is worth: how far volumes may be off because of it.
#pragma once

#include <string>
#include <vector>

#include "firmware/calibrate/lens_fit.hpp"
#include "firmware/calibrate/standard_meal.hpp"

namespace traygauge {

struct LensCalibrationParams {
  int min_pictures = 10;  // that show the board; 15 to 20 are better
  // Between the directions that two of the boards face. Boards that all face one way leave the focal length
  // open (Zhang 2000, section 3.2); a hand that tilts the board on purpose reaches 40.
  double min_facing_spread_deg = 25.0;
  // Of 8 × 6 fields of the picture, those with a corner in them: beyond, the distortion is a guess.
  double min_covered_fraction = 0.6;
  // A picture whose corners are so many times as far off as the median picture's was blurred or misread.
  double max_picture_rms_ratio = 3.0;
  double min_outlier_px = 0.3;  // no picture is left out for less
  int groups = 10;              // of pictures, each left out once
  // A simpler model is kept until another predicts the pictures left out by so much better: what fits only
  // the pictures it was fitted to costs accuracy elsewhere.
  double min_improvement = 0.02;
  // Of the volume, two standard deviations. A lens worse than this is a quarter of all error that is allowed.
  double max_volume_percent = 0.5;
  StandardMealParams meal;
};

struct LensCalibration {
  CameraDescription camera;
  int pictures = 0;  // that count
  std::vector<std::string> left_out;
  double rms_px = 0.0;           // of the corners
  double held_out_rms_px = 0.0;  // of pictures that the lens was not fitted to
  double covered_fraction = 0.0;
  double facing_spread_deg = 0.0;
  double volume_percent = 0.0;  // two standard deviations
};

// Why the pictures do not make a lens, and what to do.
struct CalibrationProblem {
  std::string expected;
  std::string found;
  std::string hint;
};

// Pictures of one camera, all of `size`. False and `problem` when they are too few or too much alike.
bool calibrate_lens(const std::vector<BoardSighting>& sightings, const Chessboard& board, PictureSize size,
                    const LensCalibrationParams& params, LensCalibration& calibration,
                    CalibrationProblem& problem);

}  // namespace traygauge
