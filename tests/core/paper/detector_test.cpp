#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/core/paper/surf_on_picture.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge::paper {
namespace {

using test::PictureFeatures;
using test::planned_bytes;
using test::run_surf;
using test::textured_picture;

static_assert(planned_bytes(1264, SurfParams{}) < 80U * 1024U, "three rows a layer, whatever the height");

cv::Mat gaussian_blob(const Vec2& centre, double sigma, double amplitude) {
  constexpr int kSide = 301;
  cv::Mat picture(kSide, kSide, CV_8U);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double square = (Vec2(x, y) - centre).squaredNorm();
      picture.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>(120.0 + amplitude * std::exp(-square / (2.0 * sigma * sigma)));
    }
  }
  return picture;
}

// Closed form: the response at the middle of a Gaussian blob of a filter with lobes of l pixels, whose boxes
// are integrals of the blob, is a product of error functions (the mixed derivative vanishes).
double box_response(double lobe, double sigma) {
  const auto inside = [&](double width) { return std::erf(0.5 * width / (std::sqrt(2.0) * sigma)); };
  const double second = inside(2.0 * lobe - 1.0) * (inside(3.0 * lobe) - 3.0 * inside(lobe));
  return std::pow(second * sigma * sigma / (lobe * lobe), 2.0);
}
double strongest_scale(double sigma) {
  double best = 0.0;
  for (double lobe = 2.0; lobe < 100.0; lobe *= 1.002) {
    if (best == 0.0 || box_response(lobe, sigma) > box_response(best, sigma)) best = lobe;
  }
  return 1.2 / 9.0 * 3.0 * best;
}

class GaussianBlob : public ::testing::TestWithParam<double> {};

TEST_P(GaussianBlob, IsFoundWhereItIsAndAsLargeAsItIs) {
  const double sigma = GetParam();
  cv::RNG rng(42);
  for (const int step : {1, 2}) {
    for (int i = 0; i < 12; ++i) {
      const Vec2 centre(148.0 + rng.uniform(0.0, 4.0), 148.0 + rng.uniform(0.0, 4.0));
      const double amplitude = i % 2 == 0 ? 110.0 : -110.0;
      const PictureFeatures found =
          run_surf(gaussian_blob(centre, sigma, amplitude), {.first_step_px = step});
      ASSERT_FALSE(found.keypoints.empty()) << "at " << centre.transpose() << " step " << step;
      const Keypoint& keypoint = found.keypoints.front();
      EXPECT_LT((keypoint.pixel - centre).norm(), 0.1) << "at " << centre.transpose() << " step " << step;
      EXPECT_NEAR(static_cast<double>(keypoint.scale_px) / strongest_scale(sigma), 1.0, 0.15)
          << "step " << step;
      EXPECT_EQ(keypoint.laplacian, amplitude > 0.0 ? -1 : 1);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Sigmas, GaussianBlob,
                         ::testing::Values(2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0));

// det(H) of the box filters by direct sums over the picture, in double precision.
double direct_response(const cv::Mat& picture, int x, int y, int size) {
  const int lobe = size / 3;
  const auto box = [&](int left, int top, int right, int bottom) {
    return cv::sum(
        picture(cv::Rect(cv::Point(x + left, y + top), cv::Point(x + right + 1, y + bottom + 1))))[0];
  };
  const int half = lobe / 2;
  const int radius = size / 2;
  const int band = lobe - 1;
  const double area = 255.0 * size * size;
  const double dxx = (box(-radius, -band, radius, band) - 3.0 * box(-half, -band, half, band)) / area;
  const double dyy = (box(-band, -radius, band, radius) - 3.0 * box(-band, -half, band, half)) / area;
  const double dxy = (box(-lobe, -lobe, -1, -1) + box(1, 1, lobe, lobe) - box(1, -lobe, lobe, -1) -
                      box(-lobe, 1, -1, lobe)) /
                     area;
  return dxx * dyy - 0.81 * dxy * dxy;
}

TEST(Detector, FindsExactlyTheMaximaOfTheDefinition) {
  const cv::Mat picture = textured_picture(150, 110, 5);
  constexpr int kStep = 2;
  constexpr double kThreshold = 3e-4;
  constexpr int kSizes[] = {9, 15, 21, 27};
  const int columns = (picture.cols + 1) / kStep;
  const int rows = (picture.rows + 1) / kStep;
  std::vector<cv::Mat> layers;
  for (const int size : kSizes) {
    cv::Mat layer(rows, columns, CV_64F, cv::Scalar(0.0));
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        const int margin =
            std::min({c * kStep, r * kStep, picture.cols - 1 - c * kStep, picture.rows - 1 - r * kStep});
        if (margin >= size / 2) layer.at<double>(r, c) = direct_response(picture, c * kStep, r * kStep, size);
      }
    }
    layers.push_back(layer);
  }
  std::size_t maxima = 0;
  for (std::size_t l = 1; l + 1 < layers.size(); ++l) {
    for (int r = 1; r + 1 < rows; ++r) {
      for (int c = 1; c + 1 < columns; ++c) {
        const int margin =
            std::min({c * kStep, r * kStep, picture.cols - 1 - c * kStep, picture.rows - 1 - r * kStep});
        if (margin < kSizes[l + 1] / 2 + kStep) continue;
        const double centre = layers[l].at<double>(r, c);
        double largest = 0.0;
        for (std::size_t k = l - 1; k <= l + 1; ++k) {
          cv::Mat around = layers[k](cv::Rect(c - 1, r - 1, 3, 3)).clone();
          if (k == l) around.at<double>(1, 1) = 0.0;
          largest = std::max(largest, *std::max_element(around.begin<double>(), around.end<double>()));
        }
        if (centre >= kThreshold && centre > largest) ++maxima;
      }
    }
  }
  const PictureFeatures found = run_surf(
      picture, {.octaves = 1, .first_step_px = kStep, .min_response = 3e-4F, .max_elongation = 1e6F});
  ASSERT_GT(maxima, 30U);
  EXPECT_LE(found.keypoints.size(), maxima);  // some have no vertex among their neighbours
  EXPECT_GE(found.keypoints.size(), maxima - maxima / 10 - 1);
  for (const Keypoint& keypoint : found.keypoints) {
    const int c0 = static_cast<int>(std::lround(keypoint.pixel.x() / kStep));
    const int r0 = static_cast<int>(std::lround(keypoint.pixel.y() / kStep));
    double nearest = 1.0;
    for (std::size_t l = 1; l <= 2; ++l) {
      for (int r = std::max(r0 - 1, 0); r <= std::min(r0 + 1, rows - 1); ++r) {
        for (int c = std::max(c0 - 1, 0); c <= std::min(c0 + 1, columns - 1); ++c) {
          nearest = std::min(nearest,
                             std::abs(layers[l].at<double>(r, c) - static_cast<double>(keypoint.response)));
        }
      }
    }
    EXPECT_LT(nearest, 1e-7);
  }
}

