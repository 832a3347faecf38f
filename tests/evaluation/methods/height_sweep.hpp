// Dense matching of two views by sweeping planes parallel to the dish (R. Collins 1996): every pixel takes
// the height whose window correlates best.
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge::tables {

struct SweepView {
  PinholeCamera camera;
  Pose camera_from_dish;  // z up, 0 on the dish's bottom
  cv::Mat gray;           // 8-bit, undistorted
};

struct SweepParams {
  double low_mm = -4.0;
  double high_mm = 90.0;
  double step_mm = 0.5;  // about a quarter of a pixel between views 20 degrees apart
  int window_px = 9;     // NCC
  double min_correlation = 0.6;
  double max_disagreement_mm = 1.5;  // between the heights that both views find for a point
  int median_px = 5;
  double max_deviation_mm = 4.0;  // from the median around; beyond: an outlier
};

// Heights over the dish (mm) of the pixels of `reference`, 32-bit; NaN where the correlation is too low.
cv::Mat sweep_heights(const SweepView& reference, const SweepView& other, const SweepParams& params);

// The same, kept where the other view agrees and the surroundings do.
cv::Mat filter_heights(const cv::Mat& heights, const SweepView& reference, const cv::Mat& other_heights,
                       const SweepView& other, const SweepParams& params);

// The volume over the dish's bottom under the surface through the pixels of `mask`: two triangles for each
// four neighbours, folded ones subtracted. A pixel without a height takes the mean of the nearest known ones.
// NaN when less than half of the mask has heights.
double volume_under_ml(const cv::Mat& heights, const cv::Mat& mask, const SweepView& view);

}  // namespace traygauge::tables
