#include "tests/evaluation/methods/height_sweep.hpp"

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace traygauge::tables {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kMinVariance = 4.0F;  // grey levels squared: below, a window is noise

Mat3 matrix_of(const PinholeCamera& camera) {
  Mat3 k = Mat3::Identity();
  k(0, 0) = camera.fx_px;
  k(1, 1) = camera.fy_px;
  k(0, 2) = camera.cx_px;
  k(1, 2) = camera.cy_px;
  return k;
}

// From points (x, y, 1) of the plane at this height to pixels.
Mat3 pixel_from_plane(const SweepView& view, double height_mm) {
  Mat3 plane;
  plane.col(0) = view.camera_from_dish.rotation.col(0);
  plane.col(1) = view.camera_from_dish.rotation.col(1);
  plane.col(2) = view.camera_from_dish * Vec3(0.0, 0.0, height_mm);
  return matrix_of(view.camera) * plane;
}

cv::Mat as_cv(const Mat3& m) {
  cv::Mat result(3, 3, CV_64F);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) result.at<double>(row, column) = m(row, column);
  }
  return result;
}

struct WindowMoments {
  cv::Mat mean;
  cv::Mat variance;
};

cv::Mat window_mean(const cv::Mat& picture, int window_px) {
  cv::Mat mean;
  cv::boxFilter(picture, mean, CV_32F, {window_px, window_px});
  return mean;
}

WindowMoments moments_of(const cv::Mat& picture, int window_px) {
  WindowMoments moments{window_mean(picture, window_px), {}};
  moments.variance = window_mean(picture.mul(picture), window_px) - moments.mean.mul(moments.mean);
  return moments;
}

// Best correlation so far, its height, and the correlations one step beside it.
class BestHeights {
 public:
  explicit BestHeights(cv::Size size)
      : best_(size, CV_32F, cv::Scalar(-2.0)),
        before_(size, CV_32F, cv::Scalar(-2.0)),
        after_(size, CV_32F, cv::Scalar(-2.0)),
        previous_(size, CV_32F, cv::Scalar(-2.0)),
        step_(size, CV_32S, cv::Scalar(-1)) {}

  void take(const cv::Mat& correlation, int step) {
    for (int y = 0; y < best_.rows; ++y) {
      const float* now = correlation.ptr<float>(y);
      float* best = best_.ptr<float>(y);
      float* before = before_.ptr<float>(y);
      float* after = after_.ptr<float>(y);
      float* previous = previous_.ptr<float>(y);
      int* at = step_.ptr<int>(y);
      for (int x = 0; x < best_.cols; ++x) {
        if (at[x] == step - 1) after[x] = now[x];
        if (now[x] > best[x]) {
          best[x] = now[x];
          before[x] = previous[x];
          after[x] = -2.0F;
          at[x] = step;
        }
        previous[x] = now[x];
      }
    }
  }

  cv::Mat heights(const SweepParams& params) const {
    cv::Mat result(best_.size(), CV_32F, cv::Scalar(static_cast<double>(kUnknown)));
    for (int y = 0; y < best_.rows; ++y) {
      for (int x = 0; x < best_.cols; ++x) {
        const float best = best_.at<float>(y, x);
        const float before = before_.at<float>(y, x);
        const float after = after_.at<float>(y, x);
        // A maximum at either end of the sweep is none.
        if (static_cast<double>(best) < params.min_correlation || before < -1.5F || after < -1.5F) continue;
        const float bend = before - 2.0F * best + after;
        const float offset = bend < 0.0F ? 0.5F * (before - after) / bend : 0.0F;
        result.at<float>(y, x) = static_cast<float>(
            params.low_mm + params.step_mm * (step_.at<int>(y, x) + static_cast<double>(offset)));
      }
    }
    return result;
  }

 private:
  cv::Mat best_;
  cv::Mat before_;
  cv::Mat after_;
  cv::Mat previous_;
  cv::Mat step_;
};

Vec3 point_at(const SweepView& view, const Pose& dish_from_camera, int x, int y, double height_mm) {
  const Vec3 sight = dish_from_camera.rotation * view.camera.ray(Vec2(x, y)).homogeneous();
  const Vec3& eye = dish_from_camera.translation;
  return eye + sight * ((height_mm - eye.z()) / sight.z());
}

// OpenCV 4.6 does not find NaN different from itself, only not equal.
cv::Mat known_in(const cv::Mat& heights) {
  return heights == heights;
}

// The mean of the known heights in the smallest window that holds enough of them.
cv::Mat fill_occlusions(const cv::Mat& heights, const cv::Mat& mask) {
  constexpr int kMaxWindow = 129;
  constexpr double kEnough = 0.2;  // of the window
  cv::Mat filled;
  heights.copyTo(filled);
  const cv::Mat known = known_in(heights) & mask;
  cv::Mat values = cv::Mat::zeros(heights.size(), CV_32F);
  heights.copyTo(values, known);
  cv::Mat weights;
  known.convertTo(weights, CV_32F, 1.0 / 255.0);
  for (int window = 5; window <= kMaxWindow; window = 2 * window - 1) {
    const cv::Mat share = window_mean(weights, window);
    const cv::Mat sum = window_mean(values, window);
    const cv::Mat fillable = ~known_in(filled) & mask & (share > (window < kMaxWindow / 2 ? kEnough : 1e-4));
    const cv::Mat mean = sum / cv::max(share, 1e-6);
    mean.copyTo(filled, fillable);
  }
  return filled;
}

