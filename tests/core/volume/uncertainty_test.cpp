// Sigma against what it stands for: food is measured with errors of known size, and sigma must say how often
// how much comes of them.
#include "core/volume/uncertainty.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <random>
#include <vector>

#include "tests/support/allocated.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kSureItem = 3;

// Two cameras that look straight down, so that a height h lies at a disparity of f b / (H − h).
constexpr double kEyeMm = 500.0;
constexpr double kBaseMm = 150.0;
constexpr double kFocalPx = 1200.0;

TableCameras cameras_above() {
  TableCameras cameras;
  for (std::size_t v = 0; v < 2; ++v) {
    cameras[v].rotation = Vec3(1.0, -1.0, -1.0).asDiagonal();
    cameras[v].translation = Vec3(v == 0 ? 0.0 : -kBaseMm, 0.0, kEyeMm);
  }
  return cameras;
}

double disparity_px(double z_mm) {
  return kFocalPx * kBaseMm / (kEyeMm - z_mm);
}
double height_at_mm(double disparity) {
  return kEyeMm - kFocalPx * kBaseMm / disparity;
}

// The errors of one measurement, each of which lies over a whole item.
struct MeasuredWith {
  double disparity_px = 0.0;
  double height_mm = 0.0;
  double wall_mm = 0.0;     // that a wall stands further out
  double outline_mm = 0.0;  // that the outline lies further out
};

// Food on a flat dish as a height map: a height for every distance from its middle, out to its radius.
class MeasuredFood {
 public:
  static constexpr int kSide = 200;
  static constexpr double kCellMm = 0.5;

  MeasuredFood() {
    DishModel model;
    model.outer_size_mm = {300.0, 300.0};
    EXPECT_TRUE(dish_.profile.set(model).ok());
    map_.cells = {cells_.data(), kSide, kSide};
    map_.cell_mm = kCellMm;
    map_.origin_mm = Vec2::Constant(-0.5 * kCellMm * (kSide - 1));
  }

  template <class HeightOf>
  const HeightVolume& measure(double radius_mm, HeightOf&& height_of, const MeasuredWith& off) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        HeightCell& cell = map_.cells.at(x, y);
        const Vec2 at = map_.centre_mm(x, y);
        cell = {.label = kDishLabel, .kind = CellKind::surface, .weight = 255};
        if (at.norm() >= radius_mm + off.outline_mm) continue;
        const double z_mm = at.norm() < radius_mm ? height_of(at, off.wall_mm) : 0.0;
        cell.label = kSureItem;
        cell.z_mm = static_cast<float>(height_at_mm(disparity_px(z_mm) + off.disparity_px) + off.height_mm);
      }
    }
    EXPECT_TRUE(integrate_height_map(map_, dish_, {}, *space_).ok());
    return space_->items[kSureItem];
  }

 private:
  InnerSurface dish_;
  std::vector<HeightCell> cells_{std::size_t{kSide} * kSide};
  HeightMap map_;
  test::Allocated<HeightVolumeWorkspace> space_;
};

UncertaintyInput input_of(const HeightVolume& volume) {
  UncertaintyInput input;
  input.volume = volume;
  const double range_mm = kEyeMm - volume.mean_height_mm;
  input.height_per_px_mm = range_mm * range_mm / (kFocalPx * kBaseMm);
  input.px_mm = range_mm / kFocalPx;
  return input;
}

// Normal errors are within one sigma in 68 and within two in 95 of 100, give or take what chance does.
void expect_normal(int within_one, int within_two, int count) {
  const auto near = [&](int within, double share) {
    EXPECT_NEAR(within, share * count, 5.0 * std::sqrt(share * (1.0 - share) * count));
  };
  near(within_one, std::erf(1.0 / std::numbers::sqrt2));
  near(within_two, std::erf(2.0 / std::numbers::sqrt2));
}

// A tower on a dome: everything that errs does so over the whole item.
TEST(Uncertainty, CoversDisparityHeightAndWallsAsOftenAsItSays) {
  std::mt19937 random(test::random_seed());
  std::normal_distribution<double> normal;
  UncertaintyParams params;
  params.disparity_bias_px = 0.2;
  params.height_mm = 0.3;
  params.wall_mm = 1.0;     // two cells: that walls fall upon whole cells is little beside it
  params.outline_px = 0.0;  // not in error here
  const auto dome_and_tower = [](const Vec2& at, double wall_mm) {
    const double dome_mm = 18.0 * (1.0 - at.squaredNorm() / (45.0 * 45.0));
    return dome_mm + (at.cwiseAbs().maxCoeff() < 20.0 + wall_mm ? 25.0 : 0.0);
  };
  MeasuredFood food;
  const double truth_ml = food.measure(45.0, dome_and_tower, {}).volume_ml;
  ASSERT_NEAR(truth_ml, (0.5 * std::numbers::pi * 45.0 * 45.0 * 18.0 + 40.0 * 40.0 * 25.0) / 1000.0, 1.0);
  constexpr int kCount = 1500;
  int within_one = 0;
  int within_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const MeasuredWith off{params.disparity_bias_px * normal(random), params.height_mm * normal(random),
                           params.wall_mm * normal(random), 0.0};
    const HeightVolume& volume = food.measure(45.0, dome_and_tower, off);
    const double sigma_ml =
        estimate_sigma_ml(input_of(volume), cameras_above(), BundleMatrix::Zero(), params);
    const double error_ml = std::abs(volume.volume_ml - truth_ml);
    within_one += error_ml <= sigma_ml ? 1 : 0;
    within_two += error_ml <= 2.0 * sigma_ml ? 1 : 0;
  }
  expect_normal(within_one, within_two, kCount);
}

