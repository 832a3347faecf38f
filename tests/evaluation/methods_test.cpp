// Table VI's methods on solids whose volume is known in closed form, seen by made-up cameras.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tests/core/paper/motion_scenes.hpp"
#include "tests/evaluation/methods/height_sweep.hpp"
#include "tests/evaluation/methods/single_view.hpp"
#include "tests/evaluation/methods/solid.hpp"
#include "tests/evaluation/methods/sparse_views.hpp"
#include "tests/evaluation/tables/paper_tables.hpp"

namespace traygauge::tables {
namespace {

constexpr int kWidth = 360;
constexpr int kHeight = 300;
constexpr PinholeCamera kCamera{900.0, 900.0, 180.0, 150.0};
constexpr double kRadians = std::numbers::pi / 180.0;

double height_at(const Solid& solid, const Vec2& place) {
  return solid.height_mm * relative_height(solid, place);
}

Solid example(Template shape) {
  return {shape, {6.0, -4.0}, {45.0, 32.0}, 0.4, 24.0};
}

Pose camera_from_dish(double tilt_deg, double azimuth_deg) {
  return traygauge::test::camera_above(tilt_deg * kRadians, azimuth_deg * kRadians, 480.0);
}

// Where the line of sight of a pixel first meets the solid, or the plane: steps along the ray, then
// bisection.
Vec3 first_hit(const Solid& solid, const Pose& camera, const Vec2& pixel) {
  const Pose dish_from_camera = camera.inverse();
  const Vec3 sight = dish_from_camera.rotation * kCamera.ray(pixel).homogeneous();
  const Vec3& eye = dish_from_camera.translation;
  const auto at_height = [&](double z) { return Vec3(eye + sight * ((z - eye.z()) / sight.z())); };
  constexpr int kSteps = 60;
  double above = solid.height_mm * 1.001;
  for (int i = 1; i <= kSteps; ++i) {
    double below = solid.height_mm * 1.001 * (1.0 - static_cast<double>(i) / kSteps);
    if (at_height(below).z() > height_at(solid, at_height(below).head<2>())) {
      above = below;
      continue;
    }
    for (int k = 0; k < 16; ++k) {
      const double middle = 0.5 * (above + below);
      (middle > height_at(solid, at_height(middle).head<2>()) ? above : below) = middle;
    }
    return at_height(below);
  }
  return at_height(0.0);
}

bool lies_on(const Solid& solid, const Vec3& point) {
  return point.z() > 1e-6 || relative_height(solid, point.head<2>()) > 0.0;
}

ItemView seen(const Solid& solid, const Pose& camera) {
  ItemView view{kCamera, camera, cv::Mat::zeros(kHeight, kWidth, CV_8UC1)};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x)
      if (lies_on(solid, first_hit(solid, camera, Vec2(x, y)))) view.mask.at<std::uint8_t>(y, x) = 255;
  }
  return view;
}

TEST(Solids, VolumesAreTheIntegralsOfTheirHeights) {
  for (const Template shape : kTemplates) {
    const Solid solid = example(shape);
    constexpr double kStep_mm = 0.25;
    double sum = 0.0;
    for (double y = -80.0; y < 80.0; y += kStep_mm) {
      for (double x = -80.0; x < 80.0; x += kStep_mm) sum += height_at(solid, {x, y});
    }
    const double integral_ml = 1e-3 * sum * kStep_mm * kStep_mm;
    EXPECT_NEAR(volume_ml(solid), integral_ml, 0.004 * integral_ml) << static_cast<int>(shape);
  }
}

TEST(Solids, AreFoundByTheirSilhouette) {
  for (const Template shape : kTemplates) {
    const Solid solid = example(shape);
    const ItemView view = seen(solid, camera_from_dish(25.0, 70.0));
    const SilhouetteFit fit = fit_silhouette(view, shape, [&](double) { return solid.height_mm; });
    EXPECT_GT(fit.overlap, 0.96) << static_cast<int>(shape);
    EXPECT_NEAR(volume_ml(fit.solid), volume_ml(solid), 0.05 * volume_ml(solid)) << static_cast<int>(shape);
    EXPECT_LT((fit.solid.centre_mm - solid.centre_mm).norm(), 1.5) << static_cast<int>(shape);
  }
}

TEST(SingleView, ChoosesTheShapeAndKeepsItsProportions) {
  const ShapePriors priors;
  for (const Template shape : {Template::cap, Template::box}) {
    Solid solid = example(shape);
    const double ratio = shape == Template::box ? priors.box_height : priors.cap_height;
    solid.height_mm = ratio * std::sqrt(footprint_mm2(solid));
    const SilhouetteFit fit = fit_prior(seen(solid, camera_from_dish(20.0, 200.0)), priors);
    EXPECT_EQ(fit.solid.shape, shape);
    EXPECT_NEAR(volume_ml(fit.solid), volume_ml(solid), 0.06 * volume_ml(solid));
  }
}

