#include "tests/bench/opencv_stereo.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace traygauge::bench {
namespace {

constexpr double kRectifiedPixels = 262144.0;  // 2^18, of the rectified dish
constexpr int kMarginPx = 8;
constexpr int kRangeMarginPx = 16;

// A rectified pair: x along the baseline, z towards the dish. In the sheared second picture the dish's bottom
// has disparity 0.
struct Rectified {
  cv::Matx33d rotation;  // rectified from reference
  cv::Matx33d first_camera;
  cv::Matx33d second_camera;        // before the shear
  cv::Matx33d second_from_sheared;  // pixels
  double baseline_mm = 0.0;
  cv::Size size;
  cv::Mat first;
  cv::Mat second;
  cv::Mat labels;
  int min_disparity = 0;
  int disparities = 0;
};

cv::Mat dish_mask(const cv::Mat& labels) {
  return (labels >= kDishLabel) & (labels <= kLastItemLabel);
}

cv::Matx33d rectifying_rotation(const OpenCvStereoInput& input, const cv::Vec3d& dish) {
  const cv::Vec3d x = cv::normalize(-(input.rotation.t() * input.translation));
  const cv::Vec3d z = cv::normalize(dish - x * dish.dot(x));
  const cv::Vec3d y = z.cross(x);
  return {x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]};
}

