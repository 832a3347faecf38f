// Card alignment, tracking and bundle adjustment in a row, on rendered captures with true poses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/adjustment/bundle_adjustment.hpp"
#include "core/card/card_alignment.hpp"
#include "core/dish/dish_outline.hpp"
#include "core/tracking/point_tracking.hpp"
#include "tests/core/adjustment/bundle_scene.hpp"
#include "tests/core/stereo/capture_scene.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/capture_bundle.hpp"

namespace traygauge {
namespace {

using test::Allocated;
using test::BundleCapture;

constexpr std::size_t kMaxOutlinePoints = 1024;

const std::vector<std::string>& capture_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = test::single_dish_captures();
    for (const char* tray : {"trays/t01", "trays/t04", "trays/t05"}) all.emplace_back(tray);
    return all;
  }();
  return names;
}

struct PreparedView {
  cv::Mat1b gray;
  cv::Mat1b labels;
  CardPrior card;
  std::vector<std::vector<Vec2>> outlines;  // of each dish
};

struct PreparedPair {
  std::string name;
  TableCameras truth;
  std::array<CardPrior, 2> cards;
  std::vector<PointTrack> tracks;
  std::array<std::vector<std::vector<Vec2>>, 2> outlines;
  FocalsPx focals_px{};
  const BundleCapture* capture = nullptr;
};

// The stages before the refinement, once for all tests.
class Preparation {
 public:
  Preparation() {
    captures_.reserve(capture_names().size());
    for (const std::string& name : capture_names()) {
      captures_.push_back(test::read_bundle_capture(name));
      prepare(name, captures_.back());
    }
  }
  const std::vector<PreparedPair>& pairs() const { return pairs_; }
  std::vector<DishModel> all_dishes() const {
    std::vector<DishModel> models;
    for (const BundleCapture& capture : captures_) {
      for (const test::TrueDish& dish : capture.dishes) {
        const auto is_same = [&](const DishModel& model) {
          return model.outer_size_mm == dish.model.outer_size_mm &&
                 model.rim_height_mm == dish.model.rim_height_mm;
        };
        if (std::none_of(models.begin(), models.end(), is_same)) models.push_back(dish.model);
      }
    }
    return models;
  }

 private:
  void prepare(const std::string& name, const BundleCapture& capture) {
    const nlohmann::json& card = capture.truth.description["card"];
    CardModelSize size;
    size.width_mm = card["width_mm"];
    size.height_mm = card["height_mm"];
    size.thickness_mm = capture.card_thickness_mm;
    const cv::Mat1b print = cv::imread((capture.truth.folder / "card.png").string(), cv::IMREAD_GRAYSCALE);
    EXPECT_TRUE(prepare_card_pattern(test::view_of(print), size, card_params_.pattern, *pattern_).ok());
    std::vector<PreparedView> views;
    for (const test::TrueView& view : capture.truth.views) views.push_back(prepare_view(view, capture));
    for (const auto& [a, b] : capture.truth.pairs) {
      const auto first = static_cast<std::size_t>(a);
      const auto second = static_cast<std::size_t>(b);
      PreparedPair pair;
      pair.name = name + ' ' + std::to_string(a) + '-' + std::to_string(b);
      pair.truth = {capture.camera_from_table(first), capture.camera_from_table(second)};
      pair.cards = {views[first].card, views[second].card};
      pair.tracks = track(capture, views, first, second);
      pair.outlines = {views[first].outlines, views[second].outlines};
      pair.focals_px = {capture.truth.views[first].lens.pinhole.mean_focal_px(),
                        capture.truth.views[second].lens.pinhole.mean_focal_px()};
      pair.capture = &capture;
      pairs_.push_back(pair);
    }
  }

  PreparedView prepare_view(const test::TrueView& view, const BundleCapture& capture) {
    PreparedView prepared;
    prepared.gray = view.read_gray();
    prepared.labels = view.read_labels();
    const auto labels = test::view_of(prepared.labels);
    const Result<CardAlignment> alignment =
        align_card(test::view_of(prepared.gray), labels, measure_regions(labels).card, view.lens, *pattern_,
                   card_params_, *card_workspace_);
    EXPECT_TRUE(alignment.ok());
    prepared.card = {alignment->camera_from_table, alignment->information};
    for (const test::TrueDish& dish : capture.dishes) {
      std::vector<Vec2> storage(kMaxOutlinePoints);
      BoundedList<Vec2> rays{std::span<Vec2>(storage)};
      EXPECT_TRUE(trace_dish_outline(labels, view.lens, dish.region, {}, *outline_workspace_, rays).ok());
      storage.resize(rays.size());
      prepared.outlines.push_back(storage);
    }
    return prepared;
  }

