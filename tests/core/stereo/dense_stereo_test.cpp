// The dense surface of the captures' dishes at their true poses: what dense matching alone does to heights
// and volumes of food, with either view as the one that has true depth.
#include "core/stereo/dense_stereo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "tests/support/capture_truth.hpp"

namespace traygauge {
namespace {

using test::CaptureTruth;
using test::TrueView;

struct Stage {
  explicit Stage(const DenseStereoParams& p = {}) : params(p) {
    ArenaPlan plan;
    workspace.allocate(plan, params);
    bytes = plan.high_water_bytes();
    block.resize(bytes + kArenaAlignmentBytes);
    const auto raw = reinterpret_cast<std::uintptr_t>(block.data());
    const auto aligned = (raw + kArenaAlignmentBytes - 1) / kArenaAlignmentBytes * kArenaAlignmentBytes;
    Arena arena({block.data() + (aligned - raw), bytes});
    workspace.allocate(arena, params);
    EXPECT_FALSE(arena.exhausted());
  }
  DenseStereoParams params;
  std::size_t bytes = 0;
  std::vector<std::byte> block;
  DenseStereoWorkspace workspace;
  std::array<SurfaceGrid, 2> grids;
  DenseStereoReport report;
};

// A pair of views of a capture with one dish; the world of its truth is a table frame.
struct CapturePair {
  CaptureTruth capture;
  std::array<cv::Mat1b, 2> gray;
  std::array<cv::Mat1b, 2> labels;
  std::array<StoredView, 2> views;
  double bottom_mm = 0.0;
  double top_mm = 0.0;

  CapturePair(const std::string& name, std::size_t first, std::size_t second)
      : capture(test::read_capture_truth(test::captures_folder() / name)) {
    const std::array<std::size_t, 2> ids{first, second};
    for (std::size_t v = 0; v < 2; ++v) {
      const TrueView& stored = capture.views.at(ids[v]);
      gray[v] = stored.read_gray();
      labels[v] = stored.read_labels();
      const cv::Rect box = cv::boundingRect(test::dish_mask(labels[v]));
      views[v] = {{gray[v].data, gray[v].cols, gray[v].rows},
                  {labels[v].data, labels[v].cols, labels[v].rows},
                  {box.x, box.y, box.x + box.width, box.y + box.height},
                  stored.lens,
                  stored.camera_from_world};
    }
    const nlohmann::json& dish = capture.description.at("dish");
    bottom_mm = dish.at("bottom_height_mm");
    top_mm = dish.at("rim_height_mm");
    for (const nlohmann::json& item : capture.truth.at("items")) {
      top_mm = std::max(top_mm, bottom_mm + item.at("max_height_mm").get<double>());
    }
  }
  Status run(Stage& stage) const {
    return run_dense_stereo(views, labels_on_dish(labels_of_single_dish()), bottom_mm, top_mm + 8.0,
                            stage.params, stage.workspace, stage.grids, stage.report);
  }
};

struct ItemError {
  double median_mm = 0.0;
  double percentile95_mm = 0.0;
  double bias_mm = 0.0;
  double volume_percent = 0.0;
  double confirmed_fraction = 0.0;
};

// True points under the samples of the grid of view 0.
class Truth {
 public:
  Truth(const CapturePair& pair, const SurfaceGrid& grid) : grid_(grid), bottom_mm_(pair.bottom_mm) {
    const TrueView& view = pair.capture.views.at(0);
    const Pose world_from_camera = view.camera_from_world.inverse();
    const cv::Mat1f depth = pair.capture.read_depth_mm();
    points_.resize(static_cast<std::size_t>(grid.points.width) *
                   static_cast<std::size_t>(grid.points.height));
    for (int y = 0; y < grid.points.height; ++y) {
      for (int x = 0; x < grid.points.width; ++x) {
        const SurfacePoint& p = grid.points.at(x, y);
        const Vec3 in_camera = view.camera_from_world * Vec3(p.x_mm, p.y_mm, p.z_mm);
        const Vec2 pixel = view.lens.pixel(in_camera.head<2>() / in_camera.z());
        const auto column = static_cast<int>(std::lround(pixel.x()));
        const auto row = static_cast<int>(std::lround(pixel.y()));
        const bool inside = column >= 0 && row >= 0 && column < depth.cols && row < depth.rows;
        const double z = inside ? depth(row, column) : 0.0;
        at(x, y) = z > 0.0 ? world_from_camera * Vec3(in_camera * (z / in_camera.z()))
                           : Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
      }
    }
  }

