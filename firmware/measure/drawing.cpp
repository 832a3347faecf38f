#include "firmware/measure/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr int kMarginPx = 12;
constexpr int kBarWidthPx = 18;
constexpr int kBarColumnPx = 100;  // bar, ticks and margins
constexpr int kTicks = 5;
constexpr double kTextScale = 0.55;

cv::Mat apply_scale(const cv::Mat& values, const ColourScale& scale) {
  cv::Mat bytes;
  const double span = std::max(scale.high - scale.low, 1e-9);
  values.convertTo(bytes, CV_8U, 255.0 / span, -255.0 * scale.low / span);
  cv::Mat colours;
  cv::applyColorMap(bytes, colours, cv::COLORMAP_TURBO);
  return colours;
}

void draw_bar(cv::Mat& panel, const ColourScale& scale) {
  const cv::Rect bar(panel.cols - kBarColumnPx + kMarginPx, kMarginPx + 20, kBarWidthPx,
                     panel.rows - 2 * kMarginPx - 20);
  cv::Mat values(bar.height, bar.width, CV_32F);
  for (int y = 0; y < bar.height; ++y) {
    values.row(y).setTo(scale.high - (scale.high - scale.low) * y / std::max(bar.height - 1, 1));
  }
  apply_scale(values, scale).copyTo(panel(bar));
  draw_text(panel, scale.unit, {bar.x, bar.y - 8}, kTextScale, kInk);
  const int decimals = scale.high - scale.low < 10.0 ? 1 : 0;
  for (int i = 0; i < kTicks; ++i) {
    const double share = static_cast<double>(i) / (kTicks - 1);
    const int y = bar.y + static_cast<int>(std::lround((1.0 - share) * (bar.height - 1)));
    const std::string text = fixed(scale.low + share * (scale.high - scale.low), decimals);
    draw_text(panel, text, {bar.x + kBarWidthPx + 6, std::clamp(y + 6, bar.y + 12, bar.y + bar.height)},
              kTextScale, kInk);
  }
}

std::vector<std::string> wrap(const std::string& text, int width_px) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (!lines.back().empty() && measure_text(longer, kTextScale).width > width_px) {
      lines.push_back(word);
    } else {
      lines.back() = longer;
    }
  }
  return lines;
}

}  // namespace

void draw_text(cv::Mat& image, const std::string& text, cv::Point origin, double scale,
               const cv::Scalar& colour) {
  cv::putText(image, text, origin, kFont, scale, cv::Scalar(0, 0, 0), 3, cv::LINE_AA);
  cv::putText(image, text, origin, kFont, scale, colour, 1, cv::LINE_AA);
}

cv::Size measure_text(const std::string& text, double scale) {
  int base_line = 0;
  return cv::getTextSize(text, kFont, scale, 1, &base_line);
}

cv::Mat add_title(const cv::Mat& panel, const std::string& title) {
  cv::Mat titled(panel.rows + kTitleHeightPx, panel.cols, CV_8UC3, kPaper);
  panel.copyTo(titled.rowRange(kTitleHeightPx, titled.rows));
  draw_text(titled, title, {4, kTitleHeightPx - 11}, 0.6, kInk);
  return titled;
}

cv::Mat draw_missing(cv::Size size, const std::string& reason) {
  cv::Mat panel(size, CV_8UC3, kUnknownColour);
  const std::vector<std::string> lines = wrap(reason, size.width - 4 * kMarginPx);
  constexpr int line_height = 26;
  int y = size.height / 2 - static_cast<int>(lines.size()) * line_height / 2 + line_height;
  for (const std::string& text : lines) {
    draw_text(panel, text, {(size.width - measure_text(text, kTextScale).width) / 2, y}, kTextScale, kInk);
    y += line_height;
  }
  return panel;
}

cv::Mat fit(const cv::Mat& picture, cv::Size size, int interpolation, const cv::Scalar& background) {
  const double scale = std::min(static_cast<double>(size.width) / picture.cols,
                                static_cast<double>(size.height) / picture.rows);
  const cv::Size scaled(std::clamp(static_cast<int>(std::lround(scale * picture.cols)), 1, size.width),
                        std::clamp(static_cast<int>(std::lround(scale * picture.rows)), 1, size.height));
  cv::Mat panel(size, picture.type(), background);
  const cv::Rect place((size.width - scaled.width) / 2, (size.height - scaled.height) / 2, scaled.width,
                       scaled.height);
  cv::Mat target = panel(place);
  cv::resize(picture, target, scaled, 0.0, 0.0, interpolation);
  return panel;
}

cv::Mat known_pixels(const cv::Mat& values) {
  return values == values;  // NOLINT(misc-redundant-expression): false for NaN
}

cv::Mat colour_values(const cv::Mat& values, const ColourScale& scale) {
  const cv::Mat known = known_pixels(values);
  cv::Mat filled = values.clone();
  filled.setTo(scale.low, ~known);
  cv::Mat colours = apply_scale(filled, scale);
  colours.setTo(kUnknownColour, ~known);
  return colours;
}

cv::Mat draw_map(const cv::Mat& map, const ColourScale& scale, cv::Size size) {
  cv::Mat panel(size, CV_8UC3, kPaper);
  const cv::Size room(size.width - kBarColumnPx, size.height);
  const bool shrinks = map.cols > room.width || map.rows > room.height;
  fit(map, room, shrinks ? cv::INTER_AREA : cv::INTER_NEAREST, kUnknownColour)
      .copyTo(panel.colRange(0, room.width));
  draw_bar(panel, scale);
  return panel;
}

bool spanned_range(const cv::Mat& values, double share, double& low, double& high) {
  std::vector<float> known;
  for (int y = 0; y < values.rows; ++y) {
    const auto* row = values.ptr<float>(y);
    std::copy_if(row, row + values.cols, std::back_inserter(known), [](float v) { return std::isfinite(v); });
  }
  if (known.empty()) return false;
  const auto at = [&](double position) {
    const auto rank = static_cast<std::ptrdiff_t>(position * static_cast<double>(known.size() - 1));
    std::nth_element(known.begin(), known.begin() + rank, known.end());
    return static_cast<double>(known[static_cast<std::size_t>(rank)]);
  };
  low = at(share);
  high = at(1.0 - share);
  return true;
}

cv::Scalar label_colour(std::uint8_t label) {
  if (label == kDishLabel) return {255, 255, 255};
  if (label == kCardLabel) return {0, 215, 255};
  constexpr double golden_angle_deg = 137.508;  // neighbours on the circle of hues lie far apart
  const double hue = std::fmod(golden_angle_deg * label, 360.0);
  const cv::Mat hsv(1, 1, CV_8UC3, cv::Scalar(hue / 2.0, 220, 255));
  cv::Mat bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  const auto& colour = bgr.at<cv::Vec3b>(0, 0);
  return {static_cast<double>(colour[0]), static_cast<double>(colour[1]), static_cast<double>(colour[2])};
}

}  // namespace traygauge
