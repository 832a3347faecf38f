// The dense surface on photographs of a temple of plaster, 16 cm high, from a calibrated gantry (Seitz and
// others 2006). Its laser scan is not published: the truth here is OpenCV's features triangulated over five
// views, the object's bounding box, and the surface that another pair finds.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/stereo/dense_stereo.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/photograph_scene.hpp"

namespace traygauge {
namespace {

using test::Photograph;
using test::SurfaceDeviation;

constexpr double kTempleMmPerUnit = 1000.0;
constexpr std::size_t kTempleViews = 5;   // 7.6 degrees from one to the next
constexpr std::size_t kTempleMiddle = 2;  // the reference of all pairs
constexpr std::uint8_t kItem = 2;

// Table frame whose z axis points from the object towards a camera, its origin behind the object.
Pose table_behind(const Vec3& centre_mm, const Vec3& camera_mm, double below_mm) {
  const Vec3 z = (camera_mm - centre_mm).normalized();
  const Vec3 x = z.unitOrthogonal();
  Pose world_from_table;
  world_from_table.rotation << x, z.cross(x), z;
  world_from_table.translation = centre_mm - below_mm * z;
  return world_from_table.inverse();
}

// The plaster is bright, the velvet around it is not.
cv::Mat1b label_object(const cv::Mat1b& gray) {
  constexpr int kDarkest = 60;
  cv::Mat1b smooth;
  cv::GaussianBlur(gray, smooth, {5, 5}, 0.0);
  cv::Mat1b labels(gray.size(), std::uint8_t{0});
  labels.setTo(kItem, smooth > kDarkest);
  return labels;
}

struct Surface {
  SurfaceDeviation against_points;
  cv::Mat1f depth_mm;  // of the middle view
  double in_box_fraction = 0.0;
};

class Temple : public ::testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    if (test::captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
    const auto folder = test::captures_folder() / "real/middlebury_templeRing";
    const nlohmann::json box = test::read_json(folder / "cameras.json").at("object_bounding_box_m");
    low_mm_ = kTempleMmPerUnit * test::vec3_from_json(box.at(0));
    high_mm_ = kTempleMmPerUnit * test::vec3_from_json(box.at(1));
    const std::vector<test::TrueView> views = test::read_real_views(folder);
    const Vec3 centre_mm = 0.5 * (low_mm_ + high_mm_);
    const Vec3 camera_mm =
        kTempleMmPerUnit * camera_centre_mm(views.at(GetParam() + kTempleMiddle).camera_from_world);
    half_depth_mm_ = 0.5 * (high_mm_ - low_mm_).dot((camera_mm - centre_mm).normalized().cwiseAbs());
    table_from_world_ = table_behind(centre_mm, camera_mm, half_depth_mm_);
    for (std::size_t i = 0; i < kTempleViews; ++i) {
      photographs_.push_back(
          test::read_photograph(views.at(GetParam() + i), kTempleMmPerUnit, table_from_world_));
      photographs_.back().labels = label_object(photographs_.back().gray);
    }
    points_ = test::triangulate_features(photographs_, kTempleMiddle, 1.0);
  }

