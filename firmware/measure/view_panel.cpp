#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/labels/label_regions.hpp"
#include "firmware/base/text.hpp"
#include "firmware/measure/drawing.hpp"
#include "firmware/measure/panels.hpp"

namespace traygauge {
namespace {

constexpr double kTint = 0.25;       // share of the label's colour inside its outline
constexpr double kMargin = 1.08;     // around what is labelled
constexpr double kFlattest = 0.375;  // height over width
constexpr double kTallest = 1.375;
constexpr double kLabelScale = 0.6;
constexpr int kLineHeightPx = 22;

cv::Mat to_bgr(const Picture& picture) {
  // OpenCV has no view of constant pixels; they are only read.
  auto* pixels = const_cast<std::uint8_t*>(picture.pixels.data());
  const bool gray = picture.format == PixelFormat::gray8;
  const cv::Mat view(picture.size.height, picture.size.width, gray ? CV_8UC1 : CV_8UC3, pixels);
  cv::Mat bgr;
  if (picture.format == PixelFormat::bgr8) return view.clone();
  cv::cvtColor(view, bgr, gray ? cv::COLOR_GRAY2BGR : cv::COLOR_RGB2BGR);
  return bgr;
}

// OpenCV has no view of constant pixels; they are only read.
cv::Mat stored_labels(const LoadedView& view) {
  auto* pixels = const_cast<std::uint8_t*>(view.labels.pixels.data());
  return {view.labels.size.height, view.labels.size.width, CV_8UC1, pixels};
}

void tint_labels(cv::Mat& panel, const cv::Mat& labels) {
  cv::Mat lookup(1, 256, CV_8UC3);
  for (int label = 0; label < 256; ++label) {
    const cv::Scalar colour = label_colour(static_cast<std::uint8_t>(label));
    lookup.at<cv::Vec3b>(0, label) = {cv::saturate_cast<std::uint8_t>(colour[0]),
                                      cv::saturate_cast<std::uint8_t>(colour[1]),
                                      cv::saturate_cast<std::uint8_t>(colour[2])};
  }
  cv::Mat triple;
  cv::Mat colours;
  cv::cvtColor(labels, triple, cv::COLOR_GRAY2BGR);
  cv::LUT(triple, lookup, colours);
  cv::Mat tinted;
  cv::addWeighted(panel, 1.0 - kTint, colours, kTint, 0.0, tinted);
  tinted.copyTo(panel, (labels >= kFirstItemLabel) & (labels <= kLastItemLabel));
  // A pixel is on an outline when its neighbourhood holds more than one label; the higher one colours it.
  cv::Mat lowest;
  cv::Mat highest;
  cv::erode(labels, lowest, {});
  cv::dilate(labels, highest, {});
  cv::cvtColor(highest, triple, cv::COLOR_GRAY2BGR);
  cv::LUT(triple, lookup, colours);
  colours.copyTo(panel, lowest != highest);
}

// The lines stand around the point that lies deepest inside the item.
void draw_item(cv::Mat& panel, const cv::Mat& labels, const ItemResult& item) {
  const cv::Mat mask = labels == item.label;
  if (cv::countNonZero(mask) == 0) return;
  cv::Mat depth;
  cv::distanceTransform(mask, depth, cv::DIST_L2, 3);
  cv::Point deepest;
  cv::minMaxLoc(depth, nullptr, nullptr, nullptr, &deepest);
  const std::string lines[] = {std::to_string(item.label), item.status == StatusCode::ok
                                                               ? fixed(item.volume_ml, 1) + " ml"
                                                               : std::string(name(item.status))};
  int y = std::clamp(deepest.y, kLineHeightPx, std::max(kLineHeightPx, panel.rows - kLineHeightPx));
  for (const std::string& text : lines) {
    const int width = measure_text(text, kLabelScale).width;
    const int x = std::clamp(deepest.x - width / 2, 2, std::max(2, panel.cols - width - 2));
    draw_text(panel, text, {x, y}, kLabelScale, kInk);
    y += kLineHeightPx;
  }
}

}  // namespace

cv::Size panel_size(const PictureSize& picture, int width_px) {
  const double height_px = static_cast<double>(width_px) * picture.height / picture.width;
  return {width_px,
          static_cast<int>(std::lround(std::clamp(height_px, kFlattest * width_px, kTallest * width_px)))};
}

cv::Rect labelled_part(const LoadedView& view) {
  const PictureSize whole = view.picture.size;
  const cv::Rect box = view.labels.pixels.empty() ? cv::Rect() : cv::boundingRect(stored_labels(view));
  if (box.empty()) return {0, 0, whole.width, whole.height};
  const double share =
      std::max(static_cast<double>(box.width) / whole.width, static_cast<double>(box.height) / whole.height);
  const double scale = std::min(1.0, share * kMargin);
  const cv::Size size(static_cast<int>(scale * whole.width), static_cast<int>(scale * whole.height));
  const cv::Point middle = (box.tl() + box.br()) / 2;
  return {std::clamp(middle.x - size.width / 2, 0, whole.width - size.width),
          std::clamp(middle.y - size.height / 2, 0, whole.height - size.height), size.width, size.height};
}

cv::Mat draw_view(const LoadedView& view, const Measurement& measurement, cv::Size size) {
  const cv::Mat picture = to_bgr(view.picture);
  if (view.labels.pixels.empty()) return fit(picture, size, cv::INTER_AREA, kUnknownColour);
  const cv::Mat stored = stored_labels(view);
  const cv::Rect part = labelled_part(view);
  cv::Mat panel = fit(picture(part), size, cv::INTER_AREA, kUnknownColour);
  const cv::Mat labels = fit(stored(part), size, cv::INTER_NEAREST, kBackgroundLabel);
  tint_labels(panel, labels);
  for (const ItemResult& item : measurement.items) draw_item(panel, labels, item);
  return panel;
}

}  // namespace traygauge