  std::vector<PointTrack> track(const BundleCapture& capture, const std::vector<PreparedView>& views,
                                std::size_t first, std::size_t second) {
    const auto tracked = [&](std::size_t view, const PyramidWorkspace& workspace) {
      return TrackedView{build_pyramid(test::view_of(views[view].gray), workspace),
                         test::view_of(views[view].labels), capture.truth.views[view].lens};
    };
    Random random(1);
    std::span<const PointTrack> tracks;
    PointTrackingReport report;
    EXPECT_TRUE(track_points(tracked(first, *pyramids_[0]), tracked(second, *pyramids_[1]),
                             {views[first].card.camera_from_table, views[second].card.camera_from_table},
                             capture.card_thickness_mm, track_params_, random, *track_workspace_, tracks,
                             report)
                    .ok());
    return {tracks.begin(), tracks.end()};
  }

  CardAlignmentParams card_params_;
  PointTrackingParams track_params_;
  Allocated<CardPattern> pattern_{card_params_.pattern};
  Allocated<CardAlignmentWorkspace> card_workspace_{card_params_};
  Allocated<PointTrackingWorkspace> track_workspace_{1600, 1200, track_params_};
  std::array<Allocated<PyramidWorkspace>, 2> pyramids_{Allocated<PyramidWorkspace>{1600, 1200},
                                                       Allocated<PyramidWorkspace>{1600, 1200}};
  Allocated<DishOutlineWorkspace> outline_workspace_{std::size_t{16384}};
  std::vector<BundleCapture> captures_;
  std::vector<PreparedPair> pairs_;
};

const Preparation& prepared() {
  static const Preparation all;
  return all;
}

struct Deviations {
  std::vector<double> turn_deg;
  std::vector<double> direction_deg;
  std::vector<double> scale_percent;
  std::vector<double> tilt_deg;
  std::vector<double> bottom_mm;  // of the table, and so of the bottoms, under each dish
  std::vector<double> centre_mm;
  std::vector<double> camera_nees;  // expected: 12
  int failures = 0;

  static double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
  }
  static double largest(const std::vector<double>& values) {
    return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
  }
  void print(const char* what) const {
    std::printf("%-12s (median / largest)", what);
    const auto show = [](const char* name, const std::vector<double>& values) {
      std::printf("  %s %.4f / %.4f", name, median(values), largest(values));
    };
    show("turn deg", turn_deg);
    show("direction deg", direction_deg);
    show("scale %", scale_percent);
    show("table deg", tilt_deg);
    show("bottom mm", bottom_mm);
    show("centre mm", centre_mm);
    show("NEES", camera_nees);
    std::printf("  failed %d\n", failures);
  }
};

void add(const PreparedPair& pair, const BundleResult& result, Deviations& deviations) {
  const TableCameras& found = result.camera_from_table;
  const Pose motion = second_from_first(found);
  const Pose truth = second_from_first(pair.truth);
  deviations.turn_deg.push_back(test::rotation_error_deg(motion, truth));
  deviations.direction_deg.push_back(test::direction_error_deg(motion, truth));
  deviations.scale_percent.push_back(100.0 *
                                     std::abs(motion.translation.norm() / truth.translation.norm() - 1.0));
  deviations.tilt_deg.push_back(test::table_tilt_deg(found[0], pair.truth[0]));
  Eigen::Matrix<double, 12, 1> error;
  error << test::pose_error(found[0], pair.truth[0]), test::pose_error(found[1], pair.truth[1]);
  const CamerasMatrix covariance = result.covariance.topLeftCorner<12, 12>();
  deviations.camera_nees.push_back(error.dot(inverse_information<12>(covariance) * error));
  for (std::size_t i = 0; i < pair.capture->dishes.size(); ++i) {
    const Vec2 centre = pair.capture->dishes[i].place.centre_mm;
    deviations.bottom_mm.push_back(std::abs(test::table_error_mm(found[0], pair.truth[0], centre)));
    if (!result.dishes[i].status.ok()) continue;
    deviations.centre_mm.push_back((result.dishes[i].placed.place.centre_mm - centre).norm());
  }
}

std::vector<BundleDish> dishes_of(const PreparedPair& pair, std::span<const DishModel> known) {
  std::vector<BundleDish> dishes;
  for (std::size_t i = 0; i < pair.capture->dishes.size(); ++i) {
    const std::span<const DishModel> described(&pair.capture->dishes[i].model, 1);
    dishes.push_back({{pair.outlines[0][i], pair.outlines[1][i]}, known.empty() ? described : known});
  }
  return dishes;
}

