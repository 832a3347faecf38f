#include "firmware/network/network_sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace traygauge {
namespace {

// Classes differ in hue; the golden angle keeps neighbours in the list apart.
constexpr double kGoldenAngleDeg = 137.508;

cv::Mat3b paint_classes(const cv::Mat1b& classes) {
  cv::Mat3b painted(classes.size());
  for (int y = 0; y < classes.rows; ++y) {
    for (int x = 0; x < classes.cols; ++x) painted(y, x) = class_colour(classes(y, x));
  }
  return painted;
}

// The probability of a border, by the logistic function of the real value.
cv::Mat3b paint_border(const TensorView& border, float step) {
  cv::Mat3b painted(border.shape.height, border.shape.width);
  for (int y = 0; y < painted.rows; ++y) {
    for (int x = 0; x < painted.cols; ++x) {
      const double value = static_cast<double>(step) * border.at(x, y, 0);
      const double probability = 1.0 / (1.0 + std::exp(-value));
      painted(y, x) = cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(255.0 * probability));
    }
  }
  return painted;
}

cv::Mat3b paint_embedding(const TensorView& embedding) {
  cv::Mat3b painted(embedding.shape.height, embedding.shape.width);
  const int channels = std::min(3, embedding.shape.channels);
  for (int y = 0; y < painted.rows; ++y) {
    for (int x = 0; x < painted.cols; ++x) {
      painted(y, x) = cv::Vec3b::all(128);
      for (int c = 0; c < channels; ++c) {
        painted(y, x)[c] = static_cast<std::uint8_t>(128 + embedding.at(x, y, c));
      }
    }
  }
  return painted;
}

}  // namespace

cv::Mat1b classes_of(const TensorView& classes) {
  cv::Mat1b largest(classes.shape.height, classes.shape.width);
  for (int y = 0; y < largest.rows; ++y) {
    for (int x = 0; x < largest.cols; ++x) {
      int best = 0;
      for (int c = 1; c < classes.shape.channels; ++c) {
        if (classes.at(x, y, c) > classes.at(x, y, best)) best = c;
      }
      largest(y, x) = static_cast<std::uint8_t>(best);
    }
  }
  return largest;
}

cv::Vec3b class_colour(std::size_t class_index) {
  if (class_index == 0) return {160, 160, 160};
  const double hue = std::fmod(kGoldenAngleDeg * static_cast<double>(class_index), 360.0);
  const cv::Mat3f hsv(1, 1, cv::Vec3f(static_cast<float>(hue), 0.75F, 0.95F));
  cv::Mat3f bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  const cv::Vec3f colour = 255.0F * bgr(0, 0);
  return {cv::saturate_cast<std::uint8_t>(colour[0]), cv::saturate_cast<std::uint8_t>(colour[1]),
          cv::saturate_cast<std::uint8_t>(colour[2])};
}

std::vector<std::size_t> count_classes(const cv::Mat1b& classes, std::size_t class_count,
                                       const InputPlacement& place, int input_width) {
  std::vector<std::size_t> counts(class_count, 0);
  const auto cell = [&](int pixel) { return pixel * classes.cols / input_width; };
  const cv::Rect shown(cell(place.left), cell(place.top), std::max(1, cell(place.width)),
                       std::max(1, cell(place.height)));
  const cv::Mat1b seen = classes(shown & cv::Rect({0, 0}, classes.size()));
  for (int y = 0; y < seen.rows; ++y) {
    for (int x = 0; x < seen.cols; ++x) ++counts[seen(y, x)];
  }
  return counts;
}

cv::Mat3b draw_network_sheet(const cv::Mat3b& picture, const NetworkRunner& runner) {
  std::vector<cv::Mat3b> panels{picture, paint_classes(classes_of(runner.output(NetworkRole::classes)))};
  const TensorView border = runner.output(NetworkRole::border);
  if (border.data != nullptr) panels.push_back(paint_border(border, runner.step(NetworkRole::border)));
  const TensorView embedding = runner.output(NetworkRole::embedding);
  if (embedding.data != nullptr) panels.push_back(paint_embedding(embedding));
  cv::Mat3b sheet(picture.rows, picture.cols * static_cast<int>(panels.size()));
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const cv::Rect place(static_cast<int>(i) * picture.cols, 0, picture.cols, picture.rows);
    cv::resize(panels[i], sheet(place), picture.size(), 0, 0, cv::INTER_NEAREST);
  }
  return sheet;
}

}  // namespace traygauge
