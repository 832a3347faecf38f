// Lenses of OpenCV's larger models, with OpenCV as the oracle.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "core/base/random.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/lens_lanes.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/opencv_camera.hpp"

namespace traygauge {
namespace {

// A lens, and its coefficients as OpenCV takes them: 8, 12 or 14.
struct FurtherLens {
  LensModel lens;
  std::vector<double> coefficients;
};

class FurtherDistortionAgainstOpenCv : public testing::TestWithParam<std::tuple<std::size_t, std::uint64_t>> {
 protected:
  FurtherLens random_further_lens() {
    const auto spread = [&](double range) { return range * (2.0 * random_.uniform() - 1.0); };
    FurtherLens made;
    LensModel& lens = made.lens;
    lens = test::phone_lens();
    lens.k1 = spread(0.15);
    lens.k2 = spread(0.05);
    lens.p1 = spread(0.002);
    lens.p2 = spread(0.002);
    lens.k3 = spread(0.01);
    std::array<double, 14> all = {lens.k1,       lens.k2,       lens.p1,      lens.p2,       lens.k3,
                                  spread(0.1),   spread(0.03),  spread(0.01), spread(0.003), spread(0.001),
                                  spread(0.003), spread(0.001), spread(0.05), spread(0.05)};
    FurtherDistortion& further = lens.further;
    const std::size_t count = std::get<0>(GetParam());
    for (std::size_t i = count; i < all.size(); ++i) all.at(i) = 0.0;
    further.is_used = true;
    further.k4 = all[5];
    further.k5 = all[6];
    further.k6 = all[7];
    further.s1 = all[8];
    further.s2 = all[9];
    further.s3 = all[10];
    further.s4 = all[11];
    further.tilt = sensor_tilt(all[12], all[13]);
    made.coefficients.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
    return made;
  }

  Random random_{std::get<1>(GetParam())};
};

TEST_P(FurtherDistortionAgainstOpenCv, DistortsAsProjectPoints) {
  const FurtherLens made = random_further_lens();
  const FurtherLensLanes lanes(made.lens);
  for (int i = 0; i < 200; ++i) {
    const Vec2 ray(1.2 * random_.uniform() - 0.6, random_.uniform() - 0.5);
    std::vector<cv::Point2d> projected;
    cv::projectPoints(std::vector<cv::Point3d>{{ray.x(), ray.y(), 1.0}}, cv::Vec3d(), cv::Vec3d(),
                      test::camera_matrix(made.lens.pinhole), made.coefficients, projected);
    const Vec2 pixel = made.lens.pixel(ray);
    ASSERT_NEAR(pixel.x(), projected[0].x, 1e-9);
    ASSERT_NEAR(pixel.y(), projected[0].y, 1e-9);
    const LensLanes::Pixel single = lanes.pixel(static_cast<float>(ray.x()), static_cast<float>(ray.y()));
    ASSERT_NEAR(single.x, projected[0].x, 1e-3);
    ASSERT_NEAR(single.y, projected[0].y, 1e-3);
  }
}

TEST_P(FurtherDistortionAgainstOpenCv, UndistortsAsUndistortPoints) {
  const FurtherLens made = random_further_lens();
  ASSERT_TRUE(validate(made.lens).ok());
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 500, 1e-14);
  for (int i = 0; i < 200; ++i) {
    const Vec2 pixel(made.lens.width * random_.uniform() - 0.5, made.lens.height * random_.uniform() - 0.5);
    std::vector<cv::Point2d> rays;
    cv::undistortPoints(std::vector<cv::Point2d>{{pixel.x(), pixel.y()}}, rays,
                        test::camera_matrix(made.lens.pinhole), made.coefficients, cv::noArray(),
                        cv::noArray(), until);
    Vec2 ray;
    ASSERT_TRUE(made.lens.undistort_pixel(pixel, ray));
    EXPECT_NEAR(ray.x(), rays[0].x, 1e-7);
    EXPECT_NEAR(ray.y(), rays[0].y, 1e-7);
    ASSERT_LT((made.lens.pixel(ray) - pixel).norm(), 1e-7);
  }
}

INSTANTIATE_TEST_SUITE_P(Counts, FurtherDistortionAgainstOpenCv,
                         testing::Combine(testing::Values(8, 12, 14), testing::Range<std::uint64_t>(1, 13)));

TEST(FurtherDistortion, WithoutItsTermsALensIsTheSameToTheLastBit) {
  const LensModel plain = test::phone_lens();
  LensModel used = plain;
  used.further.is_used = true;
  for (int i = 0; i < 50; ++i) {
    const Vec2 pixel(13.0 + 31.0 * i, 1190.0 - 23.0 * i);
    Vec2 ray;
    Vec2 again;
    ASSERT_TRUE(plain.undistort_pixel(pixel, ray));
    ASSERT_TRUE(used.undistort_pixel(pixel, again));
    EXPECT_EQ(ray, again);
    EXPECT_EQ(plain.distort(ray), used.distort(ray));
  }
}

TEST(FurtherDistortion, LensesThatHoldNowhereNearTheCornersAreRefused) {
  LensModel pole = test::phone_lens();
  pole.further.is_used = true;
  pole.further.k4 = -8.0;  // the denominator is 0 at r = 0.35
  EXPECT_FALSE(validate(pole).ok());
  LensModel prism = test::phone_lens();
  prism.further.is_used = true;
  prism.further.s1 = 3.0;
  EXPECT_FALSE(validate(prism).ok());
  LensModel unknown = test::phone_lens();
  unknown.further.is_used = true;
  unknown.further.k5 = std::nan("");
  EXPECT_FALSE(validate(unknown).ok());
}

}  // namespace
}  // namespace traygauge
