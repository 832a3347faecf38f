// Speeded-up robust features: Bay, Ess, Tuytelaars, Van Gool 2008 (paper reference [14]; the paper ran
// OpenSURF [37]). Detection: determinant of box-filter Hessians over an integral image, 3 × 3 × 3 maxima,
// interpolated. Description: 4 × 4 subregions of Haar sums (dx, |dx|, dy, |dy|), 64-d, unit length.
#pragma once

#include <cstdint>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/status.hpp"
#include "core/features/keypoint.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

struct SurfParams {
  int octaves = 4;        // [14] section 3.3; filter sizes 9…27, 15…51, 27…99, 51…195
  int first_step_px = 2;  // sampling step of the first octave: 2 as in OpenSURF, 1 finds more, slower
  float min_response =
      1e-4F;             // determinant on a grey range of 0…1; OpenSURF's default 4e-4 starves smooth food
  bool upright = false;  // skip the orientation; valid while the views roll less than about 15 degrees
};

// Scratch for pictures of up to `max_pixels` pixels (width × height) with sides up to `max_side_px`.
struct SurfWorkspace;

}  // namespace traygauge
