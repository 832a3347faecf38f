// The second camera's pose, corrected from a few points found in both views, so that the others need only be
// looked for nearby.
#pragma once

#include <span>

#include "core/geometry/geometry.hpp"
#include "core/geometry/levenberg_marquardt.hpp"
#include "core/geometry/table_frame.hpp"

namespace traygauge {

struct SeenPoint {
  Vec3 table_mm = Vec3::Zero();  // where its ray in the first view meets the height it is taken for
  Vec2 first = Vec2::Zero();     // rays (z = 1), undistorted
  Vec2 second = Vec2::Zero();
  bool height_known = false;  // on table or card; else only the epipolar line counts
};

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.01 points at most
// (tests/evaluation/numbers.tsv).
struct PoseCorrectionParams {
  // Of the given relative pose, per axis: what a card of 86 mm leaves open.
  double turn_sigma_deg = 0.5;
  double shift_sigma_mm = 3.0;
  // A residual of this size counts a quarter: first so much, at last so little, since the coarse search is
  // good to half a pixel.
  double coarsest_scale_px = 20.0;
  double finest_scale_px = 2.0;
  int max_iterations = 5;  // for each scale
};

// Least squares over the six parameters of `second_from_table`, as in moved(), from Geman and McClure's
// robust cost with a scale that falls by thirds.
void correct_second_pose(std::span<const SeenPoint> points, double focal_px,
                         const PoseCorrectionParams& params, TableCameras& camera_from_table);

// Signed distance of second from the epipolar line of first, in the second view.
class EpipolarDistance {
 public:
  EpipolarDistance(const Pose& second_from_first, double focal_px)
      : essential_(essential_matrix(second_from_first)), focal_px_(focal_px) {}
  double operator()(const Vec2& first, const Vec2& second) const {
    const Vec3 line = essential_ * Vec3(first.x(), first.y(), 1.0);
    const double length = line.head<2>().norm();
    return length > 0.0 ? focal_px_ * (line.x() * second.x() + line.y() * second.y() + line.z()) / length
                        : 0.0;
  }

 private:
  Mat3 essential_;
  double focal_px_;
};

}  // namespace traygauge