double triangle_ml(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec2 ab = (b - a).head<2>();
  const Vec2 ac = (c - a).head<2>();
  return 1e-3 * 0.5 * (ab.x() * ac.y() - ab.y() * ac.x()) * (a.z() + b.z() + c.z()) / 3.0;
}

}  // namespace

cv::Mat sweep_heights(const SweepView& reference, const SweepView& other, const SweepParams& params) {
  cv::Mat first;
  cv::Mat second;
  reference.gray.convertTo(first, CV_32F);
  other.gray.convertTo(second, CV_32F);
  const WindowMoments own = moments_of(first, params.window_px);
  BestHeights best(first.size());
  const int steps = static_cast<int>(std::ceil((params.high_mm - params.low_mm) / params.step_mm));
  cv::Mat warped;
  for (int step = 0; step <= steps; ++step) {
    const double height_mm = params.low_mm + params.step_mm * step;
    const Mat3 other_from_reference =
        pixel_from_plane(other, height_mm) * pixel_from_plane(reference, height_mm).inverse();
    cv::warpPerspective(second, warped, as_cv(other_from_reference), first.size(),
                        cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT, 0.0);
    const WindowMoments there = moments_of(warped, params.window_px);
    const cv::Mat covariance = window_mean(first.mul(warped), params.window_px) - own.mean.mul(there.mean);
    cv::Mat deviations;
    cv::sqrt(cv::max(own.variance, kMinVariance).mul(cv::max(there.variance, kMinVariance)), deviations);
    best.take(covariance / deviations, step);
  }
  return best.heights(params);
}

cv::Mat filter_heights(const cv::Mat& heights, const SweepView& reference, const cv::Mat& other_heights,
                       const SweepView& other, const SweepParams& params) {
  const Pose dish_from_camera = reference.camera_from_dish.inverse();
  cv::Mat agreed(heights.size(), CV_32F, cv::Scalar(static_cast<double>(kUnknown)));
  for (int y = 0; y < heights.rows; ++y) {
    for (int x = 0; x < heights.cols; ++x) {
      const float height = heights.at<float>(y, x);
      if (std::isnan(height)) continue;
      const Vec3 point = point_at(reference, dish_from_camera, x, y, static_cast<double>(height));
      const Vec2 seen = other.camera.pixel((other.camera_from_dish * point).hnormalized());
      const int u = cvRound(seen.x());
      const int v = cvRound(seen.y());
      if (u < 0 || v < 0 || u >= other_heights.cols || v >= other_heights.rows) continue;
      const double difference = std::abs(static_cast<double>(other_heights.at<float>(v, u) - height));
      if (difference <= params.max_disagreement_mm) agreed.at<float>(y, x) = height;
    }
  }
  // The median wants numbers everywhere: gaps take the mean of what lies around them.
  cv::Mat smooth;
  const cv::Mat everywhere(heights.size(), CV_8UC1, cv::Scalar(255));
  cv::medianBlur(fill_occlusions(agreed, everywhere), smooth, params.median_px);
  const cv::Mat outliers = cv::abs(agreed - smooth) > params.max_deviation_mm;
  cv::Mat filtered = smooth.clone();
  filtered.setTo(kUnknown, outliers | ~known_in(agreed));
  return filtered;
}

double volume_under_ml(const cv::Mat& heights, const cv::Mat& mask, const SweepView& view) {
  const int known = cv::countNonZero(known_in(heights) & mask);
  if (2 * known < cv::countNonZero(mask) || known == 0) return std::numeric_limits<double>::quiet_NaN();
  const cv::Mat filled = fill_occlusions(heights, mask);
  const Pose dish_from_camera = view.camera_from_dish.inverse();
  double sum_ml = 0.0;
  for (int y = 0; y + 1 < mask.rows; ++y) {
    for (int x = 0; x + 1 < mask.cols; ++x) {
      Vec3 corners[2][2];
      bool is_inside = true;
      for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
          const float height = filled.at<float>(y + j, x + i);
          is_inside = is_inside && mask.at<std::uint8_t>(y + j, x + i) != 0 && !std::isnan(height);
          corners[j][i] = point_at(view, dish_from_camera, x + i, y + j, static_cast<double>(height));
        }
      }
      if (!is_inside) continue;
      sum_ml += triangle_ml(corners[0][0], corners[0][1], corners[1][0]) +
                triangle_ml(corners[1][1], corners[1][0], corners[0][1]);
    }
  }
  // A picture's y runs down: seen from above its triangles turn to the right.
  return -sum_ml;
}

}  // namespace traygauge::tables
