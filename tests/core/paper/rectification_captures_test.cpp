// Rendered captures with their true poses, and photographs of a fountain with surveyed cameras.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/paper/rectification/polar_rectification.hpp"
#include "tests/core/paper/capture_pair.hpp"
#include "tests/core/paper/photometric.hpp"

namespace traygauge::paper {
namespace {

// Bilinear; 0 where a neighbour is unknown.
double depth_at(const cv::Mat& depth, const Vec2& pixel) {
  const auto x = static_cast<int>(std::floor(pixel.x()));
  const auto y = static_cast<int>(std::floor(pixel.y()));
  if (x < 0 || y < 0 || x + 1 >= depth.cols || y + 1 >= depth.rows) return 0.0;
  const cv::Matx22f d(depth.at<float>(y, x), depth.at<float>(y, x + 1), depth.at<float>(y + 1, x),
                      depth.at<float>(y + 1, x + 1));
  const auto [low, high] = std::minmax({d(0, 0), d(0, 1), d(1, 0), d(1, 1)});
  constexpr float kEdge_mm = 3.0F;
  if (low <= 0.0F || high - low > kEdge_mm) return 0.0;
  const double fx = pixel.x() - x;
  const double fy = pixel.y() - y;
  return (1 - fy) * ((1 - fx) * d(0, 0) + fx * d(0, 1)) + fy * ((1 - fx) * d(1, 0) + fx * d(1, 1));
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

class Captures : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    folder_ = test::captures_folder();
    if (folder_.empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  }
  std::filesystem::path folder_;
};

TEST_P(Captures, TrueDepthLeadsToTheSameRowAndTheSameGrey) {
  const test::CaptureTruth capture = test::read_capture_truth(folder_ / GetParam());
  const RectificationParams params;
  OwnedWorkspace workspace(params);
  for (const auto& [a, b] : capture.pairs) {
    SCOPED_TRACE(::testing::Message() << "pair " << a << "-" << b);
    const WorkingView first = load_view(capture, a);
    const WorkingView second = load_view(capture, b);
    const Pose motion = test::motion_between(first.camera_from_world, second.camera_from_world);
    PolarRectification rectification;
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(rectification
                    .build({first.camera, WorkingView::view(first.region)},
                           {second.camera, WorkingView::view(second.region)}, motion, {}, params,
                           workspace.tables)
                    .ok());
    const double build_ms = milliseconds_since(start);
    const auto pictures =
        rectify_both(rectification, WorkingView::view(first.gray), WorkingView::view(second.gray));
    const double all_ms = milliseconds_since(start);
    EXPECT_EQ(rectification.pixels_per_sample(), 1.0);
    std::printf("%s %d-%d: %4d rows, %4d and %4d columns, build %.2f ms, both pictures %.2f ms", GetParam(),
                a, b, rectification.rows(), rectification.columns(0), rectification.columns(1), build_ms,
                all_ms - build_ms);
    if (a != 0) {
      std::printf("\n");
      continue;  // depth is known for view 0 only
    }
    const auto partner = [&](const Vec2& pixel) -> std::optional<Vec2> {
      const int x = static_cast<int>(std::lround(pixel.x()));
      const int y = static_cast<int>(std::lround(pixel.y()));
      if (!WorkingView::view(first.region).contains(x, y) || first.region.at<std::uint8_t>(y, x) == 0)
        return {};
      const double depth = depth_at(first.depth, pixel);
      if (depth <= 0.0) return {};
      const Vec2 ray = first.camera.ray(pixel);
      const Vec3 there = motion * Vec3(depth * ray.x(), depth * ray.y(), depth);
      return second.camera.pixel(there.head<2>() / there.z());
    };
    const RowAgreement agreement = compare_rows(rectification, pictures[0], pictures[1], partner);
    std::printf(", disparity %.0f to %.0f px, grey difference %.1f %.1f %.1f, offset %.3f px\n",
                agreement.min_disparity_px, agreement.max_disparity_px, agreement.difference[0],
                agreement.difference[1], agreement.difference[2], agreement.offset_px());
    EXPECT_GT(agreement.pixels, 0.8 * test::kWorkingDishPixels);
    EXPECT_LE(agreement.worst_row_px, 1e-6);
    EXPECT_LT(agreement.difference[1], agreement.difference[0]);
    EXPECT_LT(agreement.difference[1], agreement.difference[2]);
    EXPECT_NEAR(agreement.offset_px(), 0.0, 0.2);
  }
}

INSTANTIATE_TEST_SUITE_P(Rendered, Captures,
                         ::testing::Values("meals/m01", "meals/m04", "meals/m06", "meals/m08", "meals/m11",
                                           "angles/a01", "plates/c1_dinner", "plates/c1_oval",
                                           "plates/c1_soup"));

// Surveyed cameras around a fountain; matches by OpenCV's SIFT.
class Fountain : public ::testing::TestWithParam<std::pair<int, int>> {
 protected:
  struct View {
    cv::Mat gray;
    PinholeCamera camera;
    Pose camera_from_world;
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
  };
  static constexpr double kScale = 0.5;

