// Heights by outlines of solids whose outlines have closed forms, from random views.
#include "core/stereo/outline_height.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "core/base/units.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr double kFloorMm = 5.0;
constexpr std::uint8_t kSolid = 2;
constexpr std::uint8_t kNeighbour = 3;

struct Ray {
  Vec3 eye_mm;
  Vec3 direction;
};

// An upright ellipsoid that stands on the plane.
struct Ellipsoid {
  Vec3 half_axes_mm;

  double height_mm() const { return 2.0 * half_axes_mm.z(); }
  bool meets(const Ray& ray) const {
    const Vec3 eye = (ray.eye_mm - Vec3(0.0, 0.0, kFloorMm + half_axes_mm.z())).cwiseQuotient(half_axes_mm);
    const Vec3 direction = ray.direction.cwiseQuotient(half_axes_mm);
    const double middle = eye.dot(direction);
    return middle * middle >= direction.squaredNorm() * (eye.squaredNorm() - 1.0);
  }
};

// An upright cylinder that stands on the plane: a ray that meets it crosses its axis' height range inside.
struct Cylinder {
  double radius_mm;
  double top_mm;

  double height_mm() const { return top_mm; }
  bool meets(const Ray& ray) const {
    const auto steps_to = [&](double z_mm) { return (z_mm - ray.eye_mm.z()) / ray.direction.z(); };
    const Vec2 above = (ray.eye_mm + steps_to(kFloorMm + top_mm) * ray.direction).head<2>();
    const Vec2 below = (ray.eye_mm + steps_to(kFloorMm) * ray.direction).head<2>();
    const Vec2 along = below - above;
    const double share = along.squaredNorm() > 0.0 ? -above.dot(along) / along.squaredNorm() : 0.0;
    return (above + std::clamp(share, 0.0, 1.0) * along).norm() <= radius_mm;
  }
};

Vec3 eye_at(double tilt_deg, double azimuth_deg, double distance_mm) {
  const double tilt = tilt_deg * kRadiansPerDegree;
  const double azimuth = azimuth_deg * kRadiansPerDegree;
  return distance_mm *
         Vec3(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
}

// Both views' labels of solids on a plate without a rim.
class OutlinedSolids {
 public:
  explicit OutlinedSolids(const std::array<Vec3, 2>& eyes_mm) : eyes_mm_(eyes_mm) {
    for (std::size_t v = 0; v < 2; ++v) {
      StoredView& view = views_[v];
      view.lens = test::phone_lens(0.25);
      view.camera_from_table = test::looking_at(eyes_mm[v], {0.0, 0.0, kFloorMm}, 0.3);
      labels_[v] = cv::Mat1b(view.lens.height, view.lens.width, kDishLabel);
      view.gray = view.labels = test::view_of(labels_[v]);
      view.dish = {0, 0, labels_[v].cols, labels_[v].rows};
    }
  }
  // Behind those that are there.
  template <class Solid>
  void add(std::uint8_t label, const Solid& solid) {
    for (std::size_t v = 0; v < 2; ++v) {
      const Pose table_from_camera = views_[v].camera_from_table.inverse();
      for (int y = 0; y < labels_[v].rows; ++y) {
        for (int x = 0; x < labels_[v].cols; ++x) {
          Vec2 ray;
          ASSERT_TRUE(views_[v].lens.undistort_pixel({static_cast<double>(x), static_cast<double>(y)}, ray));
          const Vec3 through_mm = table_from_camera * Vec3(ray.x(), ray.y(), 1.0);
          if (labels_[v](y, x) == kDishLabel && solid.meets({eyes_mm_[v], through_mm - eyes_mm_[v]}))
            labels_[v](y, x) = label;
        }
      }
    }
  }
  double height_mm() {
    PlaneRectification grid;
    const LabelTable kept = labels_on_dish(labels_of_single_dish());
    EXPECT_TRUE(grid.build(views_, kept, kFloorMm, params_, rows_).ok());
    std::array<cv::Mat1b, 2> sampled;
    for (std::size_t v = 0; v < 2; ++v) {
      sampled[v] = cv::Mat1b(grid.rows(), grid.columns());
      grid.sample_labels(views_[v], kept, test::view_of(sampled[v]));
    }
    return height_by_outlines_mm(grid, {test::view_of(sampled[0]), test::view_of(sampled[1])});
  }

 private:
  std::array<Vec3, 2> eyes_mm_;
  PlaneRectificationParams params_;
  std::array<StoredView, 2> views_;
  std::array<cv::Mat1b, 2> labels_;
  std::vector<PlaneRow> rows_ = std::vector<PlaneRow>(static_cast<std::size_t>(params_.max_rows));
};

class RandomViews {
 public:
  double between(double least, double most) { return std::uniform_real_distribution(least, most)(random_); }
  std::array<Vec3, 2> eyes() {
    const double azimuth_deg = between(0.0, 360.0);
    const double tilt_deg = between(15.0, 40.0);
    const double apart_deg = between(15.0, 25.0) / std::sin(tilt_deg * kRadiansPerDegree);
    return {eye_at(tilt_deg, azimuth_deg, between(400.0, 550.0)),
            eye_at(tilt_deg, azimuth_deg + apart_deg, between(400.0, 550.0))};
  }

 private:
  std::mt19937 random_{test::random_seed()};
};

// Its middle is half as high, but for the rows of a body that is no ball, whose sections stand aslant.
TEST(OutlineHeight, OfWholeFruit) {
  RandomViews random;
  for (int i = 0; i < 20; ++i) {
    const double half_width_mm = random.between(25.0, 55.0);
    const Vec3 shape{random.between(0.8, 1.2), random.between(0.8, 1.2), random.between(0.8, 1.2)};
    const Ellipsoid fruit{half_width_mm * shape};
    OutlinedSolids outlined(random.eyes());
    outlined.add(kSolid, fruit);
    EXPECT_GE(outlined.height_mm(), 0.97 * fruit.height_mm()) << fruit.half_axes_mm.transpose();
    EXPECT_LE(outlined.height_mm(), 1.08 * fruit.height_mm()) << fruit.half_axes_mm.transpose();
  }
}

// Of walls, rows show what is between the foot and the edge.
TEST(OutlineHeight, OfUprightWallsIsEnough) {
  RandomViews random;
  for (int i = 0; i < 20; ++i) {
    const Cylinder roll{random.between(25.0, 55.0), random.between(40.0, 120.0)};
    OutlinedSolids outlined(random.eyes());
    outlined.add(kSolid, roll);
    EXPECT_GE(outlined.height_mm(), roll.height_mm()) << roll.radius_mm;
    EXPECT_LE(outlined.height_mm(), 2.0 * roll.height_mm()) << roll.radius_mm;
  }
}

TEST(OutlineHeight, OfAFlatDisc) {
  RandomViews random;
  OutlinedSolids outlined(random.eyes());
  outlined.add(kSolid, Cylinder{60.0, 0.1});
  EXPECT_LT(outlined.height_mm(), 4.0);
}

TEST(OutlineHeight, IsUnknownOfAnItemWithinAnother) {
  RandomViews random;
  OutlinedSolids outlined(random.eyes());
  outlined.add(kSolid, Ellipsoid{{20.0, 20.0, 20.0}});
  EXPECT_GT(outlined.height_mm(), 39.0);
  outlined.add(kNeighbour, Cylinder{70.0, 0.1});
  EXPECT_LT(outlined.height_mm(), 4.0);
}

}  // namespace
}  // namespace traygauge
