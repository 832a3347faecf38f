// Pictures of a printed card with a known pose, by OpenCV: the print warped in linear light on a grid three
// times as fine, averaged over each pixel's area.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/card/card_alignment.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/labels/label_regions.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge {

inline constexpr int kRenderWidth = 1600;
inline constexpr int kRenderHeight = 1200;

inline LensModel render_lens() {
  LensModel lens;
  lens.width = kRenderWidth;
  lens.height = kRenderHeight;
  lens.pinhole = {1390.0, 1385.0, 803.0, 597.0};
  return lens;
}

// Discs and bars on a light ground, 20 px/mm.
inline cv::Mat1b random_print(std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat1b print(1080, 1712, static_cast<std::uint8_t>(190));
  for (int i = 0; i < 900; ++i) {
    const cv::Point at(random.uniform(0, print.cols), random.uniform(0, print.rows));
    const cv::Scalar gray(random.uniform(20, 250));
    const cv::Size half(random.uniform(6, 50), random.uniform(6, 50));
    if (i % 2 == 0) {
      cv::ellipse(print, at, half, random.uniform(0, 180), 0, 360, gray, cv::FILLED, cv::LINE_AA);
    } else {
      cv::rectangle(print, cv::Rect(at, half), gray, cv::FILLED);
    }
  }
  return print;
}

// A camera `distance_mm` above the card's centre, tilted and turned; the centre appears at `pixel`.
inline Pose look_at_card(const CardModelSize& size, double distance_mm, double tilt_deg, double azimuth_deg,
                         double roll_deg, const Vec2& pixel) {
  const double degree = std::acos(-1.0) / 180.0;
  Pose pose;
  const Mat3 down = Vec3(1.0, -1.0, -1.0).asDiagonal();
  const Mat3 azimuth = rotation_about(Vec3(0.0, 0.0, azimuth_deg * degree));
  pose.rotation = rotation_about(Vec3(0.0, 0.0, roll_deg * degree)) *
                  rotation_about(Vec3(tilt_deg * degree, 0.0, 0.0)) * down * azimuth;
  const Vec3 centre = print_point_mm({0.5 * size.width_mm, 0.5 * size.height_mm}, size.thickness_mm);
  const Vec2 ray = render_lens().pinhole.ray(pixel);
  pose.translation = distance_mm * ray.homogeneous() - pose.rotation * centre;
  return pose;
}

struct CardRender {
  cv::Mat1b gray;
  cv::Mat1b labels;
};

// Picture pixels of print pixels, as OpenCV's warpPerspective wants them.
inline cv::Matx33d picture_from_print(const Pose& camera_from_table, const CardModelSize& size,
                                      const cv::Mat1b& print) {
  const PinholeCamera& camera = render_lens().pinhole;
  const double x = size.width_mm / print.cols;
  const double y = size.height_mm / print.rows;
  const Mat3& r = camera_from_table.rotation;
  Mat3 ray_from_mm;
  ray_from_mm << r.col(0), -r.col(1), r.col(2) * size.thickness_mm + camera_from_table.translation;
  Mat3 mm_from_pixel;
  mm_from_pixel << x, 0.0, 0.5 * x, 0.0, y, 0.5 * y, 0.0, 0.0, 1.0;
  Mat3 pixel_from_ray;
  pixel_from_ray << camera.fx_px, 0.0, camera.cx_px, 0.0, camera.fy_px, camera.cy_px, 0.0, 0.0, 1.0;
  const Mat3 map = pixel_from_ray * ray_from_mm * mm_from_pixel;
  return {map(0, 0), map(0, 1), map(0, 2), map(1, 0), map(1, 1), map(1, 2), map(2, 0), map(2, 1), map(2, 2)};
}

// What the card covers of the picture, and eight pixels about it for the blur.
inline cv::Rect card_box(const cv::Matx33d& map, const cv::Size& print) {
  const auto right = static_cast<float>(print.width);
  const auto bottom = static_cast<float>(print.height);
  const std::vector<cv::Point2f> corners = {{0.0F, 0.0F}, {right, 0.0F}, {right, bottom}, {0.0F, bottom}};
  std::vector<cv::Point2f> seen;
  cv::perspectiveTransform(corners, seen, map);
  const cv::Rect box = cv::boundingRect(seen);
  constexpr int kMargin = 8;
  return (box + cv::Size(2 * kMargin, 2 * kMargin) - cv::Point(kMargin, kMargin)) &
         cv::Rect(0, 0, kRenderWidth, kRenderHeight);
}

