// Pictures for tests, and views of OpenCV's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>

#include "core/image_view/image_view.hpp"

namespace traygauge::test {

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

// Band-limited noise with blobs of many sizes.
inline cv::Mat textured_picture(int width, int height, std::uint64_t seed) {
  cv::RNG rng(seed);
  cv::Mat sum = cv::Mat::zeros(height, width, CV_32F);
  for (const double sigma : {1.5, 3.0, 6.0, 12.0}) {
    cv::Mat noise(height, width, CV_32F);
    rng.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
    cv::GaussianBlur(noise, noise, cv::Size(), sigma);
    sum += noise * sigma;
  }
  cv::Mat gray;
  cv::normalize(sum, gray, 10, 245, cv::NORM_MINMAX, CV_8U);
  return gray;
}

}  // namespace traygauge::test
