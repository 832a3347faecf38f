#include "tests/core/paper/rectified_capture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "tests/support/capture_truth.hpp"

namespace traygauge::test {
namespace {

constexpr int kOversampling = 3;
constexpr int kMargin = 2;

struct View {
  cv::Mat_<std::uint8_t> gray, labels;
  cv::Matx33d camera;
  std::vector<double> distortion;
  cv::Matx33d camera_from_world;
  cv::Vec3d centre_mm;
};

View read_view(const TrueView& stored) {
  View view;
  view.gray = stored.read_gray();
  view.labels = stored.read_labels();
  view.camera = camera_matrix(stored.lens.pinhole);
  view.distortion = distortion_of(stored.lens);
  const Pose& pose = stored.camera_from_world;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) view.camera_from_world(r, c) = pose.rotation(r, c);
  }
  const Vec3 centre_mm = pose.inverse().translation;
  view.centre_mm = {centre_mm.x(), centre_mm.y(), centre_mm.z()};
  return view;
}

cv::Vec3d row_of(const cv::Matx33d& matrix, int row) {
  return {matrix(row, 0), matrix(row, 1), matrix(row, 2)};
}

// x along the baseline, z between the two optical axes.
cv::Matx33d rectifying_rotation(const View& first, const View& second) {
  cv::Vec3d x = cv::normalize(second.centre_mm - first.centre_mm);
  const cv::Vec3d first_x = row_of(first.camera_from_world, 0);
  const cv::Vec3d first_y = row_of(first.camera_from_world, 1);
  if (x.dot(std::abs(x.dot(first_x)) > std::abs(x.dot(first_y)) ? first_x : first_y) < 0.0) x = -x;
  cv::Vec3d z = row_of(first.camera_from_world, 2) + row_of(second.camera_from_world, 2);
  z = cv::normalize(z - x * z.dot(x));
  const cv::Vec3d y = z.cross(x);
  return {x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]};
}

bool is_dish(std::uint8_t label) {
  return label >= 1 && label <= 199;
}

cv::Matx33d rectified_camera(double focal_px, cv::Point origin, double scale = 1.0) {
  // Pixel centres at integers: x' = s (x + 0.5) − 0.5.
  const auto shifted = [&](int o) { return scale * (0.5 - o) - 0.5; };
  return {scale * focal_px, 0.0, shifted(origin.x), 0.0, scale * focal_px, shifted(origin.y), 0.0, 0.0, 1.0};
}

// Where the dish lies, in rectified pixels at focal length 1, and its area there.
struct Extent {
  cv::Point2d low{1e9, 1e9}, high{-1e9, -1e9};
};

Extent dish_extent(const View& view, const cv::Matx33d& rotation) {
  std::vector<cv::Point2d> pixels;
  for (int y = 0; y < view.labels.rows; y += 2) {
    for (int x = 0; x < view.labels.cols; x += 2) {
      if (is_dish(view.labels(y, x))) pixels.emplace_back(x, y);
    }
  }
  std::vector<cv::Point2d> rectified;
  cv::undistortPoints(pixels, rectified, view.camera, view.distortion, rotation * view.camera_from_world.t());
  Extent extent;
  for (const cv::Point2d& p : rectified) {
    extent.low = {std::min(extent.low.x, p.x), std::min(extent.low.y, p.y)};
    extent.high = {std::max(extent.high.x, p.x), std::max(extent.high.y, p.y)};
  }
  return extent;
}

struct Frame {
  double focal_px;
  cv::Point origin;
  cv::Size size;
};

Frame frame_around(const Extent& columns, const Extent& rows, double focal_px) {
  const auto low = [&](double v) { return static_cast<int>(std::floor(v * focal_px)) - kMargin; };
  const auto high = [&](double v) { return static_cast<int>(std::ceil(v * focal_px)) + kMargin; };
  const cv::Point origin(low(columns.low.x), low(rows.low.y));
  return {focal_px, origin, {high(columns.high.x) - origin.x + 1, high(rows.high.y) - origin.y + 1}};
}

void warp(const View& view, const cv::Matx33d& rotation, const Frame& frame, int scale, const cv::Mat& source,
          int interpolation, cv::Mat& target) {
  cv::Mat columns, rows;
  cv::initUndistortRectifyMap(view.camera, view.distortion, rotation * view.camera_from_world.t(),
                              rectified_camera(frame.focal_px, frame.origin, scale), frame.size * scale,
                              CV_32FC1, columns, rows);
  cv::remap(source, target, columns, rows, interpolation);
}

void warp_view(const View& view, const cv::Matx33d& rotation, const Frame& frame,
               cv::Mat_<std::uint8_t>& gray, cv::Mat_<std::uint8_t>& mask, cv::Mat_<std::uint8_t>& labels) {
  cv::Mat oversampled;
  warp(view, rotation, frame, kOversampling, view.gray, cv::INTER_LINEAR, oversampled);
  cv::resize(oversampled, gray, frame.size, 0.0, 0.0, cv::INTER_AREA);
  cv::Mat warped;
  warp(view, rotation, frame, 1, view.labels, cv::INTER_NEAREST, warped);
  labels = warped;
  mask = dish_mask(labels);
}

// The focal length at which the first view's dish measures kWorkingDishPixels.
double choose_focal(const View& view, const cv::Matx33d& rotation, const Extent& extent) {
  double focal_px = 1000.0;
  cv::Mat warped;
  warp(view, rotation, frame_around(extent, extent, focal_px), 1, view.labels, cv::INTER_NEAREST, warped);
  const int pixels = cv::countNonZero(dish_mask(warped));
  return focal_px * std::sqrt(kWorkingDishPixels / pixels);
}