  View load(int number) const {
    const test::TrueView stored = test::read_real_views(folder_).at(static_cast<std::size_t>(number));
    View view;
    cv::resize(stored.read_gray(), view.gray, {}, kScale, kScale, cv::INTER_AREA);
    view.camera = test::enlarge(stored.lens.pinhole, kScale);
    view.camera_from_world = stored.camera_from_world;
    cv::SIFT::create(4000)->detectAndCompute(view.gray, {}, view.keypoints, view.descriptors);
    return view;
  }
  void SetUp() override {
    folder_ = test::captures_folder();
    if (folder_.empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
    folder_ /= "real/strecha_fountain_P11";
  }
  std::filesystem::path folder_;
};

TEST_P(Fountain, MatchesLieInTheSameRow) {
  const View first = load(GetParam().first);
  const View second = load(GetParam().second);
  const Picture everything = [&] {
    Picture region(first.gray.cols, first.gray.rows);
    std::ranges::fill(region.pixels, std::uint8_t{1});
    return region;
  }();
  const RectificationParams params{.max_rows = 1536, .max_columns = 1536};
  OwnedWorkspace workspace(params);
  PolarRectification rectification;
  ASSERT_TRUE(rectification
                  .build({first.camera, everything.view()}, {second.camera, everything.view()},
                         test::motion_between(first.camera_from_world, second.camera_from_world), {}, params,
                         workspace.tables)
                  .ok());
  std::vector<std::vector<cv::DMatch>> matches;
  cv::BFMatcher().knnMatch(first.descriptors, second.descriptors, matches, 2);
  std::vector<double> differences;
  for (const auto& match : matches) {
    if (match[0].distance > 0.7F * match[1].distance) continue;
    const auto& a = first.keypoints[static_cast<std::size_t>(match[0].queryIdx)].pt;
    const auto& b = second.keypoints[static_cast<std::size_t>(match[0].trainIdx)].pt;
    Vec2 in_first, in_second;
    if (!rectification.rectified(0, Vec2(a.x, a.y), in_first)) continue;
    if (!rectification.rectified(1, Vec2(b.x, b.y), in_second)) continue;
    differences.push_back(std::abs(in_first.y() - in_second.y()));
  }
  ASSERT_GT(differences.size(), 200U);
  std::ranges::sort(differences);
  const double median = differences[differences.size() / 2];
  std::printf("fountain %d-%d: %d rows, %d and %d columns, %zu matches, rows differ by %.3f px (median)\n",
              GetParam().first, GetParam().second, rectification.rows(), rectification.columns(0),
              rectification.columns(1), differences.size(), median);
  EXPECT_LE(median, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Photographs, Fountain,
                         ::testing::Values(std::pair(2, 3), std::pair(4, 6), std::pair(5, 4),
                                           std::pair(7, 8)));

}  // namespace
}  // namespace traygauge::paper