  ItemError compare(std::uint8_t label) const {
    std::vector<double> errors;
    ItemError item;
    double volume = 0.0;
    double true_volume = 0.0;
    for (int y = 0; y + 1 < grid_.points.height; ++y) {
      for (int x = 0; x + 1 < grid_.points.width; ++x) {
        if (grid_.labels.at(x, y) != label || !at(x, y).allFinite()) continue;
        const double error = measured(x, y).z() - at(x, y).z();
        errors.push_back(std::abs(error));
        item.bias_mm += error;
        item.confirmed_fraction += grid_.evidence.at(x, y) == SurfaceEvidence::both ? 1.0 : 0.0;
        add_cell(label, x, y, volume, true_volume);
      }
    }
    if (errors.empty()) return item;
    std::sort(errors.begin(), errors.end());
    const auto count = static_cast<double>(errors.size());
    item.median_mm = errors[errors.size() / 2];
    item.percentile95_mm = errors[errors.size() * 95 / 100];
    item.bias_mm /= count;
    item.confirmed_fraction /= count;
    item.volume_percent = 100.0 * (volume / true_volume - 1.0);
    return item;
  }

 private:
  const Vec3& at(int x, int y) const {
    return points_[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.points.width) +
                   static_cast<std::size_t>(x)];
  }
  Vec3& at(int x, int y) { return const_cast<Vec3&>(std::as_const(*this).at(x, y)); }
  Vec3 measured(int x, int y) const {
    const SurfacePoint& p = grid_.points.at(x, y);
    return {p.x_mm, p.y_mm, p.z_mm};
  }
  double prism(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Vec3 area = (b - a).cross(c - a);
    return 0.5 * area.z() * ((a.z() + b.z() + c.z()) / 3.0 - bottom_mm_);
  }
  void add_cell(std::uint8_t label, int x, int y, double& volume, double& true_volume) const {
    for (const auto& [i, j] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
      if (grid_.labels.at(x + i, y + j) != label || !at(x + i, y + j).allFinite()) return;
    }
    volume += prism(measured(x, y), measured(x + 1, y), measured(x, y + 1)) +
              prism(measured(x + 1, y), measured(x + 1, y + 1), measured(x, y + 1));
    true_volume +=
        prism(at(x, y), at(x + 1, y), at(x, y + 1)) + prism(at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
  }

  const SurfaceGrid& grid_;
  double bottom_mm_;
  std::vector<Vec3> points_;
};

struct Source {
  const char* folder;
  std::size_t other;
};

class CapturedSurface : public ::testing::Test {
 protected:
  void SetUp() override {
    if (test::captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  }
};

class DenseStereo : public CapturedSurface, public ::testing::WithParamInterface<bool> {};

TEST_P(DenseStereo, HeightsAndVolumesAreRight) {
  const bool true_view_second = GetParam();
  Stage stage;
  EXPECT_LT(stage.bytes, std::size_t{12} << 20);
  double magnitude = 0.0;
  double signed_sum = 0.0;
  double median_mm = 0.0;
  double bias_mm = 0.0;
  int count = 0;
  for (const Source& source :
       {Source{"meals/m01", 1}, Source{"meals/m04", 1}, Source{"meals/m08", 2}, Source{"meals/m11", 2},
        Source{"angles/a01", 3}, Source{"plates/c1_dinner", 1}, Source{"plates/c1_oval", 1}}) {
    const CapturePair pair(source.folder, true_view_second ? source.other : 0,
                           true_view_second ? 0 : source.other);
    ASSERT_TRUE(pair.run(stage).ok()) << source.folder;
    const Truth truth(pair, stage.grids[true_view_second ? 1 : 0]);
    for (const nlohmann::json& item : pair.capture.truth.at("items")) {
      const ItemError error = truth.compare(item.at("label").get<std::uint8_t>());
      std::printf("%-18s %-10s median %.2f mm, 95 %% %5.2f mm, bias %+.2f mm, volume %+5.2f %%, both %.2f\n",
                  source.folder, item.at("name").get<std::string>().c_str(), error.median_mm,
                  error.percentile95_mm, error.bias_mm, error.volume_percent, error.confirmed_fraction);
      magnitude += std::abs(error.volume_percent);
      signed_sum += error.volume_percent;
      median_mm += error.median_mm;
      bias_mm += error.bias_mm;
      ++count;
    }
  }
  std::printf("mean volume error %.2f %%, signed %+.2f %%, median height error %.2f mm, bias %+.3f mm\n",
              magnitude / count, signed_sum / count, median_mm / count, bias_mm / count);
  EXPECT_LT(magnitude / count, 2.0);
  EXPECT_LT(std::abs(signed_sum / count), 1.0);
  EXPECT_LT(median_mm / count, 0.7);
  EXPECT_LT(std::abs(bias_mm / count), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Captures, DenseStereo, ::testing::Bool());

TEST_F(CapturedSurface, SameBitsWhateverWasMeasuredBefore) {
  const CapturePair pair("plates/c1_soup", 0, 1);
  const CapturePair other("meals/m06", 0, 2);
  Stage fresh;
  Stage used;
  ASSERT_TRUE(other.run(used).ok());
  ASSERT_TRUE(pair.run(fresh).ok());
  ASSERT_TRUE(pair.run(used).ok());
  for (std::size_t v = 0; v < 2; ++v) {
    const ImageView<const SurfacePoint> a = fresh.grids[v].points;
    const ImageView<const SurfacePoint> b = used.grids[v].points;
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    const auto bytes =
        static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height) * sizeof *a.data;
    EXPECT_EQ(std::memcmp(a.data, b.data, bytes), 0);
  }
}

// Heights that move a point by more samples than one band holds are matched on a coarser grid.
TEST_F(CapturedSurface, AGridTooFineForTheHeightsIsMadeCoarser) {
  const CapturePair pair("angles/a01", 0, 7);
  Stage fine;
  ASSERT_TRUE(pair.run(fine).ok());
  DenseStereoParams params;
  params.levels = 1;
  Stage coarse(params);
  ASSERT_TRUE(pair.run(coarse).ok());
  EXPECT_LT(coarse.report.disparity_range.count(), kMaxBandLanes);
  EXPECT_GT(fine.report.disparity_range.count(), kMaxBandLanes);
  EXPECT_GT(coarse.report.column_step_mm, fine.report.column_step_mm);
}

TEST_F(CapturedSurface, RefusesOrStaysFinite) {
  CapturePair pair("plates/c1_soup", 0, 1);
  Stage stage;
  const auto expect_finite = [&] {
    for (const SurfaceGrid& grid : stage.grids) {
      for (int y = 0; y < grid.points.height; ++y) {
        for (int x = 0; x < grid.points.width; ++x) {
          const SurfacePoint& p = grid.points.at(x, y);
          ASSERT_TRUE(std::isfinite(p.x_mm) && std::isfinite(p.y_mm) && std::isfinite(p.z_mm));
        }
      }
    }
  };
  pair.gray[1] = 0;
  ASSERT_TRUE(pair.run(stage).ok());
  expect_finite();
  pair.labels[1] = 0;
  EXPECT_FALSE(pair.run(stage).ok());
  pair.views[0].camera_from_table.translation.z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(pair.run(stage).ok());
  CapturePair endless("plates/c1_soup", 0, 1);
  endless.top_mm = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(endless.run(stage).ok());
  expect_finite();
  endless.bottom_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(endless.run(stage).ok());
}

}  // namespace
}  // namespace traygauge
