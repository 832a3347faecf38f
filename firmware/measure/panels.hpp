// The panels of the picture of a measurement.
#pragma once

#include <opencv2/core/mat.hpp>

#include "firmware/measure/measure_report.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

// Of a picture's proportions, unless these are so odd that nothing could be seen in it.
cv::Size panel_size(const PictureSize& picture, int width_px);

// The part of a view that has labels, with a margin, in the proportions of the picture; all of it where none
// has.
cv::Rect labelled_part(const LoadedView& view);

// The labelled part as stored, tinted and outlined, every item with its number and volume.
cv::Mat draw_view(const LoadedView& view, const Measurement& measurement, cv::Size size);

// Disparity of the rectified pair.
cv::Mat draw_disparity(const MeasureReport& report, cv::Size size);

// Height over the bottom of the dish, in the reference view.
cv::Mat draw_heights(const MeasureReport& report, cv::Size size);

// Profile best: height of the food over the dish's inner surface, seen from above; and what was seen of it,
// coloured by item, dark where no view sees it.
cv::Mat draw_food_heights(const MeasureReport& report, cv::Size size);
cv::Mat draw_evidence(const MeasureReport& report, cv::Size size);

}  // namespace traygauge