// Outline of the dish as rectified rays.
std::vector<cv::Point2d> outline(const cv::Mat& labels, const OpenCvLens& lens, const cv::Matx33d& rotation) {
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(dish_mask(labels), contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<cv::Point2d> pixels;
  for (const auto& contour : contours) pixels.insert(pixels.end(), contour.begin(), contour.end());
  std::vector<cv::Point2d> rays;
  cv::undistortPoints(pixels, rays, lens.camera, lens.distortion, rotation);
  return rays;
}

// Disparity of the dish's bottom is linear in the first picture's pixel: what it takes to undo it.
cv::Matx33d shear(const Rectified& pair, const OpenCvStereoInput& input) {
  const cv::Vec3d normal = pair.rotation * input.bottom_normal;
  const double f = pair.first_camera(0, 0);
  const double per_ray = f * pair.baseline_mm / input.bottom_offset;
  const cv::Vec3d disparity(per_ray * normal[0] / f, per_ray * normal[1] / f,
                            per_ray * (normal[2] - normal[0] * pair.first_camera(0, 2) / f -
                                       normal[1] * pair.first_camera(1, 2) / f));
  const double shift = pair.second_camera(0, 2) - pair.first_camera(0, 2);
  return {1.0 - disparity[0], -disparity[1], shift - disparity[2], 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
}

// Of a point in the reference camera.
double sheared_disparity(const Rectified& pair, const cv::Vec3d& point) {
  const cv::Vec3d p = pair.rotation * point;
  const double f = pair.first_camera(0, 0);
  const double u = f * p[0] / p[2] + pair.first_camera(0, 2);
  const double v = f * p[1] / p[2] + pair.first_camera(1, 2);
  const double second = f * (p[0] - pair.baseline_mm) / p[2] + pair.second_camera(0, 2);
  const cv::Matx33d& s = pair.second_from_sheared;
  return u - (second - s(0, 1) * v - s(0, 2)) / s(0, 0);
}

bool choose_range(const OpenCvStereoInput& input, Rectified& pair) {
  std::vector<double> disparities;
  for (const cv::Vec3d& point : input.dish_points) disparities.push_back(sheared_disparity(pair, point));
  if (disparities.size() < 8) return false;
  std::sort(disparities.begin(), disparities.end());
  const std::size_t tail = disparities.size() / 50;
  pair.min_disparity = static_cast<int>(std::floor(disparities[tail])) - kRangeMarginPx;
  const int most = static_cast<int>(std::ceil(disparities[disparities.size() - 1 - tail])) + kRangeMarginPx;
  pair.disparities = (most - pair.min_disparity + 15) / 16 * 16;
  return pair.disparities <= 512;
}

void warp(const cv::Mat& source, const OpenCvLens& lens, const cv::Matx33d& rotation,
          const cv::Matx33d& camera, cv::Size size, int interpolation, cv::Mat& target) {
  cv::Mat columns;
  cv::Mat rows;
  cv::initUndistortRectifyMap(lens.camera, lens.distortion, rotation, camera, size, CV_16SC2, columns, rows);
  cv::remap(source, target, columns, rows, interpolation);
}

bool rectify(const OpenCvStereoInput& input, const OpenCvLens& lens, Rectified& pair) {
  const int dish_px = cv::countNonZero(dish_mask(input.labels[0]));
  const double f = lens.camera(0, 0) * std::sqrt(kRectifiedPixels / dish_px);
  cv::Vec3d dish;
  for (const cv::Vec3d& point : input.dish_points) dish += point;
  pair.rotation = rectifying_rotation(input, dish);
  pair.baseline_mm = cv::norm(input.translation);
  const std::vector<cv::Point2d> rays = outline(input.labels[0], lens, pair.rotation);
  cv::Point2d low(1e9, 1e9);
  cv::Point2d high(-1e9, -1e9);
  for (const cv::Point2d& ray : rays) {
    low = {std::min(low.x, ray.x), std::min(low.y, ray.y)};
    high = {std::max(high.x, ray.x), std::max(high.y, ray.y)};
  }
  pair.first_camera = {f, 0.0, kMarginPx - f * low.x, 0.0, f, kMarginPx - f * low.y, 0.0, 0.0, 1.0};
  pair.second_camera = pair.first_camera;
  pair.second_from_sheared = shear(pair, input);
  if (!choose_range(input, pair)) return false;
  // SGBM leaves as many columns at the left as the largest disparity, and at the right as the smallest.
  const int left = std::max(0, pair.min_disparity + pair.disparities);
  const int right = std::max(0, -pair.min_disparity);
  pair.first_camera(0, 2) += left;
  pair.second_camera = pair.first_camera;
  pair.second_from_sheared = shear(pair, input);
  pair.size = {static_cast<int>(f * (high.x - low.x)) + left + right + 2 * kMarginPx,
               static_cast<int>(f * (high.y - low.y)) + 2 * kMarginPx};
  warp(input.gray[0], lens, pair.rotation, pair.first_camera, pair.size, cv::INTER_LINEAR, pair.first);
  warp(input.labels[0], lens, pair.rotation, pair.first_camera, pair.size, cv::INTER_NEAREST, pair.labels);
  warp(input.gray[1], lens, pair.rotation * input.rotation.t(),
       pair.second_from_sheared.inv() * pair.second_camera, pair.size, cv::INTER_LINEAR, pair.second);
  return true;
}

cv::Mat match(const Rectified& pair) {
  const cv::Ptr<cv::CLAHE> clahe = cv::createCLAHE(2.0);
  cv::Mat first;
  cv::Mat second;
  clahe->apply(pair.first, first);
  clahe->apply(pair.second, second);
  cv::Mat disparity;
  cv::StereoSGBM::create(pair.min_disparity, pair.disparities, 5, 8 * 25, 64 * 25, 1, 0, 5, 0, 0,
                         cv::StereoSGBM::MODE_SGBM_3WAY)
      ->compute(first, second, disparity);
  cv::medianBlur(disparity, disparity, 5);
  return disparity;
}

// Linear along the row between the nearest known pixels of the same label.
void fill_holes(const Rectified& pair, cv::Mat& disparity) {
  const int least = pair.min_disparity * cv::StereoMatcher::DISP_SCALE;
  for (int y = 0; y < disparity.rows; ++y) {
    auto* row = disparity.ptr<std::int16_t>(y);
    const auto* labels = pair.labels.ptr<std::uint8_t>(y);
    int known = -1;
    for (int x = 0; x <= disparity.cols; ++x) {
      const bool ends = x == disparity.cols || (x > 0 && labels[x] != labels[x - 1]);
      const bool is_known = x < disparity.cols && row[x] >= least;
      if (ends && known >= 0) std::fill(row + known + 1, row + x, row[known]);
      if (ends) known = -1;
      if (!is_known) continue;
      int start = x;
      while (start > 0 && labels[start - 1] == labels[x] && row[start - 1] < least) --start;
      for (int i = start; i < x; ++i) {
        const int from = known >= 0 ? row[known] : row[x];
        row[i] =
            static_cast<std::int16_t>(known >= 0 ? from + (row[x] - from) * (i - known) / (x - known) : from);
      }
      known = x;
    }
  }
}

cv::Mat unproject(const Rectified& pair, const cv::Mat& disparity) {
  cv::Mat points(disparity.size(), CV_64FC3);
  const cv::Matx33d& s = pair.second_from_sheared;
  const double f = pair.first_camera(0, 0);
  for (int y = 0; y < disparity.rows; ++y) {
    for (int x = 0; x < disparity.cols; ++x) {
      const double d = disparity.at<std::int16_t>(y, x) / static_cast<double>(cv::StereoMatcher::DISP_SCALE);
      const double second = s(0, 0) * (x - d) + s(0, 1) * y + s(0, 2) - pair.second_camera(0, 2);
      const double first = x - pair.first_camera(0, 2);
      const double z = f * pair.baseline_mm / (first - second);
      points.at<cv::Vec3d>(y, x) = {first / f * z, (y - pair.first_camera(1, 2)) / f * z, z};
    }
  }
  return points;
}

std::map<int, double> integrate(const Rectified& pair, const cv::Mat& points, const cv::Vec3d& normal,
                                double offset) {
  std::map<int, double> volumes_ml;
  std::array<double, 256> sums{};
  const auto prism = [&](const cv::Vec3d& a, const cv::Vec3d& b, const cv::Vec3d& c) {
    return normal.dot((c - a).cross(b - a)) * 0.5 * (normal.dot(a + b + c) / 3.0 - offset);
  };
  for (int y = 0; y + 1 < points.rows; ++y) {
    for (int x = 0; x + 1 < points.cols; ++x) {
      const std::uint8_t label = pair.labels.at<std::uint8_t>(y, x);
      if (!is_item(label) || pair.labels.at<std::uint8_t>(y, x + 1) != label ||
          pair.labels.at<std::uint8_t>(y + 1, x) != label ||
          pair.labels.at<std::uint8_t>(y + 1, x + 1) != label)
        continue;
      const auto* upper = points.ptr<cv::Vec3d>(y) + x;
      const auto* lower = points.ptr<cv::Vec3d>(y + 1) + x;
      sums[label] += prism(upper[0], upper[1], lower[0]) + prism(upper[1], lower[1], lower[0]);
    }
  }
  for (int label = kFirstItemLabel; label <= kLastItemLabel; ++label) {
    const double ml = sums[static_cast<std::size_t>(label)] / 1000.0;
    if (ml != 0.0) volumes_ml[label] = ml;
  }
  return volumes_ml;
}

}  // namespace

cv::Matx33d rotation_matrix(const Mat3& r) {
  return {r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)};
}

cv::Vec3d vector_of(const Vec3& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

cv::Rect as_rect(const PixelBox& box) {
  return {box.left, box.top, box.width(), box.height()};
}

OpenCvLens::OpenCvLens(const LensModel& lens)
    : camera(test::camera_matrix(lens.pinhole)), distortion(test::distortion_of(lens)) {}

OpenCvStereoInput OpenCvStereoInput::swapped() const {
  OpenCvStereoInput other{{gray[1], gray[0]},
                          {labels[1], labels[0]},
                          rotation.t(),
                          -(rotation.t() * translation),
                          rotation * bottom_normal,
                          0.0,
                          {}};
  other.bottom_offset = bottom_offset + other.bottom_normal.dot(translation);
  for (const cv::Vec3d& point : dish_points) other.dish_points.push_back(rotation * point + translation);
  return other;
}

std::map<int, double> volumes_by_sgbm(const OpenCvStereoInput& input, const OpenCvLens& lens) {
  Rectified pair;
  if (!rectify(input, lens, pair)) return {};
  cv::Mat disparity = match(pair);
  fill_holes(pair, disparity);
  return integrate(pair, unproject(pair, disparity), pair.rotation * input.bottom_normal,
                   input.bottom_offset);
}

}  // namespace traygauge::bench