TEST(Detector, FindsNothingOnUniformGroundOrARamp) {
  const SurfParams sensitive{.first_step_px = 1, .min_response = 1e-7F};
  for (const int value : {0, 1, 128, 255}) {
    EXPECT_TRUE(run_surf(cv::Mat(200, 300, CV_8U, cv::Scalar(value)), sensitive).keypoints.empty());
  }
  cv::Mat ramp(200, 250, CV_8U);
  for (int y = 0; y < ramp.rows; ++y) {
    for (int x = 0; x < ramp.cols; ++x) ramp.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(x);
  }
  EXPECT_TRUE(run_surf(ramp, sensitive).keypoints.empty());
}

// A Gaussian blob of axes a > b through a Gaussian filter of sigma f has curvatures in the ratio
// (a² + f²) / (b² + f²); f lies between b and 2 b here. So 4 : 1 gives at least 4, and 1.2 : 1 at most 1.3.
TEST(Detector, ElongatedBlobsAreNoKeypoints) {
  for (const double turn : {0.0, 0.4, 0.8}) {
    for (const double elongation : {1.0, 1.2, 4.0}) {
      cv::Mat picture(301, 301, CV_8U);
      for (int y = 0; y < picture.rows; ++y) {
        for (int x = 0; x < picture.cols; ++x) {
          const double along = (std::cos(turn) * (x - 150) + std::sin(turn) * (y - 150)) / (6.0 * elongation);
          const double across = (std::cos(turn) * (y - 150) - std::sin(turn) * (x - 150)) / 6.0;
          const double height = std::exp(-0.5 * (along * along + across * across));
          picture.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(60.0 + 150.0 * height);
        }
      }
      const auto middle_found = [&](float max_elongation) {
        const auto found =
            run_surf(picture, {.min_response = 1e-3F, .max_elongation = max_elongation}).keypoints;
        return std::any_of(found.begin(), found.end(),
                           [](const Keypoint& k) { return (k.pixel - Vec2(150.0, 150.0)).norm() < 3.0; });
      };
      EXPECT_TRUE(middle_found(1e6F)) << turn << " " << elongation;
      EXPECT_EQ(middle_found(3.0F), elongation < 2.0) << turn << " " << elongation;
    }
  }
}

