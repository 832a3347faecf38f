// A mango on a printed page, photographed by hand with a telephone: the stages of profile `best` from card to
// volume, with a block of the page's markers as the card. The truth is what the silhouettes of all 13 views
// leave: 593 ml under the upper surface, 86.5 mm high, at most 8755 mm² from above. Most views look down by
// less than 50 degrees, where the product's would look down by 58 or more, and the skin is smooth and glossy.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/card/card_alignment.hpp"
#include "core/stereo/dense_stereo.hpp"
#include "core/volume/round_body.hpp"
#include "tests/core/stereo/capture_scene.hpp"
#include "tests/core/volume/height_measurement.hpp"
#include "tests/support/marker_card.hpp"
#include "tests/support/sparse_stages.hpp"

namespace traygauge {
namespace {

using test::Allocated;
using test::Photograph;

constexpr double kHullColumnMl = 593.0;
constexpr double kHullHeightMm = 86.5;
constexpr double kTopMm = 90.0;
constexpr std::uint8_t kMango = 2;

// Of the page around the fruit, which stands for the dish.
constexpr double kDishRadiusMm = 85.0;
const Vec3 kDishOnPage(93.0, -141.0, 0.0);

// Four markers of the page's upper right corner, where it lies flattest, and half of the gaps around them.
constexpr int kFirstMarker = 3;
constexpr double kCardMm = test::kCardSideMarkers * test::kMarkerPitchMm;
constexpr double kHalfGapMm = 0.5 * (test::kMarkerPitchMm - test::kMarkerSideMm);
const Vec3 kCardOnPage(kFirstMarker* test::kMarkerPitchMm - kHalfGapMm, kHalfGapMm, 0.0);

struct PagePair {
  std::string first;
  std::string second;
  double angle_deg = 0.0;
};

struct MangoVolume {
  Status status;
  HeightVolume volume;
  double matched_fraction = 0.0;
  bool is_round = false;
};

class Mango : public ::testing::Test {
 protected:
  void SetUp() override {
    if (test::captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
    folder_ = test::captures_folder() / "real/fruit_board_mango";
    views_ = test::read_real_views(folder_);
    const nlohmann::json cameras = test::read_json(folder_ / "cameras.json");
    for (const nlohmann::json& pair : cameras.at("pairs")) {
      const double angle_deg = pair.at("angle_at_object_deg");
      if (angle_deg > 20.0 && angle_deg < 28.0) pairs_.push_back({pair.at("a"), pair.at("b"), angle_deg});
    }
    DishModel page;
    page.outer_size_mm = {2.0 * kDishRadiusMm, 2.0 * kDishRadiusMm};
    ASSERT_TRUE(page_.profile.set(page).ok());
    page_.place.centre_mm = (kDishOnPage - kCardOnPage).head<2>();
    measurement_.overhang = {};
  }

  // In the frame of the card.
  Photograph photograph(const std::string& image) const {
    const auto named = [&](const test::TrueView& view) { return view.image.filename() == image; };
    const test::TrueView& view = *std::find_if(views_.begin(), views_.end(), named);
    Photograph photograph = test::read_photograph(view, 1.0, {Mat3::Identity(), -kCardOnPage});
    photograph.labels = cv::Mat1b(photograph.gray.size(), kBackgroundLabel);
    std::vector<Vec3> dish;
    for (int i = 0; i < 90; ++i) {
      const double angle = i * std::numbers::pi / 45.0;
      dish.push_back(kDishOnPage - kCardOnPage + kDishRadiusMm * Vec3(std::cos(angle), std::sin(angle), 0.0));
    }
    label(dish, kDishLabel, photograph);
    label({Vec3::Zero(), {kCardMm, 0.0, 0.0}, {kCardMm, -kCardMm, 0.0}, {0.0, -kCardMm, 0.0}}, kCardLabel,
          photograph);
    const auto mask = folder_ / ("mask_" + view.image.stem().string() + ".png");
    photograph.labels.setTo(kMango, cv::imread(mask.string(), cv::IMREAD_GRAYSCALE) > 127);
    return photograph;
  }
  static void label(const std::vector<Vec3>& outline_mm, std::uint8_t value, Photograph& photograph) {
    std::vector<cv::Point> corners;
    for (const Vec3& point_mm : outline_mm) {
      const Vec2 pixel = photograph.pixel_of(point_mm);
      corners.emplace_back(cvRound(pixel.x()), cvRound(pixel.y()));
    }
    cv::fillConvexPoly(photograph.labels, corners, value);
  }

  MangoVolume measure(const std::array<Photograph, 2>& photographs) {
    std::array<SurfaceGrid, 2> grids;
    DenseStereoReport report;
    MangoVolume result;
    result.status = run_dense_stereo({photographs[0].stored(), photographs[1].stored()},
                                     labels_on_dish(labels_of_single_dish()), 0.0, kTopMm, surface_params_,
                                     *surface_space_, grids, report);
    if (!result.status.ok()) return result;
    measurement_.round = shape_round_bodies(
        {grids, {surface_space_->views[0].points, surface_space_->views[1].points}}, page_, {}, *body_space_);
    result.is_round = measurement_.round.contains(kMango);
    result.status = measurement_.run(grids, page_);
    result.volume = measurement_.item(kMango);
    result.matched_fraction = matched_fraction(grids[0]);
    return result;
  }
  // Of the fruit's samples.
  static double matched_fraction(const SurfaceGrid& grid) {
    int matched = 0;
    int all = 0;
    for (int y = 0; y < grid.labels.height; ++y) {
      for (int x = 0; x < grid.labels.width; ++x) {
        if (grid.labels.at(x, y) != kMango) continue;
        ++all;
        matched += grid.evidence.at(x, y) == SurfaceEvidence::both;
      }
    }
    return static_cast<double>(matched) / all;
  }
  static void print(const PagePair& pair, const MangoVolume& mango) {
    std::printf(
        "%s %s, %.0f degrees: column %.0f ml (%+.1f %%), volume %.0f ml, %.1f mm high, %.0f mm2, "
        "matched %.2f%s\n",
        pair.first.c_str(), pair.second.c_str(), pair.angle_deg, mango.volume.column_volume_ml,
        100.0 * (mango.volume.column_volume_ml / kHullColumnMl - 1.0), mango.volume.volume_ml,
        mango.volume.max_height_mm, mango.volume.area_mm2, mango.matched_fraction,
        mango.is_round ? ", round" : "");
  }
  static double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
  static double deviation(const std::vector<double>& values) {
    double squares = 0.0;
    for (const double value : values) squares += (value - mean(values)) * (value - mean(values));
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
  }
  static void expect_volume(const std::vector<double>& column_ml) {
    std::printf("%zu pairs: %.0f ml (%+.1f %%), standard deviation %.1f %%\n", column_ml.size(),
                mean(column_ml), 100.0 * (mean(column_ml) / kHullColumnMl - 1.0),
                100.0 * deviation(column_ml) / mean(column_ml));
    EXPECT_NEAR(mean(column_ml), kHullColumnMl, 0.06 * kHullColumnMl);
    for (const double ml : column_ml) EXPECT_NEAR(ml, kHullColumnMl, 0.18 * kHullColumnMl);
  }

  std::filesystem::path folder_;
  std::vector<test::TrueView> views_;
  std::vector<PagePair> pairs_;
  InnerSurface page_;
  DenseStereoParams surface_params_;
  Allocated<DenseStereoWorkspace> surface_space_{surface_params_};
  Allocated<RoundBodyWorkspace> body_space_{surface_params_.rectification.max_rows,
                                            surface_params_.max_columns};
  test::HeightMeasurement measurement_;
};

TEST_F(Mango, ColumnVolumeWithThePosesOfThePage) {
  std::vector<double> column_ml;
  for (const PagePair& pair : pairs_) {
    const MangoVolume mango = measure({photograph(pair.first), photograph(pair.second)});
    ASSERT_TRUE(mango.status.ok()) << pair.first << ' ' << pair.second << ' ' << name(mango.status.code());
    print(pair, mango);
    column_ml.push_back(mango.volume.column_volume_ml);
    EXPECT_NEAR(mango.volume.max_height_mm, kHullHeightMm, 11.0);
  }
  ASSERT_GE(column_ml.size(), 10U);
  expect_volume(column_ml);
}

TEST_F(Mango, ColumnVolumeWithPosesFromMarkersAndTracks) {
  const CardAlignmentParams params;
  Allocated<CardPattern> pattern(params.pattern);
  Allocated<CardAlignmentWorkspace> alignment_space(params);
  test::SparseStages stages;
  const cv::Mat1b card = test::draw_marker_card(0, kFirstMarker);
  ASSERT_TRUE(
      prepare_card_pattern(test::view_of(card), {kCardMm, kCardMm, 0.0}, params.pattern, *pattern).ok());
  std::vector<double> column_ml;
  std::vector<double> turn_deg;
  std::size_t refused = 0;
  for (const PagePair& pair : pairs_) {
    std::array<Photograph, 2> photographs = {photograph(pair.first), photograph(pair.second)};
    std::array<CardPrior, 2> cards;
    for (std::size_t v = 0; v < 2; ++v) {
      const auto labels = test::view_of(photographs[v].labels);
      const Result<CardAlignment> alignment =
          align_card(test::view_of(photographs[v].gray), labels, measure_regions(labels).card,
                     photographs[v].view.lens, *pattern, params, *alignment_space);
      ASSERT_TRUE(alignment.ok()) << pair.first << ' ' << pair.second;
      EXPECT_GT(alignment->correlation, 0.95);
      cards[v] = {alignment->camera_from_table, alignment->information};
    }
    const TableCameras given = {photographs[0].view.camera_from_world, photographs[1].view.camera_from_world};
    const Status status = stages.run(photographs, cards, {0.5 * kCardMm, -0.5 * kCardMm, 0.0}, 1);
    if (!status.ok()) {
      std::printf("%s %s: %s\n", pair.first.c_str(), pair.second.c_str(), name(status.code()));
      ++refused;
      continue;
    }
    const TableCameras& found = stages.bundle().camera_from_table;
    for (std::size_t v = 0; v < 2; ++v) photographs[v].view.camera_from_world = found[v];
    const test::PoseDeviation off = test::compare_motion(found, given);
    const Vec3 under_mm = given[0].inverse() * (found[0] * (kDishOnPage - kCardOnPage));
    std::printf(
        "%zu tracks; rotation %.2f, direction %.2f degrees, scale %+.2f %%, page under it %+.2f mm\n  ",
        stages.tracks().size(), off.rotation_deg, off.direction_deg, off.scale_percent, under_mm.z());
    turn_deg.push_back(off.rotation_deg);
    const MangoVolume mango = measure(photographs);
    ASSERT_TRUE(mango.status.ok()) << pair.first << ' ' << pair.second << ' ' << name(mango.status.code());
    print(pair, mango);
    column_ml.push_back(mango.volume.column_volume_ml);
  }
  // The page is curled by up to 2 mm where the program expects a flat card: one pair contradicts it.
  EXPECT_LE(refused, 2U);
  ASSERT_GE(turn_deg.size(), 9U);
  std::sort(turn_deg.begin(), turn_deg.end());
  EXPECT_LT(turn_deg[turn_deg.size() / 2], 0.35);
  expect_volume(column_ml);
}

}  // namespace
}  // namespace traygauge
