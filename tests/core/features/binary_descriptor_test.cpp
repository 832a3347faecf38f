// Descriptors of corners: distances and means against OpenCV's, and what a turned picture leaves of them.
#include "core/features/binary_descriptor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "tests/support/pictures.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

TEST(BinaryDescriptor, DistanceIsOpenCvsHammingNorm) {
  std::mt19937_64 random(test::random_seed());
  for (int i = 0; i < 500; ++i) {
    BinaryDescriptor a;
    BinaryDescriptor b;
    for (std::size_t k = 0; k < a.size(); ++k) {
      a[k] = random();
      b[k] = i % 5 == 0 ? ~a[k] : a[k] ^ (random() & random());
    }
    const cv::Mat of_a(1, 32, CV_8U, a.data());
    const cv::Mat of_b(1, 32, CV_8U, b.data());
    ASSERT_EQ(hamming_distance(a, b), cvRound(cv::norm(of_a, of_b, cv::NORM_HAMMING)));
    ASSERT_EQ(hamming_distance(a, b, 1, 3),
              cvRound(cv::norm(of_a.colRange(8, 24), of_b.colRange(8, 24), cv::NORM_HAMMING)));
    ASSERT_EQ(hamming_distance(a, a), 0);
  }
}

TEST(BinaryDescriptor, BoxBlurIsOpenCvsButForTheBorder) {
  cv::RNG random(test::random_seed());
  const cv::Mat picture = test::random_picture(83, 61, CV_8U, random);
  cv::Mat mine(picture.size(), CV_8U);
  box_blur(test::view_of(picture), test::view_of(mine));
  cv::Mat truth;
  cv::blur(picture, truth, {3, 3});
  const cv::Rect inside(1, 1, 81, 59);
  EXPECT_LE(cv::norm(mine(inside), truth(inside), cv::NORM_INF), 1.0);
  for (int x = 0; x < 83; ++x) {
    EXPECT_EQ(mine.at<std::uint8_t>(0, x), picture.at<std::uint8_t>(0, x));
    EXPECT_EQ(mine.at<std::uint8_t>(60, x), picture.at<std::uint8_t>(60, x));
  }
}

// The same places in a picture that OpenCV has turned: descriptors stay near, directions turn with it.
TEST(BinaryDescriptor, TurnsWithThePicture) {
  BinarySampling sampling;
  sampling.draw(3);
  cv::Mat picture = test::textured_picture(241, 241, 12);
  cv::GaussianBlur(picture, picture, {}, 1.0);
  const auto smooth_of = [](const cv::Mat& source) {
    cv::Mat smooth(source.size(), CV_8U);
    box_blur(test::view_of(source), test::view_of(smooth));
    return smooth;
  };
  const cv::Mat smooth = smooth_of(picture);
  std::mt19937 random(test::random_seed());
  std::uniform_int_distribution<int> place(-60, 60);
  for (const double turn_deg : {25.0, 90.0, 163.0}) {
    const double turn = turn_deg * CV_PI / 180.0;
    cv::Mat turned;
    cv::warpAffine(picture, turned, cv::getRotationMatrix2D({120.0F, 120.0F}, -turn_deg, 1.0), picture.size(),
                   cv::INTER_CUBIC);
    const cv::Mat turned_smooth = smooth_of(turned);
    int near = 0;
    int apart = 0;
    int along = 0;
    constexpr int kPlaces = 100;
    for (int i = 0; i < kPlaces; ++i) {
      const Vec2 at(place(random), place(random));
      const Vec2 there = turned_by(at, Vec2(std::cos(turn), std::sin(turn)));
      BinaryDescriptor a;
      BinaryDescriptor b;
      BinaryDescriptor other;
      Vec2 from;
      Vec2 to;
      Vec2 elsewhere;
      ASSERT_TRUE(describe_binary(test::view_of(smooth), 120 + static_cast<int>(at.x()),
                                  120 + static_cast<int>(at.y()), sampling, a, from));
      ASSERT_TRUE(describe_binary(test::view_of(turned_smooth),
                                  120 + static_cast<int>(std::lround(there.x())),
                                  120 + static_cast<int>(std::lround(there.y())), sampling, b, to));
      ASSERT_TRUE(describe_binary(test::view_of(smooth), 120 + place(random), 120 + place(random), sampling,
                                  other, elsewhere));
      EXPECT_NEAR(from.norm(), 1.0, 1e-9);
      const bool is_near = hamming_distance(a, b) < 70;
      near += is_near ? 1 : 0;
      apart += hamming_distance(a, other) > hamming_distance(a, b) ? 1 : 0;
      if (is_near && turned_by(from, Vec2(std::cos(turn), std::sin(turn))).dot(to) > 0.7) ++along;
    }
    EXPECT_GT(near, kPlaces * 7 / 10) << turn_deg;
    EXPECT_GT(apart, kPlaces * 7 / 10) << turn_deg;
    EXPECT_GT(along, near * 9 / 10) << turn_deg;
  }
}

TEST(BinaryDescriptor, IsNoneAtTheEdgeOrWithoutAnOrientation) {
  BinarySampling sampling;
  sampling.draw(3);
  const cv::Mat picture = test::textured_picture(100, 80, 12);
  const cv::Mat flat(80, 100, CV_8U, cv::Scalar(90));
  BinaryDescriptor descriptor;
  Vec2 direction;
  const auto describe = [&](const cv::Mat& of, int x, int y) {
    return describe_binary(test::view_of(of), x, y, sampling, descriptor, direction);
  };
  EXPECT_TRUE(describe(picture, 50, 40));
  for (const cv::Point& at :
       {cv::Point(kBinaryPatchRadius - 1, 40), cv::Point(50, kBinaryPatchRadius - 1),
        cv::Point(100 - kBinaryPatchRadius, 40), cv::Point(50, 80 - kBinaryPatchRadius)})
    EXPECT_FALSE(describe(picture, at.x, at.y)) << at;
  EXPECT_FALSE(describe(flat, 50, 40));
}

}  // namespace
}  // namespace traygauge
