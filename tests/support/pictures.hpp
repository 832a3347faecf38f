// Pictures for tests, and views of OpenCV's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>

#include "core/image_view/image_view.hpp"

namespace traygauge::testing {

template <class T>
ImageView<T> view_of(cv::Mat_<T>& picture) {
  return {picture.template ptr<T>(), picture.cols, picture.rows,
          static_cast<std::ptrdiff_t>(picture.step1())};
}
template <class T>
ImageView<const T> view_of(const cv::Mat_<T>& picture) {
  return {picture.template ptr<T>(), picture.cols, picture.rows,
          static_cast<std::ptrdiff_t>(picture.step1())};
}
inline ImageView<std::uint8_t> view_of(cv::Mat& picture) {
  return {picture.data, picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step[0])};
}
inline ImageView<const std::uint8_t> view_of(const cv::Mat& picture) {
  return {picture.data, picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step[0])};
}

inline FrameView frame_of(const cv::Mat& picture) {
  return {picture.data, picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step[0]),
          picture.channels() == 1 ? PixelFormat::gray8 : PixelFormat::bgr8};
}

inline cv::Mat random_picture(int width, int height, int type, cv::RNG& rng) {
  cv::Mat picture(height, width, type);
  rng.fill(picture, cv::RNG::UNIFORM, 0, 256);
  return picture;
}

}  // namespace traygauge::testing