  Surface reconstruct(std::size_t other) {
    DenseStereoParams params;
    params.highest_mm = 2.0 * half_depth_mm_;
    test::Allocated<DenseStereoWorkspace> workspace(params);
    std::array<SurfaceGrid, 2> grids;
    DenseStereoReport report;
    const Photograph& middle = photographs_[kTempleMiddle];
    const Status status = run_dense_stereo({middle.stored(), photographs_[other].stored()},
                                           labels_on_dish(labels_of_single_dish()), 0.0, params.highest_mm,
                                           params, *workspace, grids, report);
    EXPECT_TRUE(status.ok()) << name(status.code());
    Surface surface;
    if (!status.ok()) return surface;
    surface.depth_mm = test::depth_map(grids[0], middle, 1);
    surface.against_points = test::compare_depth(surface.depth_mm, middle, photographs_[other], points_);
    surface.in_box_fraction = share_in_box(grids[0]);
    return surface;
  }
  double share_in_box(const SurfaceGrid& grid) const {
    constexpr double kMarginMm = 2.0;
    const Pose world_from_table = table_from_world_.inverse();
    int inside = 0;
    int all = 0;
    for (int y = 0; y < grid.points.height; ++y) {
      for (int x = 0; x < grid.points.width; ++x) {
        if (grid.evidence.at(x, y) != SurfaceEvidence::both) continue;
        const SurfacePoint& point = grid.points.at(x, y);
        const Vec3 mm = world_from_table * Vec3(point.x_mm, point.y_mm, point.z_mm);
        ++all;
        inside += ((mm - low_mm_).array() > -kMarginMm).all() && ((high_mm_ - mm).array() > -kMarginMm).all();
      }
    }
    return static_cast<double>(inside) / all;
  }
  void print(const char* what, const SurfaceDeviation& deviation) const {
    std::printf("view %2zu, %-26s %5d (%4d without); median %.3f px, 90 %% %.3f px; %.2f mm, bias %+.2f mm\n",
                GetParam() + kTempleMiddle, what, deviation.compared, deviation.missing, deviation.median_px,
                deviation.percentile90_px, deviation.median_mm, deviation.bias_mm);
  }

  Vec3 low_mm_ = Vec3::Zero();
  Vec3 high_mm_ = Vec3::Zero();
  double half_depth_mm_ = 0.0;  // of the box, along the line of sight
  Pose table_from_world_;
  std::vector<Photograph> photographs_;
  std::vector<test::ScenePoint> points_;
};

TEST_P(Temple, NeighbouringViewsFindItsSurface) {
  const Surface before = reconstruct(kTempleMiddle - 1);
  const Surface after = reconstruct(kTempleMiddle + 1);
  for (const Surface* surface : {&before, &after}) {
    const SurfaceDeviation& deviation = surface->against_points;
    print("7.6 degrees, points", deviation);
    EXPECT_GT(deviation.compared, 60);
    EXPECT_LT(deviation.missing, 0.08 * deviation.compared);
    EXPECT_LT(deviation.median_px, 0.13);
    EXPECT_LT(deviation.percentile90_px, 0.5);
    EXPECT_LT(std::abs(deviation.bias_mm), 0.2);
    EXPECT_GT(surface->in_box_fraction, 0.98);
  }
  const SurfaceDeviation across = test::compare_depth(
      before.depth_mm, after.depth_mm, photographs_[kTempleMiddle], photographs_[kTempleMiddle + 1]);
  print("between both pairs", across);
  EXPECT_GT(across.compared, 30'000);
  EXPECT_LT(across.median_px, 0.2);
  EXPECT_LT(std::abs(across.bias_mm), 0.2);
}

TEST_P(Temple, FifteenDegreesFindTheSameSurface) {
  for (const std::size_t other : {kTempleMiddle - 2, kTempleMiddle + 2}) {
    const Surface surface = reconstruct(other);
    print("15 degrees, points", surface.against_points);
    EXPECT_GT(surface.against_points.compared, 60);
    EXPECT_LT(surface.against_points.missing, 0.2 * surface.against_points.compared);
    EXPECT_LT(surface.against_points.median_px, 0.25);
    EXPECT_LT(surface.against_points.percentile90_px, 1.0);
    EXPECT_LT(std::abs(surface.against_points.bias_mm), 0.2);
    EXPECT_GT(surface.in_box_fraction, 0.95);
  }
}

// First of five views on an unbroken part of the ring: front, sides, back, and upside down.
INSTANTIATE_TEST_SUITE_P(Ring, Temple, ::testing::Values(0, 6, 13, 20, 32, 41));

}  // namespace
}  // namespace traygauge