// A dish whose shape is not known is off under the whole item alike.
TEST(Uncertainty, OfADishIsThatOfTheItemsArea) {
  constexpr double kDishSigmaMm = 6.0;
  MeasuredFood food;
  const HeightVolume volume = food.measure(40.0, [](const Vec2&, double) { return 20.0; }, {});
  UncertaintyInput input = input_of(volume);
  const double known_ml = estimate_sigma_ml(input, cameras_above(), BundleMatrix::Zero(), {});
  input.dish_sigma_mm = kDishSigmaMm;
  const double unknown_ml = estimate_sigma_ml(input, cameras_above(), BundleMatrix::Zero(), {});
  EXPECT_NEAR(unknown_ml, std::hypot(known_ml, kDishSigmaMm * volume.area_mm2 / 1000.0), 1e-6);
}

// What an outline is off by costs a drum all of its side, a cone next to nothing: sigma lies between the two,
// since it knows a mean height alone. Drawn or found, it is so many mm.
TEST(Uncertainty, OfAnOutlineLiesBetweenThatOfADrumAndOfACone) {
  constexpr double kOffMm = 1.5;
  constexpr double kRadiusMm = 40.0;
  std::mt19937 random(test::random_seed());
  std::normal_distribution<double> normal(0.0, kOffMm);
  const auto drum = [](const Vec2&, double) { return 20.0; };
  const auto cone = [](const Vec2& at, double) { return 60.0 * (1.0 - at.norm() / kRadiusMm); };
  MeasuredFood food;
  UncertaintyParams params;
  params.disparity_bias_px = params.height_mm = params.wall_mm = 0.0;
  for (const bool is_found : {false, true}) {
    params.found_outline_mm = kOffMm;
    const auto over_sigma = [&](auto&& height_of) {
      const HeightVolume truth = food.measure(kRadiusMm, height_of, {});
      UncertaintyInput input = input_of(truth);
      params.outline_px = is_found ? 0.0 : kOffMm / input.px_mm;
      input.is_outline_found = is_found;
      const double sigma_ml = estimate_sigma_ml(input, cameras_above(), BundleMatrix::Zero(), params);
      double squares = 0.0;
      constexpr int kCount = 400;
      for (int i = 0; i < kCount; ++i) {
        const double error_ml =
            food.measure(kRadiusMm, height_of, {.outline_mm = normal(random)}).volume_ml - truth.volume_ml;
        squares += error_ml * error_ml / kCount;
      }
      return std::sqrt(squares) / sigma_ml;
    };
    const double of_drum = over_sigma(drum);
    EXPECT_GT(of_drum, 1.1) << is_found;  // half of all outlines lie too far in: 2 / sqrt(2)
    EXPECT_LT(of_drum, 1.75) << is_found;
    EXPECT_LT(over_sigma(cone), 0.3) << is_found;
  }
}

// Cameras move as their covariance says, and OpenCV triangulates what they see from where they are believed.
TEST(Uncertainty, CoversCamerasThatAreNotWhereTheyAreBelieved) {
  const std::uint32_t seed = test::random_seed();
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const TableCameras cameras = {test::camera_above(0.25, 0.3, 480.0), test::camera_above(0.3, 2.9, 500.0)};
  const Vec3 point(12.0, -25.0, 18.0);
  Eigen::Matrix<double, 12, 12> spread;  // that steps of turn (radians) and shift (mm) share
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) spread(i, j) = normal(random) * (i % 6 < 3 ? 2e-4 : 0.08);
  }
  BundleMatrix covariance = BundleMatrix::Zero();
  covariance.topLeftCorner<12, 12>() = spread * spread.transpose();
  const double sigma_mm = height_sigma_mm(point, cameras, covariance);
  ASSERT_GT(sigma_mm, 0.0);
  const auto matrix_of = [](const Pose& camera) {
    cv::Matx34d matrix;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) matrix(i, j) = camera.rotation(i, j);
      matrix(i, 3) = camera.translation[i];
    }
    return matrix;
  };
  constexpr int kCount = 4000;
  int within_one = 0;
  int within_two = 0;
  for (int i = 0; i < kCount; ++i) {
    Eigen::Matrix<double, 12, 1> draw;
    for (double& value : draw) value = normal(random);
    draw = (spread * draw).eval();
    std::array<cv::Mat1d, 2> seen;
    TableCameras believed;
    for (std::size_t v = 0; v < 2; ++v) {
      believed[v] = moved(cameras[v], draw.segment<6>(6 * static_cast<int>(v)));
      const Vec2 ray = (cameras[v] * point).hnormalized();
      seen[v] = (cv::Mat1d(2, 1) << ray.x(), ray.y());
    }
    cv::Mat1d found;
    cv::triangulatePoints(matrix_of(believed[0]), matrix_of(believed[1]), seen[0], seen[1], found);
    const double error_mm = std::abs(found(2) / found(3) - point.z());
    within_one += error_mm <= sigma_mm ? 1 : 0;
    within_two += error_mm <= 2.0 * sigma_mm ? 1 : 0;
  }
  expect_normal(within_one, within_two, kCount);
}

TEST(Uncertainty, NothingHasNone) {
  EXPECT_EQ(estimate_sigma_ml({}, cameras_above(), BundleMatrix::Zero(), {}), 0.0);
}

}  // namespace
}  // namespace traygauge
