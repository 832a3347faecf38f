// The dish surface from true poses and labels of rendered captures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>

#include "core/dish/rim_ellipse.hpp"
#include "core/paper/surface/dish_surface.hpp"
#include "core/paper/surface/rim.hpp"
#include "tests/core/stereo/capture_scene.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge::paper {
namespace {

using test::Allocated;
using test::CaptureScene;

struct CardNoise {
  double sigma_px = 0.3;  // of a matched point in the working pictures
  int points = 60;
};

struct Rates {
  std::vector<double> tilt_deg;
  std::vector<double> offset_mm;
  std::vector<double> height_mm;  // measured rim height − true rim height
  std::vector<double> size_mm;
  int failures = 0;
  int wrong_dish = 0;
  double points = 0.0;
  double rms_mm = 0.0;

  static double quantile(std::vector<double> values, double share) {
    if (values.empty()) return -1.0;
    for (double& v : values) v = std::abs(v);
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  }
  static double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
  }
  void print(const char* what) const {
    std::printf(
        "%-58s tilt %.3f / %.3f deg  bottom %.3f / %.3f mm (bias %+.3f)  rim height bias %+.2f mm  size bias "
        "%+.2f max %.2f mm  wrong dish %d  failed %d  points %.0f rms %.2f\n",
        what, quantile(tilt_deg, 0.5), quantile(tilt_deg, 1.0), quantile(offset_mm, 0.5),
        quantile(offset_mm, 1.0), mean(offset_mm), mean(height_mm), mean(size_mm), quantile(size_mm, 1.0),
        wrong_dish, failures, points / static_cast<double>(tilt_deg.size()),
        rms_mm / static_cast<double>(tilt_deg.size()));
  }
};

const std::vector<CaptureScene>& scenes() {
  static const std::vector<CaptureScene> loaded = [] {
    std::vector<CaptureScene> all;
    for (const std::string& name : test::single_dish_captures()) all.push_back(test::load_scene(name));
    return all;
  }();
  return loaded;
}

const std::array<DishCandidate, 4> kDishes{
    {{{260, 260}, 22}, {{300, 210}, 24}, {{230, 230}, 40}, {{152, 152}, 55}}};

// Points all over the card, triangulated from places with noise, as a matcher would deliver them.
std::vector<Vec3> card_points(const CaptureScene& scene, const CameraPair& cameras,
                              const Pose& first_from_world, const CardNoise& noise, std::mt19937& generator) {
  std::normal_distribution<double> normal(0.0, noise.sigma_px);
  std::uniform_real_distribution<double> uniform(0.05, 0.95);
  std::vector<Vec3> points;
  for (int i = 0; i < noise.points; ++i) {
    const auto& corners = scene.card_corners_mm;
    const Vec3 world = corners[0] + uniform(generator) * (corners[1] - corners[0]) +
                       uniform(generator) * (corners[3] - corners[0]);
    const Vec3 in_first = first_from_world * world;
    const Vec3 in_second = cameras.second_from_first * in_first;
    const auto noisy_ray = [&](const PinholeCamera& camera, const Vec3& point) {
      const Vec2 pixel =
          camera.pixel(point.head<2>() / point.z()) + Vec2(normal(generator), normal(generator));
      return camera.ray(pixel).homogeneous().eval();
    };
    const Vec3 ray = noisy_ray(cameras.first, in_first);
    double z = 0.0;
    if (triangulate_depth(cameras.second_from_first.rotation * ray, noisy_ray(cameras.second, in_second),
                          cameras.second_from_first.translation, z)) {
      points.emplace_back(z * ray);
    }
  }
  return points;
}

struct Setting {
  RimParams rim;
  DishParams dish;
  CardNoise card;
  double label_noise_px = 0.0;
};

cv::Mat1b roughen(const cv::Mat1b& labels, double sigma_px, std::uint64_t seed) {
  if (sigma_px == 0.0) return labels;
  cv::RNG generator(seed);
  cv::Mat1f dx(labels.size());
  cv::Mat1f dy(labels.size());
  for (cv::Mat1f* d : {&dx, &dy}) {
    generator.fill(*d, cv::RNG::NORMAL, 0.0, 1.0);
    cv::GaussianBlur(*d, *d, cv::Size(), 4.0);
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(*d, mean, deviation);
    *d *= sigma_px / deviation[0];
  }
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      dx(y, x) += static_cast<float>(x);
      dy(y, x) += static_cast<float>(y);
    }
  }
  cv::Mat1b moved;
  cv::remap(labels, moved, dx, dy, cv::INTER_NEAREST);
  return moved;
}

