#include "core/geometry/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>

#include "core/base/random.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/opencv_camera.hpp"

namespace traygauge {
namespace {

using test::camera_matrix;
using test::distortion_of;
using test::phone_lens;

class LensAgainstOpenCv : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  LensModel random_lens() {
    LensModel lens = phone_lens();
    const auto spread = [&](double range) { return range * (2.0 * random_.uniform() - 1.0); };
    lens.pinhole.fx_px = 1200.0 + 800.0 * random_.uniform();
    lens.pinhole.fy_px = lens.pinhole.fx_px * (1.0 + spread(0.02));
    lens.k1 = spread(0.15);
    lens.k2 = spread(0.05);
    lens.p1 = spread(0.002);
    lens.p2 = spread(0.002);
    lens.k3 = spread(0.01);
    return lens;
  }
  Random random_{GetParam()};
};

TEST_P(LensAgainstOpenCv, DistortsAsProjectPoints) {
  const LensModel lens = random_lens();
  for (int i = 0; i < 200; ++i) {
    const Vec2 ray(1.2 * random_.uniform() - 0.6, random_.uniform() - 0.5);
    std::vector<cv::Point2d> projected;
    cv::projectPoints(std::vector<cv::Point3d>{{ray.x(), ray.y(), 1.0}}, cv::Vec3d(), cv::Vec3d(),
                      camera_matrix(lens.pinhole), distortion_of(lens), projected);
    const Vec2 pixel = lens.pinhole.pixel(lens.distort(ray));
    ASSERT_NEAR(pixel.x(), projected[0].x, 1e-9) << "seed " << GetParam();
    ASSERT_NEAR(pixel.y(), projected[0].y, 1e-9) << "seed " << GetParam();
  }
}

TEST_P(LensAgainstOpenCv, UndistortsAsUndistortPoints) {
  const LensModel lens = random_lens();
  ASSERT_TRUE(validate(lens).ok()) << "seed " << GetParam();
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 500, 1e-14);
  for (int i = 0; i < 200; ++i) {
    const Vec2 pixel(lens.width * random_.uniform() - 0.5, lens.height * random_.uniform() - 0.5);
    std::vector<cv::Point2d> rays;
    cv::undistortPoints(std::vector<cv::Point2d>{{pixel.x(), pixel.y()}}, rays, camera_matrix(lens.pinhole),
                        distortion_of(lens), cv::noArray(), cv::noArray(), until);
    Vec2 ray;
    ASSERT_TRUE(lens.undistort_pixel(pixel, ray)) << "seed " << GetParam();
    EXPECT_NEAR(ray.x(), rays[0].x, 1e-7) << "seed " << GetParam();
    EXPECT_NEAR(ray.y(), rays[0].y, 1e-7) << "seed " << GetParam();
    const Vec2 again = lens.pinhole.pixel(lens.distort(ray));
    ASSERT_LT((again - pixel).norm(), 1e-7) << "seed " << GetParam();
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, LensAgainstOpenCv, ::testing::Range<std::uint64_t>(1, 13));

TEST(Lens, FoldedPixelIsRefused) {
  LensModel lens = phone_lens();
  lens.p1 = lens.p2 = lens.k2 = lens.k3 = 0.0;
  lens.k1 = -0.3;  // r (1 − 0.3 r²) peaks at r = 1.054 with 0.703
  Vec2 ray;
  EXPECT_TRUE(lens.undistort_pixel(lens.pinhole.pixel({0.70, 0.0}), ray));
  EXPECT_LT(ray.x(), 1.0541);
  EXPECT_FALSE(lens.undistort_pixel(lens.pinhole.pixel({0.71, 0.0}), ray));
  EXPECT_FALSE(lens.undistort_pixel({std::nan(""), 3.0}, ray));
}

TEST(LensValidation, AcceptsCamerasOfThisWorld) {
  EXPECT_TRUE(validate(phone_lens()).ok());
  LensModel ideal = phone_lens();
  ideal.k1 = ideal.k2 = ideal.p1 = ideal.p2 = ideal.k3 = 0.0;
  EXPECT_TRUE(validate(ideal).ok());
  LensModel wide = ideal;  // 90° across with strong barrel
  wide.pinhole.fx_px = wide.pinhole.fy_px = 700.0;
  wide.k1 = -0.25;
  wide.k2 = 0.06;
  EXPECT_TRUE(validate(wide).ok());
}

struct BrokenLens {
  const char* what;
  void (*damage)(LensModel&);
};

class LensValidationRefuses : public ::testing::TestWithParam<BrokenLens> {};

TEST_P(LensValidationRefuses, BrokenLens) {
  LensModel lens = phone_lens();
  GetParam().damage(lens);
  EXPECT_EQ(validate(lens).code(), StatusCode::invalid_configuration) << GetParam().what;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
INSTANTIATE_TEST_SUITE_P(
    Each, LensValidationRefuses,
    ::testing::Values(BrokenLens{"zero focal length", [](LensModel& l) { l.pinhole.fx_px = 0.0; }},
                      BrokenLens{"negative focal length", [](LensModel& l) { l.pinhole.fy_px = -1388.0; }},
                      BrokenLens{"NaN focal length", [](LensModel& l) { l.pinhole.fy_px = kNan; }},
                      BrokenLens{"tiny focal length", [](LensModel& l) { l.pinhole.fx_px = 1e-300; }},
                      BrokenLens{"NaN centre", [](LensModel& l) { l.pinhole.cx_px = kNan; }},
                      BrokenLens{"centre outside", [](LensModel& l) { l.pinhole.cy_px = 1201.0; }},
                      BrokenLens{"infinite k1", [](LensModel& l) { l.k1 = kInfinity; }},
                      BrokenLens{"NaN k3", [](LensModel& l) { l.k3 = kNan; }},
                      BrokenLens{"radial fold", [](LensModel& l) { l.k1 = -0.9; }},
                      BrokenLens{"fold that unfolds further out",
                                 [](LensModel& l) {
                                   l.k1 = -2.0;
                                   l.k2 = 2.0;
                                 }},
                      BrokenLens{"negative k3 in pixels", [](LensModel& l) { l.k3 = -80.0; }},
                      BrokenLens{"tangential fold", [](LensModel& l) { l.p2 = 0.9; }},
                      BrokenLens{"no width", [](LensModel& l) { l.width = 0; }},
                      BrokenLens{"negative height", [](LensModel& l) { l.height = -1200; }}));

}  // namespace
}  // namespace traygauge
