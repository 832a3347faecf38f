// Whether the outlines of both views are of one scene: OpenCV projects the food into the other view.
#include "core/pipeline/food_agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/core/stereo/true_grid.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kAgreedItem = 4;
constexpr double kAgreedRadiusMm = 50.0;

// A disc of food 10 mm over the table, in both grids and both label pictures.
struct AgreementScene {
  TableCameras cameras = {test::camera_above(0.2, 0.3, 500.0), test::camera_above(0.4, 1.2, 500.0)};
  std::array<cv::Mat1b, 2> labels = {cv::Mat1b(1200, 1600, kDishLabel), cv::Mat1b(1200, 1600, kDishLabel)};
  std::array<test::TrueGrid, 2> grids = {test::TrueGrid(120, 120), test::TrueGrid(120, 120)};
  std::array<TrayView, 2> views;
  FoodAgreementParams params;

  AgreementScene() {
    for (std::size_t v = 0; v < 2; ++v) {
      views[v].lens = test::phone_lens();
      std::vector<cv::Point> outline;
      for (int i = 0; i < 360; ++i) {
        const double t = i * CV_PI / 180.0;
        const Vec3 at(kAgreedRadiusMm * std::cos(t), kAgreedRadiusMm * std::sin(t), 10.0);
        const Vec2 pixel = views[v].lens.pixel((cameras[v] * at).hnormalized());
        outline.emplace_back(cvRound(pixel.x()), cvRound(pixel.y()));
      }
      cv::fillConvexPoly(labels[v], outline, cv::Scalar(kAgreedItem));
      for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 120; ++x) {
          const Vec2 at(x - 60, y - 60);
          const std::size_t k = grids[v].index(x, y);
          grids[v].points[k] = {static_cast<float>(at.x()), static_cast<float>(at.y()), 10.0F};
          grids[v].evidence[k] = SurfaceEvidence::both;
          grids[v].labels[k] = at.norm() < kAgreedRadiusMm ? kAgreedItem : kDishLabel;
        }
      }
    }
  }
  // 1 where nothing was compared.
  double measure() {
    for (std::size_t v = 0; v < 2; ++v) views[v].labels = test::view_of(labels[v]);
    return measure_food_agreement({grids[0].view(), grids[1].view()}, {&views[0], &views[1]}, cameras,
                                  params);
  }
  void shift_labels(std::size_t view, double mm) {
    const double px = mm * views[view].lens.pinhole.mean_focal_px() / 490.0;
    cv::warpAffine(labels[view], labels[view], cv::Matx23d(1.0, 0.0, px, 0.0, 1.0, 0.0), labels[view].size(),
                   cv::INTER_NEAREST, cv::BORDER_REPLICATE);
  }
};

TEST(FoodAgreement, IsWholeWhereOutlinesAreOfOneScene) {
  AgreementScene scene;
  EXPECT_GT(scene.measure(), 0.99);
}

// Two discs whose middles lie d apart share 2 acos(d / 2r) − (d / r) sqrt(1 − (d / 2r)²) of π.
TEST(FoodAgreement, IsTheShareThatOverlapsWhereOneMoved) {
  for (const double moved_mm : {20.0, 45.0, 80.0}) {
    AgreementScene scene;
    scene.shift_labels(1, moved_mm);
    const double half = 0.5 * moved_mm / kAgreedRadiusMm;
    const double lens = (2.0 * std::acos(half) - 2.0 * half * std::sqrt(1.0 - half * half)) / CV_PI;
    EXPECT_NEAR(scene.measure(), 0.5 * (1.0 + lens), 0.05) << moved_mm;  // the other view still agrees
    scene.shift_labels(0, moved_mm);
    EXPECT_NEAR(scene.measure(), lens, 0.08) << moved_mm;
  }
}

TEST(FoodAgreement, CountsConfirmedFoodInThePictureOnly) {
  AgreementScene scene;
  scene.labels[0].setTo(kDishLabel);
  scene.labels[1].setTo(kDishLabel);
  EXPECT_EQ(scene.measure(), 0.0);
  for (test::TrueGrid& grid : scene.grids)
    std::fill(grid.evidence.begin(), grid.evidence.end(), SurfaceEvidence::single);
  EXPECT_EQ(scene.measure(), 1.0);
  for (test::TrueGrid& grid : scene.grids) {
    std::fill(grid.evidence.begin(), grid.evidence.end(), SurfaceEvidence::both);
    for (SurfacePoint& point : grid.points) point.x_mm += 2000.0F;  // out of either picture
  }
  EXPECT_EQ(scene.measure(), 1.0);
}

}  // namespace
}  // namespace traygauge