Rates measure(const Setting& setting, bool print = false) {
  Allocated<RimWorkspace> rim(std::size_t{8192}, std::size_t{4096});
  Allocated<DishWorkspace> dish(std::size_t{4096});
  Rates rates;
  for (const CaptureScene& scene : scenes()) {
    for (const auto& [a, b] : scene.pairs) {
      const auto& first = scene.views[static_cast<std::size_t>(a)];
      const auto& second = scene.views[static_cast<std::size_t>(b)];
      const Pose second_from_first{
          second.camera_from_world.rotation * first.camera_from_world.rotation.transpose(),
          second.camera_from_world * first.camera_from_world.inverse().translation};
      const cv::Mat1b first_labels = roughen(first.labels, setting.label_noise_px, 1);
      const cv::Mat1b second_labels = roughen(second.labels, setting.label_noise_px, 2);
      const RimInput input{test::view_of(first_labels),
                           test::view_of(second_labels),
                           {first.camera, second.camera, second_from_first}};
      Random random(1);
      PlaneFit fit;
      if (!collect_rim_points(input, setting.rim, *rim).ok() ||
          !fit_rim_plane(second_from_first, setting.rim, random, rim->points_mm, fit).ok()) {
        ++rates.failures;
        continue;
      }
      std::mt19937 generator(11);
      std::vector<Vec3> card =
          card_points(scene, input.cameras, first.camera_from_world, setting.card, generator);
      Plane card_plane;
      EXPECT_TRUE(fit_plane_least_squares(card, card_plane));
      const DishInput dish_input{fit.plane,
                                 rim->points_mm.items().first(static_cast<std::size_t>(fit.inliers)),
                                 card_plane.raised(-scene.card_thickness_mm), card, scene.card_thickness_mm};
      double rim_height = 0.0;
      EXPECT_TRUE(measure_rim_height(dish_input, setting.dish, *dish, rim_height).ok());
      const Plane bottom = place_dish_bottom(dish_input, setting.dish, rim_height, scene.bottom_height_mm);
      const Plane truth =
          test::plane_in_camera({Vec3::UnitZ(), scene.bottom_height_mm}, first.camera_from_world);
      const Vec3 centre = first.camera_from_world * Vec3(0, 0, scene.bottom_height_mm);
      const double tilt = std::asin(bottom.normal.cross(truth.normal).norm()) * 180 / CV_PI;
      rates.tilt_deg.push_back(tilt);
      rates.offset_mm.push_back(-bottom.height(centre));
      rates.height_mm.push_back(rim_height - scene.rim_height_mm);
      rates.points += fit.inliers;
      rates.rms_mm += fit.rms_mm;
      const Result<RimEllipse> ellipse = fit_rim_size(rim->points_mm.items(), fit.plane);
      EXPECT_TRUE(ellipse.ok());
      rates.size_mm.push_back(ellipse->size_mm[0] - scene.outer_size_mm[0]);
      rates.size_mm.push_back(ellipse->size_mm[1] - scene.outer_size_mm[1]);
      const int chosen = choose_dish(kDishes, ellipse->size_mm, rim_height, {});
      if (chosen < 0 || kDishes[static_cast<std::size_t>(chosen)].rim_height_mm != scene.rim_height_mm)
        ++rates.wrong_dish;
      if (print) {
        std::printf(
            "%-17s %d-%d  tilt %.3f deg  offset %+.3f mm  rim height %.2f (%.1f)  size %.1f x %.1f  %d of "
            "%zu points rms %.2f mm, direction to %.3f deg\n",
            scene.name.c_str(), a, b, tilt, rates.offset_mm.back(), rim_height, scene.rim_height_mm,
            ellipse->size_mm[0], ellipse->size_mm[1], fit.inliers, rim->points_mm.size(), fit.rms_mm,
            tilt_sigma_rad(fit, setting.rim) * 180 / CV_PI);
      }
    }
  }
  return rates;
}

class CaptureRim : public ::testing::Test {
 protected:
  void SetUp() override {
    if (test::captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  }
};

TEST_F(CaptureRim, ContourGivesTheBottomWithinHalfAMillimetreForAnExactCard) {
  Setting setting;
  setting.card.sigma_px = 0.0;
  const Rates rates = measure(setting, true);
  rates.print("contour, exact card");
  EXPECT_EQ(rates.failures, 0);
  EXPECT_EQ(rates.wrong_dish, 0);
  EXPECT_LT(Rates::quantile(rates.tilt_deg, 0.5), 0.1);
  EXPECT_LT(Rates::quantile(rates.tilt_deg, 1.0), 0.3);
  EXPECT_LT(Rates::quantile(rates.offset_mm, 0.5), 0.15);
  EXPECT_LT(Rates::quantile(rates.offset_mm, 1.0), 0.6);
  EXPECT_LT(Rates::quantile(rates.size_mm, 1.0), 0.5);
}

TEST_F(CaptureRim, TheNearSidesWallTiltsThePlaneUnlessItIsLeftOut) {
  Setting whole;
  whole.rim.max_edge_sigma_rad = 0.0;
  const Rates with_wall = measure(whole);
  with_wall.print("contour, whole border");
  EXPECT_LT(Rates::quantile(measure({}).tilt_deg, 0.5), 0.5 * Rates::quantile(with_wall.tilt_deg, 0.5));
}

TEST_F(CaptureRim, TheRimsNormalBeatsTheCards) {
  Setting setting;  // card points with noise
  const Rates with_rim = measure(setting);
  with_rim.print("card 0.3 px: card points under the rim plane");
  setting.dish.surface = DishSurface::card_alone;
  const Rates alone = measure(setting);
  alone.print("card 0.3 px: card alone");
  EXPECT_EQ(with_rim.wrong_dish, 0);
  EXPECT_LT(Rates::quantile(with_rim.offset_mm, 0.5), 0.3);
  EXPECT_LT(Rates::quantile(with_rim.offset_mm, 0.5), 0.3 * Rates::quantile(alone.offset_mm, 0.5));
  EXPECT_LT(Rates::quantile(with_rim.tilt_deg, 0.5), 0.2 * Rates::quantile(alone.tilt_deg, 0.5));
}

TEST_F(CaptureRim, RoughLabelsCostPrecisionNotTheRim) {
  Setting setting;
  setting.card.sigma_px = 0.0;
  setting.label_noise_px = 0.5;
  const Rates rates = measure(setting);
  rates.print("border moved by 0.5 px");
  EXPECT_EQ(rates.failures, 0);
  EXPECT_EQ(rates.wrong_dish, 0);
  EXPECT_LT(Rates::quantile(rates.tilt_deg, 0.5), 0.6);
  EXPECT_LT(Rates::quantile(rates.tilt_deg, 1.0), 2.0);
}

}  // namespace
}  // namespace traygauge::paper