Deviations refine_all(const BundleParams& params) {
  Allocated<BundleWorkspace> workspace(std::size_t{2048}, kMaxOutlinePoints);
  Deviations deviations;
  for (const PreparedPair& pair : prepared().pairs()) {
    const std::vector<BundleDish> dishes = dishes_of(pair, {});
    const BundleInput input{pair.cards, pair.capture->card_middle_mm, pair.tracks, dishes, pair.focals_px};
    BundleResult result;
    const Status status = adjust_bundle(input, params, *workspace, result);
    bool is_good = status.ok();
    for (std::size_t i = 0; params.use_rims && i < dishes.size(); ++i)
      is_good = is_good && result.dishes[i].status.ok();
    if (!is_good) {
      ++deviations.failures;
      std::printf("%s: %s\n", pair.name.c_str(), name(status.code()));
    }
    if (status.ok()) add(pair, result, deviations);
  }
  return deviations;
}

class JointCaptures : public ::testing::Test {
 protected:
  void SetUp() override {
    if (test::captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  }
};

TEST_F(JointCaptures, CamerasTableAndDishesAreTheTrueOnes) {
  const Deviations all = refine_all({});
  all.print("all");
  EXPECT_EQ(all.failures, 0);
  EXPECT_LE(Deviations::median(all.turn_deg), 0.01);
  EXPECT_LE(Deviations::median(all.direction_deg), 0.02);
  EXPECT_LE(Deviations::median(all.scale_percent), 0.03);
  EXPECT_LE(Deviations::median(all.tilt_deg), 0.02);
  EXPECT_LE(Deviations::largest(all.tilt_deg), 0.15);
  EXPECT_LE(Deviations::median(all.bottom_mm), 0.08);
  EXPECT_LE(Deviations::largest(all.bottom_mm), 0.5);
  EXPECT_LE(Deviations::largest(all.centre_mm), 0.3);
  // The middle of chi squared with 12 degrees of freedom is 11.3.
  EXPECT_LE(Deviations::median(all.camera_nees), 16.0);
}

TEST_F(JointCaptures, EachTermHelps) {
  const Deviations all = refine_all({});
  BundleParams params;
  params.use_rims = false;
  const Deviations no_rim = refine_all(params);
  no_rim.print("no rim");
  params.use_rims = true;
  params.use_table = false;
  const Deviations no_table = refine_all(params);
  no_table.print("no table");
  params.use_tracks = false;
  const Deviations no_tracks = refine_all(params);
  no_tracks.print("no tracks");
  params.use_rims = false;
  const Deviations card = refine_all(params);
  card.print("card alone");
  EXPECT_LT(Deviations::largest(all.bottom_mm), Deviations::largest(no_rim.bottom_mm));
  EXPECT_LT(Deviations::median(all.tilt_deg), Deviations::median(no_table.tilt_deg));
  EXPECT_LT(Deviations::median(no_table.turn_deg), 0.3 * Deviations::median(no_tracks.turn_deg));
  EXPECT_LT(Deviations::median(all.turn_deg), 0.2 * Deviations::median(card.turn_deg));
}

TEST_F(JointCaptures, DishesAreToldApart) {
  const std::vector<DishModel> known = prepared().all_dishes();
  ASSERT_GE(known.size(), 4U);
  Allocated<BundleWorkspace> workspace(std::size_t{2048}, kMaxOutlinePoints);
  for (const PreparedPair& pair : prepared().pairs()) {
    const std::vector<BundleDish> dishes = dishes_of(pair, known);
    const BundleInput input{pair.cards, pair.capture->card_middle_mm, pair.tracks, dishes, pair.focals_px};
    BundleResult result;
    ASSERT_TRUE(adjust_bundle(input, {}, *workspace, result).ok()) << pair.name;
    for (std::size_t i = 0; i < dishes.size(); ++i) {
      ASSERT_TRUE(result.dishes[i].status.ok()) << pair.name << " dish " << i;
      const DishModel& chosen = known[static_cast<std::size_t>(result.dishes[i].placed.candidate)];
      EXPECT_EQ(chosen.outer_size_mm, pair.capture->dishes[i].model.outer_size_mm) << pair.name;
      EXPECT_EQ(chosen.rim_height_mm, pair.capture->dishes[i].model.rim_height_mm) << pair.name;
    }
  }
}

}  // namespace
}  // namespace traygauge
