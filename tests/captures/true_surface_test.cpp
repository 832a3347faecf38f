// The true surface along lines of sight, against depth pictures, planes and labels that OpenCV reads and
// projects.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/calib3d.hpp>
#include <random>

#include "firmware/evaluate/true_scene.hpp"
#include "tests/support/capture_truth.hpp"

namespace traygauge {
namespace {

using test::CaptureTruth;
using test::TrueView;

constexpr unsigned kSeed = 9;
constexpr int kPixels = 3000;

// The eye and the unit vector of a pixel's line of sight, in the world; `lengthening`: distance over depth.
struct Sight {
  Vec3 eye_mm;
  Vec3 direction;
  double lengthening = 1.0;
};

Sight sight_of(const TrueView& view, const cv::Point& pixel) {
  const cv::Point2d ray = view.rays({cv::Point2d(pixel)}).front();
  const Vec3 in_camera(ray.x, ray.y, 1.0);
  const Pose world_from_camera = view.camera_from_world.inverse();
  return {world_from_camera.translation, world_from_camera.rotation * in_camera.normalized(),
          in_camera.norm()};
}

class TrueSurfaceOfM01 : public ::testing::Test {
 protected:
  void SetUp() override {
    if (test::captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
    const std::filesystem::path folder = test::captures_folder() / "meals" / "m01";
    capture_ = test::read_capture_truth(folder);
    depth_mm_ = capture_.read_depth_mm();
    labels_ = capture_.views[0].read_labels();
    surface_ = TrueSurface::read(read_capture(folder), read_truth(folder).value());
    ASSERT_TRUE(surface_.has_value());
    std::printf("seed %u\n", kSeed);
  }

  cv::Point draw_pixel() {
    std::uniform_int_distribution<int> column(1, labels_.cols - 2);
    std::uniform_int_distribution<int> row(1, labels_.rows - 2);
    const int x = column(random_);
    return {x, row(random_)};
  }
  double draw(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  // Depth is known around the pixel, and no edge passes.
  bool is_smooth(const cv::Point& pixel) const {
    double least = 0.0;
    double most = 0.0;
    cv::minMaxLoc(depth_mm_(cv::Rect(pixel.x - 1, pixel.y - 1, 3, 3)), &least, &most);
    return least > 0.0 && most - least < 2.0;
  }

  // Further from the depths around the pixel than they lie from each other on a steep surface.
  bool is_in_air(const cv::Point& pixel, double depth_mm) const {
    double nearest_mm = 1e9;
    for (const float known : cv::Mat1f(depth_mm_(cv::Rect(pixel.x - 1, pixel.y - 1, 3, 3)).clone()))
      nearest_mm = std::min(nearest_mm, std::abs(static_cast<double>(known) - depth_mm));
    return nearest_mm > 1.5;
  }

  CaptureTruth capture_;
  cv::Mat1f depth_mm_;
  cv::Mat1b labels_;
  std::optional<TrueSurface> surface_;
  std::mt19937 random_{kSeed};
};

TEST_F(TrueSurfaceOfM01, FromItsOwnEyeIsTheDepthPicture) {
  int compared = 0;
  double worst_mm = 0.0;
  while (compared < kPixels) {
    const cv::Point pixel = draw_pixel();
    if (!is_smooth(pixel)) continue;
    const Sight sight = sight_of(capture_.views[0], pixel);
    const double expected_mm = sight.lengthening * static_cast<double>(depth_mm_(pixel));
    const auto found_mm = surface_->distance_mm(sight.eye_mm, sight.direction, expected_mm + draw(-15, 35));
    ASSERT_TRUE(found_mm.has_value()) << pixel;
    worst_mm = std::max(worst_mm, std::abs(*found_mm - expected_mm));
    ++compared;
  }
  std::printf("worst %.3f mm\n", worst_mm);
  EXPECT_LT(worst_mm, 0.05);
}

// Closed form: the table is z = 0, the card's print lies at its thickness.
TEST_F(TrueSurfaceOfM01, OfTableAndCardIsTheirPlanes) {
  const double thickness_mm = capture_.description["card"]["thickness_mm"];
  for (const auto& [label, height_mm] : {std::pair(0, 0.0), std::pair(255, thickness_mm)}) {
    int compared = 0;
    double worst_mm = 0.0;
    for (int i = 0; i < 50 * kPixels && compared < kPixels; ++i) {
      const cv::Point pixel = draw_pixel();
      if (labels_(pixel) != label || !is_smooth(pixel)) continue;
      const Sight sight = sight_of(capture_.views[0], pixel);
      const double expected_mm = (height_mm - sight.eye_mm.z()) / sight.direction.z();
      const auto found_mm = surface_->distance_mm(sight.eye_mm, sight.direction, expected_mm);
      ASSERT_TRUE(found_mm.has_value()) << pixel;
      worst_mm = std::max(worst_mm, std::abs(*found_mm - expected_mm));
      ++compared;
    }
    std::printf("label %d: worst of %d %.3f mm\n", label, compared, worst_mm);
    EXPECT_GT(compared, kPixels / 10) << label;
    EXPECT_LT(worst_mm, 0.05) << label;
  }
}

// What the second view sees lies on the first one's depth and, but for outlines, carries the same label.
TEST_F(TrueSurfaceOfM01, FromTheSecondEyeProjectsOntoTheDepthPicture) {
  const TrueView& first = capture_.views[0];
  const TrueView& second = capture_.views[1];
  const cv::Mat1b second_labels = second.read_labels();
  const Mat3& r = first.camera_from_world.rotation;
  const cv::Matx33d rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2));
  cv::Vec3d rotation_vector;
  cv::Rodrigues(rotation, rotation_vector);
  const Vec3& t = first.camera_from_world.translation;
  int tried = 0;
  int compared = 0;
  int same_label = 0;
  int at_edges = 0;
  int in_air = 0;
  double worst_mm = 0.0;
  for (int i = 0; i < 50 * kPixels && compared < 4 * kPixels; ++i) {
    const cv::Point pixel = draw_pixel();
    if (second_labels(pixel) == 0 || second_labels(pixel) == 255) continue;
    const Sight sight = sight_of(second, pixel);
    const double about_mm = (15.0 - sight.eye_mm.z()) / sight.direction.z();
    const auto found_mm = surface_->distance_mm(sight.eye_mm, sight.direction, about_mm);
    ++tried;
    if (!found_mm) continue;
    const Vec3 hit = sight.eye_mm + *found_mm * sight.direction;
    std::vector<cv::Point2d> projected;
    cv::projectPoints(std::vector<cv::Point3d>{{hit.x(), hit.y(), hit.z()}}, rotation_vector,
                      cv::Vec3d(t.x(), t.y(), t.z()), test::camera_matrix(first.lens.pinhole),
                      test::distortion_of(first.lens), projected);
    const cv::Point nearest(projected[0]);
    if (!cv::Rect(1, 1, labels_.cols - 2, labels_.rows - 2).contains(nearest)) continue;
    if (!is_smooth(nearest)) {
      in_air += is_in_air(nearest, (first.camera_from_world * hit).z()) ? 1 : 0;
      ++at_edges;
      continue;
    }
    // To the plane through the depths around the pixel.
    const cv::Point2d off = projected[0] - cv::Point2d(nearest);
    const double middle_mm = static_cast<double>(depth_mm_(nearest));
    const auto slope = [&](const cv::Point& step) {
      return 0.5 * static_cast<double>(depth_mm_(nearest + step) - depth_mm_(nearest - step));
    };
    const double depth_mm = middle_mm + off.x * slope({1, 0}) + off.y * slope({0, 1});
    worst_mm = std::max(worst_mm, std::abs((first.camera_from_world * hit).z() - depth_mm));
    same_label += labels_(nearest) == second_labels(pixel) ? 1 : 0;
    ++compared;
  }
  std::printf("%d of %d, worst %.3f mm, same label %.2f %%, in the air %d of %d at edges\n", compared, tried,
              worst_mm, 100.0 * same_label / compared, in_air, at_edges);
  EXPECT_EQ(in_air, 0);
  EXPECT_GT(compared, 0.8 * tried);
  EXPECT_GT(compared, 1000);
  EXPECT_LT(worst_mm, 0.5);
  EXPECT_GT(same_label, 0.97 * compared);
}

TEST_F(TrueSurfaceOfM01, BehindTheEyeOrBesideThePictureIsNothing) {
  const Sight sight = sight_of(capture_.views[0], {labels_.cols / 2, labels_.rows / 2});
  EXPECT_FALSE(surface_->distance_mm(sight.eye_mm, -sight.direction, 400.0).has_value());
  const Vec3 aside = sight.eye_mm + Vec3(5000.0, 0.0, 0.0);
  EXPECT_FALSE(surface_->distance_mm(aside, sight.direction, 400.0).has_value());
}

}  // namespace
}  // namespace traygauge
