// Polar rectification for any motion: Pollefeys, Koch, Van Gool 1999 (paper III-B-1, reference [31]).
// A rectified row is a pair of corresponding epipolar half-lines; a rectified column is the distance along
// the line. Columns count from the dish pixel nearest to the epipole, so the epipole may lie anywhere, at
// infinity too.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/geometry.hpp"
#include "core/base/status.hpp"
#include "core/image/camera.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

struct RectificationParams {
  int max_rows = 1024;     // rows of the rectified pictures that memory is kept for
  int max_columns = 1024;  // columns likewise
  double min_epipole_distance_px =
      40.0;  // pixels nearer to an epipole are masked: rows there fan out of few pixels
};

}  // namespace traygauge
