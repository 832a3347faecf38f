#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/labels/label_regions.hpp"
#include "firmware/measure/drawing.hpp"
#include "firmware/measure/panels.hpp"

namespace traygauge {
namespace {

constexpr double kOutlierShare = 0.005;  // at each end of the colour scale
constexpr int kPanelMarginPx = 8;
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
cv::Mat heights_mm(const paper::WorkingPictures& pictures, const MeasurementViews& views) {
  const ImageView<const float>& depth = pictures.depth_mm;
  const PinholeCamera& camera = pictures.cameras[static_cast<std::size_t>(views.reference_view)];
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
  box -= cv::Point(kPanelMarginPx, kPanelMarginPx);
  box += cv::Size(2 * kPanelMarginPx, 2 * kPanelMarginPx);
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

namespace {

// What each cell of the dishes' height maps is, side by side on the table. `value` maps a cell to a number.
template <class Value>
cv::Mat lay_out_cells(std::span<const MeasuredSurface> surfaces, Value&& value) {
  const double cell_mm = surfaces.front().heights.cell_mm;
  Vec2 low = Vec2::Constant(1e9);
  Vec2 high = Vec2::Constant(-1e9);
  for (const MeasuredSurface& surface : surfaces) {
    const HeightMap& map = surface.heights;
    low = low.cwiseMin(map.origin_mm);
    high = high.cwiseMax(map.centre_mm(map.cells.width - 1, map.cells.height - 1));
  }
  const Vec2 size = (high - low) / cell_mm;
  cv::Mat values(static_cast<int>(std::lround(size.y())) + 1, static_cast<int>(std::lround(size.x())) + 1,
                 CV_32F, cv::Scalar(kUnknown));
  for (const MeasuredSurface& surface : surfaces) {
    const HeightMap& map = surface.heights;
    const Vec2 shift = (map.origin_mm - low) / cell_mm;
    for (int y = 0; y < map.cells.height; ++y) {
      for (int x = 0; x < map.cells.width; ++x) {
        const int column = static_cast<int>(std::lround(shift.x())) + x;
        const int row = values.rows - 1 - static_cast<int>(std::lround(shift.y())) - y;  // y points up
        const HeightCell& cell = map.cells.at(x, y);
        if (cell.label == kBackgroundLabel || row < 0 || column < 0 || column >= values.cols) continue;
        values.at<float>(row, column) = value(surface, map.centre_mm(x, y), cell);
      }
    }
  }
  return values;
}

}  // namespace

cv::Mat draw_food_heights(const MeasureReport& report, cv::Size size) {
  const auto surfaces = report.measurement->views.surfaces;
  if (surfaces.empty()) return draw_unreached("Heights", report, size);
  const cv::Mat heights =
      lay_out_cells(surfaces, [](const MeasuredSurface& surface, const Vec2& place, const HeightCell& cell) {
        return is_item(cell.label) ? static_cast<float>(cell.z_mm - surface.inner.height_mm(place)) : 0.0F;
      });
  ColourScale scale{0.0, 1.0, "mm"};
  if (!spanned_range(heights, kOutlierShare, scale.low, scale.high)) {
    return draw_missing(size, "No cell has a height.");
  }
  scale.low = std::min(scale.low, 0.0);
  return draw_map(colour_values(heights, scale), scale, size);
}

cv::Mat draw_evidence(const MeasureReport& report, cv::Size size) {
  const auto surfaces = report.measurement->views.surfaces;
  if (surfaces.empty()) return draw_unreached("Surface", report, size);
  const cv::Mat labels =
      lay_out_cells(surfaces, [](const MeasuredSurface&, const Vec2&, const HeightCell& cell) {
        return static_cast<float>(cell.label + (cell.kind == CellKind::surface ? 0 : 256));
      });
  cv::Mat picture(labels.size(), CV_8UC3, kUnknownColour);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const float value = labels.at<float>(y, x);
      if (!std::isfinite(value)) continue;
      const int label = static_cast<int>(value);
      const cv::Scalar colour =
          label_colour(static_cast<std::uint8_t>(label % 256)) * (label < 256 ? 0.85 : 0.35);
      picture.at<cv::Vec3b>(y, x) = {cv::saturate_cast<std::uint8_t>(colour[0]),
                                     cv::saturate_cast<std::uint8_t>(colour[1]),
                                     cv::saturate_cast<std::uint8_t>(colour[2])};
    }
  }
  return fit(picture, size, cv::INTER_NEAREST, kUnknownColour);
}

cv::Mat draw_disparity(const MeasureReport& report, cv::Size size) {
  if (report.pictures == nullptr || report.pictures->disparity.empty())
    return draw_unreached("Disparity", report, size);
  const ImageView<const Disparity>& disparity = report.pictures->disparity;
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
  if (report.pictures == nullptr || report.pictures->depth_mm.empty() || views.dish_bottom.offset == 0.0)
    return draw_unreached("Heights", report, size);
  const cv::Mat heights = heights_mm(*report.pictures, views);
  ColourScale scale{0.0, 1.0, "mm"};
  if (!spanned_range(heights, kOutlierShare, scale.low, scale.high)) {
    return draw_missing(size, "No pixel has a height.");
  }
  scale.low = std::min(scale.low, 0.0);
  cv::Mat map = colour_values(heights, scale);
  outline_labels(map, report.pictures->labels[static_cast<std::size_t>(views.reference_view)]);
  return draw_map(map(known_part(heights)), scale, size);
}

}  // namespace traygauge
