// evaluate --stages on rendered captures: what it prints and writes, and the truth in the place of stages.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "firmware/evaluate/stage_analysis.hpp"
#include "firmware/evaluate/true_scene.hpp"
#include "firmware/measure/capture_session.hpp"
#include "tests/firmware/command_runner.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

// Of volumes with the truth in the place of every stage: what no view sees stays.
constexpr double kMaxTrueError = 0.05;

using Table = std::vector<std::vector<std::string>>;

Table read_csv(const std::filesystem::path& file) {
  Table table;
  std::istringstream text(read_text(file));
  for (std::string line; std::getline(text, line);) {
    std::vector<std::string>& row = table.emplace_back();
    std::istringstream fields(line + ',');
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
  }
  return table;
}

class StagesOfCaptures : public testing::Test {
 protected:
  void SetUp() override {
    if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  }
};

TEST_F(StagesOfCaptures, ArePrintedAndWritten) {
  const TemporaryFolder out;
  const CommandResult result =
      run({"evaluate", (captures_folder() / "plates" / "c1_dinner").string(), "--runs", "1", "--stages",
           "--out", out.path().string(), "--config", TRAYGAUGE_SOURCE_DIR "/config"});
  ASSERT_EQ(result.status, 0) << result.error;
  const std::size_t heights_at = result.out.find("heights");
  const std::size_t losses_at = result.out.find("MAPE %, with true");
  EXPECT_EQ(heights_at, 0U);
  ASSERT_NE(losses_at, std::string::npos) << result.out;
  for (const StageVariant& variant : stage_variants())
    EXPECT_NE(result.out.find(variant.title, losses_at), std::string::npos) << variant.title;
  EXPECT_NE(result.out.find("\nall, bias", losses_at), std::string::npos);

  const Truth truth = read_truth(captures_folder() / "plates" / "c1_dinner").value();
  const Table stages = read_csv(out.path() / "stages.csv");
  ASSERT_EQ(stages.size(), 1 + truth.items.size());
  const Table estimates = read_csv(out.path() / "estimates.csv");
  const auto column = [](const Table& table, const std::string& name) {
    const auto found = std::find(table[0].begin(), table[0].end(), name);
    EXPECT_NE(found, table[0].end()) << name;
    return static_cast<std::size_t>(found - table[0].begin());
  };
  for (std::size_t i = 1; i < stages.size(); ++i) {
    ASSERT_EQ(stages[i].size(), 7 + kStageVariants);
    const double truth_ml = std::stod(stages[i][column(stages, "truth_ml")]);
    const double measured_ml = std::stod(stages[i][column(stages, "as_measured_ml")]);
    const double true_ml = std::stod(stages[i][column(stages, "all_true_ml")]);
    EXPECT_NEAR(truth_ml, truth.items[i - 1].volume_ml, 0.001);
    EXPECT_NEAR(measured_ml, std::stod(estimates[i][column(estimates, "volume_ml")]), 0.001);
    EXPECT_NEAR(true_ml, truth_ml, kMaxTrueError * truth_ml);
  }

  // The dish and every item; heights are known within a few mm.
  const Table heights = read_csv(out.path() / "heights.csv");
  ASSERT_EQ(heights.size(), 2 + truth.items.size());
  for (std::size_t i = 1; i < heights.size(); ++i) {
    EXPECT_EQ(std::stoi(heights[i][1]), static_cast<int>(i));
    EXPECT_GT(std::stod(heights[i][column(heights, "matched_percent")]), 50.0);
    EXPECT_LT(std::stod(heights[i][column(heights, "median_mm")]), 1.0);
    EXPECT_LT(std::abs(std::stod(heights[i][column(heights, "bias_mm")])), 1.0);
  }
}

// One pair of a capture, measured with and without truth.
struct PairOfCapture {
  const char* name;
  std::array<int, 2> pair;
};

class SubstitutedStages : public StagesOfCaptures, public testing::WithParamInterface<PairOfCapture> {
 protected:
  void SetUp() override {
    StagesOfCaptures::SetUp();
    if (IsSkipped()) return;
    folder_ = captures_folder() / GetParam().name;
    capture_ = read_capture(folder_);
    truth_ = read_truth(folder_).value();
    surface_ = TrueSurface::read(capture_, truth_);
    ASSERT_TRUE(surface_.has_value());
    const auto [first, second] = GetParam().pair;
    pair_ = {pose_of(truth_.poses.at(static_cast<std::size_t>(first))),
             pose_of(truth_.poses.at(static_cast<std::size_t>(second)))};
    session_.emplace(capture_, GetParam().pair, capture_.dishes);
  }

  const Measurement& measure(TrueStages replaced) {
    tap_.emplace(pair_, truth_, surface_, replaced);
    const Measurement& measurement = session_->measure(1, &*tap_);
    EXPECT_TRUE(measurement.status.ok()) << name(measurement.status.code());
    return measurement;
  }
  const Measurement& measure(TrueStage stage) {
    TrueStages stages{};
    stages[static_cast<std::size_t>(stage)] = true;
    return measure(stages);
  }
  static std::vector<double> volumes_of(const Measurement& measurement) {
    std::vector<double> volumes_ml;
    for (const ItemResult& item : measurement.items) {
      volumes_ml.push_back(item.volume_ml);
      volumes_ml.push_back(item.column_volume_ml);
      volumes_ml.push_back(item.sigma_ml);
    }
    return volumes_ml;
  }

