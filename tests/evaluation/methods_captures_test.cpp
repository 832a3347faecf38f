// Every method measures a rendered capture, each within what such a method can be held to.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/config/dish_choice.hpp"
#include "firmware/measure/capture_session.hpp"
#include "simulator/capture/truth.hpp"
#include "tests/evaluation/methods/pair_features.hpp"
#include "tests/evaluation/tables/pair_method.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge::tables {
namespace {

struct Expectation {
  Method method;
  double tolerance;  // of each item's volume
};

TEST(MethodsOnCaptures, MeasureAMeal) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const PairTask task{captures_folder() / "meals/m08", "m08", {0, 1}};
  const Truth truth = read_truth(task.folder).value();
  for (const auto& [method, tolerance] :
       {Expectation{Method::ours, 0.1}, Expectation{Method::sift, 0.1}, Expectation{Method::orb, 0.15},
        Expectation{Method::presac, 0.15}, Expectation{Method::single_view, 0.6},
        Expectation{Method::sparse_views, 0.4}, Expectation{Method::dense_views, 0.2}}) {
    Variant variant;
    variant.method = method;
    const traygauge::Run run = open_pair(task, variant, "")->measure(1);
    EXPECT_EQ(run.status, StatusCode::ok) << name(method) << ": " << name(run.status);
    EXPECT_GT(run.total_ms, 1.0) << name(method);
    for (const TruthItem& item : truth.items) {
      const ItemEstimate* found = estimate_of(run, item.label);
      ASSERT_NE(found, nullptr) << name(method) << ", " << item.name;
      const double truth_ml = item.volume_above_bottom_plane_ml.value();
      EXPECT_NEAR(found->volume_ml, truth_ml, tolerance * truth_ml) << name(method) << ", " << item.name;
    }
  }
}

// The card fills the picture that it is searched in, up to its edge.
TEST(MethodsOnCaptures, FindPointsUpToTheCardsEdge) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const Capture capture = read_capture(captures_folder() / "meals/m08");
  const CaptureSession session(capture, {0, 1}, choose_dishes(capture, ""), configure({}));
  constexpr double kEdgeMm = 5.0;  // 24 % of the card's area
  for (const Detector detector : {Detector::sift, Detector::orb}) {
    const PointFeatures features = find_on_pattern(session, detector);
    ASSERT_EQ(features.descriptors.rows, static_cast<int>(features.pixels.size()));
    double near_edge = 0.0;
    for (const Vec2& at : features.pixels) {
      const double from_side_mm = std::min(at.x(), capture.card.width_mm - at.x());
      const double from_end_mm = std::min(at.y(), capture.card.height_mm - at.y());
      ASSERT_GT(std::min(from_side_mm, from_end_mm), -0.5) << "beside the card";
      near_edge += std::min(from_side_mm, from_end_mm) < kEdgeMm ? 1.0 : 0.0;
    }
    EXPECT_GT(near_edge, 0.1 * static_cast<double>(features.pixels.size())) << static_cast<int>(detector);
    const PairMatches matches = match_pair(session, detector);
    EXPECT_GT(matches.card_matches.size(), 50U) << static_cast<int>(detector);
  }
}

// Paper, V-B: the region of interest against the whole photograph.
TEST(MethodsOnCaptures, MatchTheWholePictureWithoutARegionOfInterest) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const Capture capture = read_capture(captures_folder() / "meals/m08");
  const std::array<int, 2> pair = {0, 1};
  Variant variant;
  CaptureSession usual(capture, pair, choose_dishes(capture, ""), configure(variant));
  variant.settings = {"view.match_dish_only=false"};
  CaptureSession whole(capture, pair, choose_dishes(capture, ""), configure(variant));
  const Measurement& by_dish = usual.measure(1);
  const Measurement& by_all = whole.measure(1);
  ASSERT_EQ(by_all.status.code(), StatusCode::ok) << name(by_all.status.code());
  for (std::size_t i = 0; i < 2; ++i) {
    const double scale = whole.pictures()->cameras[i].fx_px / capture.views[i].camera.fx_px;
    EXPECT_NEAR(scale, usual.pictures()->cameras[i].fx_px / capture.views[i].camera.fx_px, 1e-12);
    EXPECT_GT(whole.pictures()->gray[i].width, 0.95 * scale * capture.views[i].camera.size.width);
    EXPECT_GT(whole.pictures()->gray[i].height, 0.95 * scale * capture.views[i].camera.size.height);
  }
  EXPECT_DOUBLE_EQ(by_all.relative_angle_deg, by_dish.relative_angle_deg);
  ASSERT_EQ(by_all.items.size(), by_dish.items.size());
  for (std::size_t i = 0; i < by_all.items.size(); ++i)
    EXPECT_NEAR(by_all.items[i].volume_ml, by_dish.items[i].volume_ml, 0.1 * by_dish.items[i].volume_ml);
}

}  // namespace
}  // namespace traygauge::tables