std::vector<Vec3> cloud_on(const Solid& solid, int count, double noise_mm, double outlier_fraction,
                           std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points;
  while (static_cast<int>(points.size()) < count) {
    const Vec2 place =
        solid.centre_mm + Vec2(50.0 * (2.0 * random.uniform() - 1.0), 50.0 * (2.0 * random.uniform() - 1.0));
    if (relative_height(solid, place) <= 0.0) continue;
    double z = height_at(solid, place) + noise_mm * traygauge::test::normal(random);
    if (random.uniform() < outlier_fraction) z += 60.0 + 100.0 * random.uniform();
    points.emplace_back(place.x(), place.y(), z);
  }
  return points;
}

TEST(Templates, FitACloudWithOutliers) {
  for (const Template shape : kTemplates) {
    const Solid solid = example(shape);
    const ItemView view = seen(solid, camera_from_dish(20.0, 30.0));
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto found = fit_template(view, cloud_on(solid, 60, 0.5, 0.15, seed), {});
      ASSERT_TRUE(found) << static_cast<int>(shape) << " seed " << seed;
      EXPECT_NEAR(volume_ml(*found), volume_ml(solid), 0.1 * volume_ml(solid))
          << static_cast<int>(shape) << " seed " << seed;
    }
  }
}

TEST(Templates, NeedPointsAboveTheDish) {
  const Solid solid = example(Template::cap);
  const ItemView view = seen(solid, camera_from_dish(20.0, 30.0));
  EXPECT_FALSE(fit_template(view, cloud_on(solid, 5, 0.5, 0.0, 1), {}));
  std::vector<Vec3> below = cloud_on(solid, 40, 0.5, 0.0, 1);
  for (Vec3& point : below) point.z() -= 60.0;
  EXPECT_FALSE(fit_template(view, below, {}));
}

// Blobs of 3 mm, fixed to the surface.
double brightness(const Vec2& place) {
  static const cv::Mat noise = [] {
    cv::Mat picture(400, 400, CV_32F);
    cv::RNG random(5);
    random.fill(picture, cv::RNG::UNIFORM, 0.0, 255.0);
    cv::GaussianBlur(picture, picture, {0, 0}, 2.0);
    cv::normalize(picture, picture, 0.0, 255.0, cv::NORM_MINMAX);
    return picture;
  }();
  cv::Mat sample;
  cv::getRectSubPix(
      noise, {1, 1},
      cv::Point2f(static_cast<float>(200.0 + 2.0 * place.x()), static_cast<float>(200.0 + 2.0 * place.y())),
      sample);
  return static_cast<double>(sample.at<float>(0, 0));
}

SweepView render(const Solid& solid, const Pose& camera) {
  SweepView view{kCamera, camera, cv::Mat(kHeight, kWidth, CV_8UC1)};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double value = brightness(first_hit(solid, camera, Vec2(x, y)).head<2>());
      view.gray.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(value);
    }
  }
  return view;
}

TEST(HeightSweep, MeasuresAHeap) {
  const Solid solid = example(Template::cap);
  const SweepView first = render(solid, camera_from_dish(8.0, 0.0));
  const SweepView second = render(solid, camera_from_dish(12.0, 180.0));
  const SweepParams params;
  const cv::Mat heights = filter_heights(sweep_heights(first, second, params), first,
                                         sweep_heights(second, first, params), second, params);
  const cv::Mat mask = seen(solid, first.camera_from_dish).mask;
  EXPECT_NEAR(volume_under_ml(heights, mask, first), volume_ml(solid), 0.05 * volume_ml(solid));
  const cv::Mat nothing(heights.size(), CV_32F, cv::Scalar(std::nan("")));
  EXPECT_TRUE(std::isnan(volume_under_ml(nothing, mask, first)));
}

TEST(PaperTables, EveryVariantHasSettingsThatHold) {
  const std::vector<std::uint8_t> print(200 * 126);
  const std::vector<DishModel> dishes = {{{260.0, 260.0}, 25.0, 3.0}};
  for (const Table& table : paper_tables()) {
    for (const Row& row : table.rows) {
      paper::Configuration configuration = configure(row.variant).paper;
      configuration.lens = traygauge::test::phone_lens();
      configuration.card.pattern = {print.data(), 200, 126};
      configuration.dishes = dishes;
      EXPECT_TRUE(paper::validate(configuration).ok()) << row.title;
    }
  }
}

}  // namespace
}  // namespace traygauge::tables