TEST(Detector, SurvivesPicturesSmallerThanItsFilters) {
  for (const cv::Size size :
       {cv::Size(1, 1), cv::Size(8, 300), cv::Size(300, 9), cv::Size(27, 27), cv::Size(60, 40)}) {
    const PictureFeatures found = run_surf(textured_picture(size.width, size.height, 3), {.octaves = 5});
    EXPECT_LT(found.keypoints.size(), 100U) << size;
  }
}

TEST(Detector, ACapKeepsTheStrongestInTheSameOrder) {
  const cv::Mat picture = textured_picture(400, 300, 9);
  const PictureFeatures all = run_surf(picture);
  ASSERT_GT(all.keypoints.size(), 200U);
  EXPECT_EQ(all.dropped, 0U);
  EXPECT_TRUE(std::is_sorted(all.keypoints.begin(), all.keypoints.end(),
                             [](const Keypoint& a, const Keypoint& b) { return a.response > b.response; }));
  for (const std::size_t cap : {std::size_t{0}, std::size_t{1}, std::size_t{50}, all.keypoints.size()}) {
    const PictureFeatures few = run_surf(picture, {}, cap);
    ASSERT_EQ(few.keypoints.size(), cap);
    EXPECT_EQ(few.dropped, all.keypoints.size() - cap);
    for (std::size_t i = 0; i < cap; ++i) {
      ASSERT_EQ(few.keypoints[i].pixel, all.keypoints[i].pixel);
      ASSERT_EQ(few.descriptors[i], all.descriptors[i]);
    }
  }
}

TEST(Detector, EqualResponsesAreTakenFromTheTop) {
  cv::Mat picture(200, 800, CV_8U, cv::Scalar(100));
  for (int i = 0; i < 8; ++i) cv::circle(picture, {60 + 96 * i, 100}, 8, cv::Scalar(200), cv::FILLED);
  const PictureFeatures few = run_surf(picture, {.octaves = 2}, 3);
  ASSERT_EQ(few.keypoints.size(), 3U);
  EXPECT_NEAR(few.keypoints[0].pixel.x(), 60.0, 0.5);
  EXPECT_NEAR(few.keypoints[1].pixel.x(), 156.0, 0.5);
  EXPECT_NEAR(few.keypoints[2].pixel.x(), 252.0, 0.5);
  EXPECT_EQ(few.keypoints[0].response, few.keypoints[2].response);
}

TEST(Detector, AHigherThresholdAndFewerOctavesLeaveASubset) {
  const cv::Mat picture = textured_picture(400, 300, 10);
  const std::size_t all = run_surf(picture).keypoints.size();
  const PictureFeatures strong = run_surf(picture, {.min_response = 1e-3F});
  EXPECT_LT(strong.keypoints.size(), all);
  for (const Keypoint& keypoint : strong.keypoints) EXPECT_GE(keypoint.response, 1e-3F);
  float largest = 0.0F;
  for (const Keypoint& keypoint : run_surf(picture, {.octaves = 1}).keypoints) {
    largest = std::max(largest, keypoint.scale_px);
  }
  EXPECT_LE(largest, 1.2F * 27.0F / 9.0F);
}

TEST(SurfParamsValidation, RefusesWhatCannotRun) {
  EXPECT_TRUE(validate(SurfParams{}).ok());
  EXPECT_FALSE(validate(SurfParams{.octaves = 0}).ok());
  EXPECT_FALSE(validate(SurfParams{.octaves = kMaxOctaves + 1}).ok());
  EXPECT_FALSE(validate(SurfParams{.first_step_px = 0}).ok());
  EXPECT_FALSE(validate(SurfParams{.min_response = 0.0F}).ok());
  EXPECT_FALSE(validate(SurfParams{.max_elongation = 0.5F}).ok());
  EXPECT_FALSE(validate(SurfParams{.min_response = std::numeric_limits<float>::quiet_NaN()}).ok());
  EXPECT_FALSE(validate(SurfParams{.min_response = std::numeric_limits<float>::infinity()}).ok());
}

}  // namespace
}  // namespace traygauge::paper