inline CardRender render_card(const Pose& camera_from_table, const CardModelSize& size,
                              const cv::Mat1b& print, double blur_px = 0.3) {
  constexpr int kFine = 3;
  const cv::Matx33d finer(kFine, 0.0, 0.5 * (kFine - 1), 0.0, kFine, 0.5 * (kFine - 1), 0.0, 0.0, 1.0);
  const cv::Matx33d map = picture_from_print(camera_from_table, size, print);
  const cv::Rect box = card_box(map, print.size());
  const cv::Matx33d to_box(1.0, 0.0, -box.x, 0.0, 1.0, -box.y, 0.0, 0.0, 1.0);
  cv::Mat1f light;
  cv::multiply(print, print, light, 1.0, CV_32F);
  cv::GaussianBlur(light, light, {}, 2.0);  // against aliases of the finer grid
  constexpr double kTableGray = 60.0;
  cv::Mat1f warped;
  cv::warpPerspective(light, warped, finer * to_box * map, box.size() * kFine, cv::INTER_LINEAR,
                      cv::BORDER_CONSTANT, kTableGray * kTableGray);
  cv::Mat1f picture;
  cv::resize(warped, picture, box.size(), 0.0, 0.0, cv::INTER_AREA);
  if (blur_px > 0.0) cv::GaussianBlur(picture, picture, {}, blur_px);
  cv::sqrt(picture, picture);
  CardRender render;
  render.gray = cv::Mat1b(kRenderHeight, kRenderWidth, cv::saturate_cast<std::uint8_t>(kTableGray));
  cv::Mat1b card = render.gray(box);
  picture.convertTo(card, CV_8U);
  const cv::Mat1b whole(print.size(), kCardLabel);
  cv::warpPerspective(whole, render.labels, map, render.gray.size(), cv::INTER_NEAREST);
  return render;
}

inline void add_noise(cv::Mat1b& gray, double sigma, std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat1f noise(gray.size());
  random.fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  cv::Mat1f sum;
  gray.convertTo(sum, CV_32F);
  sum += noise;
  sum.convertTo(gray, CV_8U);
}

struct CardPoseError {
  double corner_rms_px = 0.0;
  double normal_deg = 0.0;
  double height_200_mm = 0.0;      // of the table, 200 mm from the card's centre, in the worst direction
  double normalised_square = 0.0;  // by the information: 6 on average
};

inline CardPoseError compare_poses(const CardAlignment& alignment, const Pose& truth,
                                   const CardModelSize& size, double focal_px) {
  const double degree = std::acos(-1.0) / 180.0;
  const Pose& pose = alignment.camera_from_table;
  CardPoseError error;
  const std::array<Vec2, 4> corners = {Vec2(0.0, 0.0), Vec2(size.width_mm, 0.0),
                                       Vec2(size.width_mm, size.height_mm), Vec2(0.0, size.height_mm)};
  double square = 0.0;
  for (const Vec2& corner : corners) {
    const Vec3 point = print_point_mm(corner, size.thickness_mm);
    square += ((pose * point).hnormalized() - (truth * point).hnormalized()).squaredNorm();
  }
  error.corner_rms_px = focal_px * std::sqrt(square / 4.0);
  error.normal_deg =
      std::asin(std::min(1.0, pose.rotation.col(2).cross(truth.rotation.col(2)).norm())) / degree;
  for (int i = 0; i < 16; ++i) {
    const double angle = 22.5 * i * degree;
    const Vec3 point(0.5 * size.width_mm + 200.0 * std::cos(angle),
                     -0.5 * size.height_mm + 200.0 * std::sin(angle), 0.0);
    error.height_200_mm = std::max(error.height_200_mm, std::abs((pose.inverse() * (truth * point)).z()));
  }
  const Eigen::AngleAxisd turn(pose.rotation * truth.rotation.transpose());
  Eigen::Matrix<double, 6, 1> step;
  step << turn.angle() * turn.axis(), pose.translation - truth.translation;
  error.normalised_square = step.dot(alignment.information * step);
  return error;
}

// Owns the memory of pattern and alignment.
class CardAligner {
 public:
  explicit CardAligner(const CardAlignmentParams& params = {}) : params_(params) {
    ArenaPlan plan;
    CardPattern planned;
    CardAlignmentWorkspace planned_workspace;
    planned.allocate(plan, params_.pattern);
    planned_workspace.allocate(plan, params_);
    block_.resize(plan.used_bytes() + kArenaAlignmentBytes);
    void* start = block_.data();
    std::size_t space = block_.size();
    std::align(kArenaAlignmentBytes, plan.used_bytes(), start, space);
    arena_ = Arena({static_cast<std::byte*>(start), plan.used_bytes()});
    pattern_.allocate(arena_, params_.pattern);
    workspace_.allocate(arena_, params_);
  }

  Status set_pattern(const cv::Mat1b& print, const CardModelSize& size) {
    return prepare_card_pattern(test::view_of(print), size, params_.pattern, pattern_);
  }
  Result<CardAlignment> align(const cv::Mat1b& gray, const cv::Mat1b& labels, const LensModel& lens) {
    const LabelRegions regions = measure_regions(test::view_of(labels));
    return align_card(test::view_of(gray), test::view_of(labels), regions.card, lens, pattern_, params_,
                      workspace_);
  }
  Result<CardAlignment> align(const CardRender& render) {
    return align(render.gray, render.labels, render_lens());
  }
  const CardPattern& pattern() const { return pattern_; }
  const CardAlignmentWorkspace& workspace() const { return workspace_; }

 private:
  CardAlignmentParams params_;
  std::vector<std::byte> block_;
  Arena arena_;
  CardPattern pattern_;
  CardAlignmentWorkspace workspace_;
};

}  // namespace traygauge