void take_truth(const cv::Mat& depth, const View& first, const View& second, const Frame& frame,
                RectifiedCapture& capture) {
  cv::Mat warped;
  const cv::Matx33d& rotation = capture.rectified_from_world;
  warp(first, rotation, frame, 1, depth, cv::INTER_NEAREST, warped);
  const cv::Matx33d first_from_rectified = first.camera_from_world * rotation.t();
  const cv::Vec3d baseline = rotation * (second.centre_mm - first.centre_mm);
  capture.baseline_mm = baseline[0];
  capture.truth.create(frame.size);
  for (int y = 0; y < frame.size.height; ++y) {
    for (int x = 0; x < frame.size.width; ++x) {
      const double z = warped.at<float>(y, x);
      cv::Vec3d ray((x + capture.first_origin.x) / frame.focal_px,
                    (y + capture.first_origin.y) / frame.focal_px, 1.0);
      const double depth_along_axis = (first_from_rectified * ray)[2];
      const double rectified_z = z / depth_along_axis;
      const double partner =
          frame.focal_px * (ray[0] - capture.baseline_mm / rectified_z) - capture.second_origin.x;
      capture.truth(y, x) = z > 0.0 ? static_cast<float>(partner - x) : std::nanf("");
    }
  }
}

DisparityRange central_range(const RectifiedCapture& capture) {
  constexpr int kEnlargement = 16;
  std::vector<float> disparities;
  for (int i = 0; i < static_cast<int>(capture.truth.total()); ++i) {
    if (capture.pair.first_mask(i) != 0 && std::isfinite(capture.truth(i)))
      disparities.push_back(capture.truth(i));
  }
  std::sort(disparities.begin(), disparities.end());
  const std::size_t tail = disparities.size() / 20;
  return {static_cast<int>(std::floor(disparities[tail])) - kEnlargement,
          static_cast<int>(std::ceil(disparities[disparities.size() - 1 - tail])) + kEnlargement};
}

}  // namespace

cv::Vec3d RectifiedCapture::point(int x, int y, double disparity_px) const {
  const double column = x + first_origin.x;
  const double partner = x + disparity_px + second_origin.x;
  const double z = focal_px * baseline_mm / (column - partner);
  const cv::Vec3d rectified(column / focal_px * z, (y + first_origin.y) / focal_px * z, z);
  return rectified_from_world.t() * rectified + first_centre_mm;
}

RectifiedCapture rectify_capture(const std::filesystem::path& folder, int second_index) {
  const CaptureTruth stored = read_capture_truth(folder);
  const View first = read_view(stored.views.at(0));
  const View second = read_view(stored.views.at(static_cast<std::size_t>(second_index)));
  RectifiedCapture capture;
  capture.rectified_from_world = rectifying_rotation(first, second);
  const Extent first_extent = dish_extent(first, capture.rectified_from_world);
  const Extent second_extent = dish_extent(second, capture.rectified_from_world);
  capture.focal_px = choose_focal(first, capture.rectified_from_world, first_extent);
  const Frame first_frame = frame_around(first_extent, first_extent, capture.focal_px);
  const Frame second_frame = frame_around(second_extent, first_extent, capture.focal_px);
  capture.first_origin = first_frame.origin;
  capture.second_origin = second_frame.origin;
  TestPair& pair = capture.pair;
  cv::Mat_<std::uint8_t> second_labels;
  warp_view(first, capture.rectified_from_world, first_frame, pair.first, pair.first_mask, capture.labels);
  warp_view(second, capture.rectified_from_world, second_frame, pair.second, pair.second_mask, second_labels);
  take_truth(stored.read_depth_mm(), first, second, first_frame, capture);
  const double bottom_mm = stored.description.at("dish").at("bottom_height_mm").get<double>();
  capture.first_centre_mm = first.centre_mm - cv::Vec3d(0.0, 0.0, bottom_mm);
  for (const auto& item : stored.truth.at("items")) {
    if (item.at("kind") == "heightfield") capture.names[item.at("label")] = item.at("name");
  }
  capture.range = central_range(capture);
  return capture;
}

double volume_ml(const RectifiedCapture& capture, int label, const cv::Mat_<float>& disparity_px) {
  const auto corner = [&](int x, int y) { return capture.point(x, y, disparity_px(y, x)); };
  const auto prism = [](const cv::Vec3d& a, const cv::Vec3d& b, const cv::Vec3d& c) {
    const double area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0;
    return area * (a[2] + b[2] + c[2]) / 3.0;
  };
  double volume_mm3 = 0.0;
  for (int y = 0; y + 1 < capture.labels.rows; ++y) {
    for (int x = 0; x + 1 < capture.labels.cols; ++x) {
      bool complete = true;
      for (const cv::Point p : {cv::Point(x, y), {x + 1, y}, {x, y + 1}, {x + 1, y + 1}}) {
        complete &=
            capture.labels(p) == label && std::isfinite(disparity_px(p)) && std::isfinite(capture.truth(p));
      }
      if (!complete) continue;
      volume_mm3 += prism(corner(x, y), corner(x + 1, y), corner(x, y + 1)) +
                    prism(corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1));
    }
  }
  return std::abs(volume_mm3) / 1000.0;
}

}  // namespace traygauge::test