  std::filesystem::path folder_;
  Capture capture_;
  Truth truth_;
  std::optional<TrueSurface> surface_;
  PairTruth pair_;
  std::optional<CaptureSession> session_;
  std::optional<StageSubstitution> tap_;
};

INSTANTIATE_TEST_SUITE_P(
    Pairs, SubstitutedStages,
    testing::Values(PairOfCapture{"plates/c1_dinner", {0, 1}}, PairOfCapture{"plates/c1_dinner", {1, 0}},
                    PairOfCapture{"meals/m01", {1, 2}}, PairOfCapture{"trays/t01", {0, 1}}),
    [](const auto& pair) {
      std::string name = pair.param.name;
      std::replace(name.begin(), name.end(), '/', '_');
      return name + "_" + std::to_string(pair.param.pair[0]) + std::to_string(pair.param.pair[1]);
    });

TEST_P(SubstitutedStages, NoneLeavesEveryBitAsItWas) {
  const Measurement& without = session_->measure(1);
  const std::vector<double> expected = volumes_of(without);
  const Pose motion = without.second_from_first;
  ASSERT_FALSE(expected.empty());
  const Measurement& with = measure(TrueStages{});
  EXPECT_EQ(volumes_of(with), expected);
  EXPECT_EQ(with.second_from_first.rotation, motion.rotation);
  EXPECT_EQ(with.second_from_first.translation, motion.translation);
  EXPECT_FALSE(tap_->height_errors().empty());
}

TEST_P(SubstitutedStages, AllPutCamerasAndDishesWhereTheyAre) {
  TrueStages all;
  all.fill(true);
  const Measurement& measurement = measure(all);
  const Pose expected = pair_.second_from_first();
  EXPECT_LT((measurement.second_from_first.rotation - expected.rotation).norm(), 1e-6);
  EXPECT_LT((measurement.second_from_first.translation - expected.translation).norm(), 1e-6);

  const MeasurementViews& views = measurement.views;
  const std::array<Pose, 2> camera_from_world = {pair_.first_from_world, pair_.second_from_world};
  const Pose& reference = camera_from_world.at(static_cast<std::size_t>(views.reference_view));
  const Vec3 up = reference.rotation.col(2);
  EXPECT_LT((views.table.normal - up).norm(), 1e-6);
  EXPECT_NEAR(views.table.offset, up.dot(reference.translation), 1e-6);
  for (const MeasuredSurface& surface : views.surfaces) {
    const TruthDish dish = true_place(truth_, surface.dish).value();
    const double rotation = dish.rotation_deg * M_PI / 180.0;
    const Vec3 axis(std::cos(rotation), std::sin(rotation), 0.0);
    for (std::size_t v = 0; v < 2; ++v) {
      const Pose world_from_table = camera_from_world[v].inverse() * views.camera_from_table[v];
      const DishFrame& place = surface.inner.place;
      const Vec3 centre = world_from_table * Vec3(place.centre_mm.x(), place.centre_mm.y(), 0.0);
      EXPECT_LT((centre - Vec3(dish.centre_mm[0], dish.centre_mm[1], 0.0)).norm(), 1e-6);
      EXPECT_LT((world_from_table.rotation * Vec3(place.axis.x(), place.axis.y(), 0.0) - axis).norm(), 1e-6);
    }
  }
}

TEST_P(SubstitutedStages, PoseAndScaleReplaceTheirOwnPartOfTheMotion) {
  const Pose expected = pair_.second_from_first();
  const Pose found = measure(TrueStages{}).second_from_first;
  const Pose with_pose = measure(TrueStage::pose).second_from_first;
  EXPECT_LT((with_pose.rotation - expected.rotation).norm(), 1e-9);
  EXPECT_LT(with_pose.translation.normalized().cross(expected.translation.normalized()).norm(), 1e-9);
  EXPECT_NEAR(with_pose.translation.norm(), found.translation.norm(), 1e-9);
  const Pose with_scale = measure(TrueStage::scale).second_from_first;
  EXPECT_LT((with_scale.rotation - found.rotation).norm(), 1e-9);
  EXPECT_NEAR(with_scale.translation.norm(), expected.translation.norm(), 1e-9);
  const Pose with_table = measure(TrueStage::table).second_from_first;
  EXPECT_LT((with_table.rotation - found.rotation).norm(), 1e-9);
  EXPECT_LT((with_table.translation - found.translation).norm(), 1e-9);
}

TEST_P(SubstitutedStages, AllMeasureHeightFieldsWell) {
  TrueStages all;
  all.fill(true);
  const Measurement& measurement = measure(all);
  for (const ItemResult& item : measurement.items) {
    const auto truth = std::find_if(truth_.items.begin(), truth_.items.end(),
                                    [&](const TruthItem& known) { return known.label == item.label; });
    ASSERT_NE(truth, truth_.items.end());
    if (truth->kind != "heightfield") continue;
    std::printf("%s %+.2f %%\n", truth->name.c_str(), 100.0 * (item.volume_ml / truth->volume_ml - 1.0));
    EXPECT_NEAR(item.volume_ml, truth->volume_ml, kMaxTrueError * truth->volume_ml) << truth->name;
  }
}

}  // namespace
}  // namespace traygauge
