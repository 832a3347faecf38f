#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/segmentation/label_regions.hpp"
#include "firmware/measure/drawing.hpp"
#include "firmware/measure/panels.hpp"

namespace traygauge {
namespace {

constexpr double kOutlierShare = 0.005;  // at each end of the colour scale
constexpr int kMarginPx = 8;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

cv::Mat draw_unreached(const char* what, const MeasureReport& report, cv::Size size) {
  return draw_missing(size, std::string(what) + " not reached: " + report.message);
}

cv::Mat disparities_px(const ImageView<const Disparity>& disparity) {
  cv::Mat values(disparity.height, disparity.width, CV_32F);
  for (int y = 0; y < disparity.height; ++y) {
    auto* row = values.ptr<float>(y);
    for (int x = 0; x < disparity.width; ++x) {
      const Disparity d = disparity.at(x, y);
      row[x] = d == kNoDisparity ? kUnknown : static_cast<float>(d) / kDisparityScale;
    }
  }
  return values;
}

// Of every pixel of the reference view whose depth is known.
cv::Mat heights_mm(const MeasurementViews& views) {
  const ImageView<const float>& depth = views.depth_mm;
  const PinholeCamera& camera = views.cameras[static_cast<std::size_t>(views.reference_view)];
  cv::Mat heights(depth.height, depth.width, CV_32F);
  for (int y = 0; y < depth.height; ++y) {
    auto* row = heights.ptr<float>(y);
    for (int x = 0; x < depth.width; ++x) {
      const Vec2 ray = camera.ray({static_cast<double>(x), static_cast<double>(y)});
      const double z = depth.at(x, y);  // NaN stays NaN
      row[x] = static_cast<float>(views.dish_bottom.height({ray.x() * z, ray.y() * z, z}));
    }
  }
  return heights;
}

// The known part, with a margin.
cv::Rect known_part(const cv::Mat& values) {
  cv::Rect box = cv::boundingRect(known_pixels(values));
  box -= cv::Point(kMarginPx, kMarginPx);
  box += cv::Size(2 * kMarginPx, 2 * kMarginPx);
  return box & cv::Rect({0, 0}, values.size());
}

// Where the labels on the dish change, drawn into the map of the same picture.
void outline_labels(cv::Mat& map, const ImageView<const std::uint8_t>& labels) {
  if (labels.empty() || labels.width != map.cols || labels.height != map.rows) return;
  const auto label_on_dish = [&](int x, int y) {
    return is_on_dish(labels.at(x, y)) ? labels.at(x, y) : kBackgroundLabel;
  };
  for (int y = 0; y + 1 < labels.height; ++y) {
    for (int x = 0; x + 1 < labels.width; ++x) {
      const std::uint8_t label = label_on_dish(x, y);
      if (label != label_on_dish(x + 1, y) || label != label_on_dish(x, y + 1)) {
        map.at<cv::Vec3b>(y, x) = {235, 235, 235};
      }
    }
  }
}

}  // namespace

cv::Mat draw_disparity(const MeasureReport& report, cv::Size size) {
  const ImageView<const Disparity>& disparity = report.measurement->views.disparity;
  if (disparity.empty()) return draw_unreached("Disparity", report, size);
  const cv::Mat values = disparities_px(disparity);
  ColourScale scale{0.0, 1.0, "px"};
  if (!spanned_range(values, kOutlierShare, scale.low, scale.high)) {
    return draw_missing(size, "No pixel was matched densely.");
  }
  return draw_map(colour_values(values, scale)(known_part(values)), scale, size);
}

cv::Mat draw_heights(const MeasureReport& report, cv::Size size) {
  const MeasurementViews& views = report.measurement->views;
  // A plane through the camera itself is the one that was never set.
  if (views.depth_mm.empty() || views.dish_bottom.offset == 0.0)
    return draw_unreached("Heights", report, size);
  const cv::Mat heights = heights_mm(views);
  ColourScale scale{0.0, 1.0, "mm"};
  if (!spanned_range(heights, kOutlierShare, scale.low, scale.high)) {
    return draw_missing(size, "No pixel has a height.");
  }
  scale.low = std::min(scale.low, 0.0);
  cv::Mat map = colour_values(heights, scale);
  outline_labels(map, views.labels[static_cast<std::size_t>(views.reference_view)]);
  return draw_map(map(known_part(heights)), scale, size);
}

}  // namespace traygauge
