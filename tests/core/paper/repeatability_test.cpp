// The oracle is the transform that we applied ourselves to a photograph-like picture of the captures, and the
// captures' own poses.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image/resample.hpp"
#include "tests/core/paper/surf_on_picture.hpp"
#include "tests/support/capture_truth.hpp"

namespace traygauge::paper {
namespace {

using test::PictureFeatures;
using test::run_surf;

std::vector<cv::DMatch> match_mutually(const PictureFeatures& first, const PictureFeatures& second) {
  const auto matrix_of = [](const PictureFeatures& features) {
    cv::Mat matrix(static_cast<int>(features.descriptors.size()), kDescriptorLength, CV_32F);
    for (int i = 0; i < matrix.rows; ++i) {
      const Descriptor& descriptor = features.descriptors[static_cast<std::size_t>(i)];
      std::copy(descriptor.begin(), descriptor.end(), matrix.ptr<float>(i));
    }
    return matrix;
  };
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(cv::NORM_L2, true).match(matrix_of(first), matrix_of(second), matches);
  return matches;
}

class OnCaptures : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::captures_folder().string();
    if (folder_.empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  }
  // Half of the stored size.
  cv::Mat read_picture(const std::string& path) const {
    const cv::Mat gray = cv::imread(folder_ + path, cv::IMREAD_GRAYSCALE);
    cv::Mat small(gray.rows / 2, gray.cols / 2, CV_8U);
    reduce_area({gray.data, gray.cols, gray.rows}, {small.data, small.cols, small.rows});
    return small;
  }
  std::string folder_;
};

struct Change {
  const char* what;
  double turn_deg;
  double scale;
  double gain;
  double perspective;
  double min_repeated;  // share of keypoints found again within 1.5 px
  double min_correct;   // share of mutual matches that are correct within 3 px
};

cv::Matx33d homography_of(const Change& change, cv::Size size) {
  const double angle = change.turn_deg * CV_PI / 180.0;
  const double c = change.scale * std::cos(angle);
  const double s = change.scale * std::sin(angle);
  const cv::Matx33d to_centre(1, 0, -0.5 * size.width, 0, 1, -0.5 * size.height, 0, 0, 1);
  const cv::Matx33d turn(c, -s, 0, s, c, 0, change.perspective / size.width, 0, 1);
  return to_centre.inv() * turn * to_centre;
}

TEST_F(OnCaptures, KeypointsAreFoundAgainAndMatched) {
  // The shares lie a tenth below what the detector reached when it was written; chance would give 4%. Boxes
  // are not round: rotations by odd multiples of 45° cost most (Bay et al., section 3.2).
  constexpr Change kChanges[] = {
      {"darker", 0.0, 1.0, 0.7, 0.0, 0.90, 0.95},
      {"turned by 10°", 10.0, 1.0, 1.0, 0.0, 0.50, 0.60},
      {"turned by 45°", 45.0, 1.0, 1.0, 0.0, 0.40, 0.50},
      {"turned by 180°", 180.0, 1.0, 1.0, 0.0, 0.95, 0.95},
      {"smaller", 0.0, 0.8, 1.0, 0.0, 0.42, 0.65},
      {"in perspective", 5.0, 0.95, 0.9, 0.2, 0.55, 0.70},
  };
  for (const std::string path : {"/meals/m11/view_0.jpg", "/trays/t01/view_0.jpg"}) {
    const cv::Mat picture = read_picture(path);
    const PictureFeatures before = run_surf(picture);
    for (const Change& change : kChanges) {
      const cv::Matx33d map = homography_of(change, picture.size());
      cv::Mat changed;
      cv::warpPerspective(picture * change.gain, changed, map, picture.size(), cv::INTER_CUBIC);
      const PictureFeatures after = run_surf(changed);
      const auto mapped = [&](const Keypoint& keypoint) {
        const cv::Vec3d p = map * cv::Vec3d(keypoint.pixel.x(), keypoint.pixel.y(), 1.0);
        return Vec2(p[0] / p[2], p[1] / p[2]);
      };
      int visible = 0;
      int repeated = 0;
      for (const Keypoint& keypoint : before.keypoints) {
        const Vec2 expected = mapped(keypoint);
        const double margin = 6.0 * static_cast<double>(keypoint.scale_px) + 8.0;
        if (expected.x() < margin || expected.y() < margin || expected.x() > picture.cols - margin ||
            expected.y() > picture.rows - margin) {
          continue;
        }
        // Brightness and scale push the weakest below the threshold; those are not the question.
        if (keypoint.response * static_cast<float>(change.gain * change.gain) < 1.5e-4F) continue;
        ++visible;
        repeated += std::any_of(after.keypoints.begin(), after.keypoints.end(),
                                [&](const Keypoint& k) { return (k.pixel - expected).norm() < 1.5; });
      }
      const std::vector<cv::DMatch> matches = match_mutually(before, after);
      int correct = 0;
      for (const cv::DMatch& match : matches) {
        const Keypoint& from = before.keypoints[static_cast<std::size_t>(match.queryIdx)];
        const Keypoint& to = after.keypoints[static_cast<std::size_t>(match.trainIdx)];
        correct += (to.pixel - mapped(from)).norm() < 3.0;
      }
      const double repeated_fraction = static_cast<double>(repeated) / visible;
      const double correct_fraction = static_cast<double>(correct) / static_cast<double>(matches.size());
      std::printf("%s %s: repeated %.3f of %d, correct %.3f of %zu\n", path.c_str(), change.what,
                  repeated_fraction, visible, correct_fraction, matches.size());
      ASSERT_GT(visible, 100) << change.what;
      EXPECT_GT(repeated_fraction, change.min_repeated) << path << " " << change.what;
      EXPECT_GT(correct_fraction, change.min_correct) << path << " " << change.what;
    }
  }
}

// Matches between two views of a meal against the true epipolar geometry.
TEST_F(OnCaptures, ViewsOfAMealShareEnoughCorrectMatches) {
  for (const std::string scene : {"/meals/m01", "/meals/m08", "/trays/t05"}) {
    const test::CaptureTruth truth = test::read_capture_truth(folder_ + scene);
    const LensModel& lens = truth.views[0].lens;
    const Mat3 essential = essential_matrix(
        test::motion_between(truth.views[0].camera_from_world, truth.views[1].camera_from_world));
    const PictureFeatures a = run_surf(read_picture(scene + "/view_0.jpg"), {.first_step_px = 1}, 2500);
    const PictureFeatures b = run_surf(read_picture(scene + "/view_1.jpg"), {.first_step_px = 1}, 2500);
    const auto ray_of = [&](const Keypoint& keypoint) {
      Vec2 ray;
      const Vec2 stored(scale_coordinate(keypoint.pixel.x(), 2.0), scale_coordinate(keypoint.pixel.y(), 2.0));
      EXPECT_TRUE(lens.undistort_pixel(stored, ray));
      return Vec3(ray.x(), ray.y(), 1.0);
    };
    int correct = 0;
    for (const cv::DMatch& match : match_mutually(a, b)) {
      const Vec3 first_ray = ray_of(a.keypoints[static_cast<std::size_t>(match.queryIdx)]);
      const Vec3 second_ray = ray_of(b.keypoints[static_cast<std::size_t>(match.trainIdx)]);
      const Vec3 line = essential * first_ray;
      const double error =
          std::abs(second_ray.dot(line)) / line.head<2>().norm() * lens.pinhole.mean_focal_px();
      correct += error < 2.0;
    }
    std::printf("%s: %d correct\n", scene.c_str(), correct);
    EXPECT_GT(correct, 120) << scene;
  }
}

}  // namespace
}  // namespace traygauge::paper
