// The refusals of the later stages, each by an input that has that fault and no other: corresponding points
// computed from the scene itself, so that features and matching play no part.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "tests/core/paper/paper_bench.hpp"

namespace traygauge::paper {
namespace {

using Pixels = std::vector<std::uint8_t>;
using Motion = std::function<Vec3(const Vec3&)>;

class LateRefusal : public testing::Test {
 protected:
  // Points of dish, solid and table that both cameras see.
  std::vector<GivenMatch> scene_points(unsigned seed = 1) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(0.0, kTrayWidthPx);
    std::uniform_real_distribution<double> y(0.0, kTrayHeightPx);
    std::vector<GivenMatch> matches;
    while (matches.size() < 2000) {
      Vec3 point;
      const Vec2 pixel(x(random), y(random));
      if (!surface_point(tray_.solid, tray_.cameras[0], pixel, point)) continue;
      if (is_visible(tray_.solid, tray_.cameras[1], point))
        matches.push_back({pixel, tray_.cameras[1].project(point)});
    }
    return matches;
  }
  // Points of the print within so many mm of its corner; `moved` is where the card lies in the second
  // picture.
  std::vector<GivenCardMatch> card_points(std::size_t count, double side_mm = 100.0,
                                          const Motion& moved = std::identity{}, unsigned seed = 2) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> along(1.0, 1.0 + std::min(83.0, side_mm));
    std::uniform_real_distribution<double> across(1.0, 1.0 + std::min(51.0, side_mm));
    std::vector<GivenCardMatch> matches;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 on_card(along(random), across(random));
      const Vec3 point(kCardLeft_mm + on_card.x(), kCardTop_mm - on_card.y(), 0.0);
      matches.push_back({on_card, tray_.cameras[0].project(point), tray_.cameras[1].project(moved(point))});
    }
    return matches;
  }

  Measurement measure(MeasuringBench& bench, const std::vector<GivenCardMatch>& card, const ViewInput& first,
                      const ViewInput& second) const {
    EXPECT_TRUE(bench.estimator.add_view_without_features(first).ok());
    EXPECT_TRUE(bench.estimator.add_view_without_features(second).ok());
    EXPECT_TRUE(bench.estimator.set_matches(scene_points(), card).ok());
    return bench.estimator.estimate(1);
  }
  StatusCode status_of(const std::vector<GivenCardMatch>& card) const {
    return status_of(configuration_of(tray_), card, tray_.view(0), tray_.view(1));
  }
  StatusCode status_of(const Configuration& configuration) const {
    return status_of(configuration, card_points(60), tray_.view(0), tray_.view(1));
  }
  StatusCode status_of(const Configuration& configuration, const std::vector<GivenCardMatch>& card,
                       const ViewInput& first, const ViewInput& second) const {
    MeasuringBench bench(configuration);
    const StatusCode code = measure(bench, card, first, second).status.code();
    if (code != StatusCode::partial) {
      EXPECT_EQ(code == StatusCode::ok, !bench.estimator.estimate(1).items.empty()) << name(code);
    }
    return code;
  }
  static ImageView<const std::uint8_t> view_of(const Pixels& pixels) {
    return {pixels.data(), kTrayWidthPx, kTrayHeightPx};
  }

  const TrayScene& tray_ = default_tray();
};

TEST_F(LateRefusal, TheScenesOwnPointsMeasureIt) {
  MeasuringBench bench(configuration_of(tray_));
  const Measurement measurement = measure(bench, card_points(60), tray_.view(0), tray_.view(1));
  ASSERT_TRUE(measurement.status.ok()) << name(measurement.status.code());
  EXPECT_NEAR(measurement.items[0].volume_ml, tray_.volume_ml(), 0.04 * tray_.volume_ml());
}

TEST_F(LateRefusal, ACardThatTurnedContradictsTheScene) {
  for (const double turn_deg : {15.0, -25.0, 40.0}) {
    const double turn = turn_deg * std::numbers::pi / 180.0;
    const Vec3 middle(kCardLeft_mm + 42.8, kCardTop_mm - 27.0, 0.0);
    const Motion turned = [&](const Vec3& point) {
      return Vec3(middle + rotation_about(Vec3(0.0, 0.0, turn)) * (point - middle));
    };
    EXPECT_EQ(status_of(card_points(60, 100.0, turned)), StatusCode::pose_contradicts_card) << turn_deg;
  }
}

// Points that lie too near each other for the distances that count.
TEST_F(LateRefusal, NoDistancesOnTheCardGiveNoScale) {
  Configuration configuration = configuration_of(tray_);
  configuration.card_search.scale.min_distance_fraction = 0.7;
  EXPECT_EQ(status_of(configuration, card_points(60, 45.0), tray_.view(0), tray_.view(1)),
            StatusCode::scale_not_found);
}

// A bent card: its points are where they should be on the print, but on no plane.
TEST_F(LateRefusal, ABentCardGivesNoTable) {
  const auto bent = [](const Vec3& point) {
    const double along = (point.x() - kCardLeft_mm) / 85.6;
    return Vec3(point.x(), point.y(), 4.0 * std::sin(4.0 * std::numbers::pi * along));
  };
  auto card = card_points(60);
  for (GivenCardMatch& match : card) {
    const Vec3 point =
        bent(Vec3(kCardLeft_mm + match.pattern_mm.x(), kCardTop_mm - match.pattern_mm.y(), 0.0));
    match.first = tray_.cameras[0].project(point);
    match.second = tray_.cameras[1].project(point);
  }
  EXPECT_EQ(status_of(card), StatusCode::table_not_found);
}

// The memory of the rectified pictures, and the range of disparities, are what the configuration reserves.
TEST_F(LateRefusal, MoreRowsOrDisparitiesThanReserved) {
  Configuration rows = configuration_of(tray_);
  rows.rectification.max_rows = 40;
  EXPECT_EQ(status_of(rows), StatusCode::rectification_failed);
  Configuration disparities = configuration_of(tray_);
  disparities.disparity_range.max_count = 20;
  EXPECT_EQ(status_of(disparities), StatusCode::disparity_range_too_large);
}

// Another dish's label all around: no side of the border is the rim against the table.
TEST_F(LateRefusal, ADishWithinAnotherShowsNoRim) {
  std::array<Pixels, 2> labels = {tray_.views[0].labels, tray_.views[1].labels};
  for (Pixels& pixels : labels) {
    for (std::uint8_t& label : pixels) label = label == kBackgroundLabel ? 201 : label;
  }
  EXPECT_EQ(status_of(configuration_of(tray_), card_points(60), tray_.view(0, view_of(labels[0])),
                      tray_.view(1, view_of(labels[1]))),
            StatusCode::rim_not_found);
}

// One outline holds the left half of the dish and a bit more, the other the right half.
TEST_F(LateRefusal, HalvesOfTheDishGiveTooLittleDepth) {
  constexpr int kOverlap_px = 20;
  std::array<Pixels, 2> halves = {tray_.views[0].labels, tray_.views[1].labels};
  for (std::size_t v = 0; v < 2; ++v) {
    const int middle = static_cast<int>(tray_.cameras[v].project(Vec3::Zero()).x());
    for (std::size_t i = 0; i < halves[v].size(); ++i) {
      const int right_of_middle_px = static_cast<int>(i) % kTrayWidthPx - middle;
      const bool is_kept = v == 0 ? right_of_middle_px < kOverlap_px : right_of_middle_px > -kOverlap_px;
      if (is_on_dish(halves[v][i]) && !is_kept) halves[v][i] = kBackgroundLabel;
    }
  }
  EXPECT_EQ(status_of(configuration_of(tray_), card_points(60), tray_.view(0, view_of(halves[0])),
                      tray_.view(1, view_of(halves[1]))),
            StatusCode::too_little_depth);
}

// A patch of the bare dish, called food, of a dish whose bottom is said to be 5 mm up.
TEST_F(LateRefusal, AnItemBelowTheBottom) {
  const std::array<DishModel, 1> raised = {DishModel{{160.0, 160.0}, 5.0, 5.0}};
  Configuration configuration = configuration_of(tray_);
  configuration.dishes = raised;
  std::array<Pixels, 2> labels = {tray_.views[0].labels, tray_.views[1].labels};
  for (std::size_t v = 0; v < 2; ++v) {
    for (int y = 0; y < kTrayHeightPx; ++y) {
      for (int x = 0; x < kTrayWidthPx; ++x) {
        std::uint8_t& label = labels[v][static_cast<std::size_t>(y * kTrayWidthPx + x)];
        Vec3 point;
        if (label != kDishLabel || !surface_point(tray_.solid, tray_.cameras[v], Vec2(x, y), point)) continue;
        if ((point.head<2>() - Vec2(0.0, 60.0)).norm() < 12.0) label = 3;
      }
    }
  }
  MeasuringBench bench(configuration);
  const Measurement measurement =
      measure(bench, card_points(60), tray_.view(0, view_of(labels[0])), tray_.view(1, view_of(labels[1])));
  EXPECT_EQ(measurement.status.code(), StatusCode::partial) << name(measurement.status.code());
  ASSERT_EQ(measurement.items.size(), 2U);
  EXPECT_EQ(measurement.items[0].status, StatusCode::ok);
  EXPECT_EQ(measurement.items[1].status, StatusCode::item_below_dish)
      << name(measurement.items[1].status) << " " << measurement.items[1].volume_ml;
}

// Pictures that share the card alone: its points are a small plane, which a turn of the camera explains.
TEST_F(LateRefusal, OnlyTheCardInCommonIsNotCloseness) {
  MeasuringBench bench(configuration_of(tray_));
  ASSERT_TRUE(bench.estimator.add_view_without_features(tray_.view(0)).ok());
  ASSERT_TRUE(bench.estimator.add_view_without_features(tray_.view(1)).ok());
  const auto card = card_points(300);
  std::vector<GivenMatch> matches;
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.5);
  const Mat3 turn = rotation_about(Vec3(0.02, 0.05, 0.1));
  for (const GivenCardMatch& match : card) {
    const PinholeCamera& camera = tray_.cameras[0].pinhole;
    const Vec3 ray = turn * camera.ray(match.first).homogeneous();
    const Vec2 second = camera.pixel(ray.hnormalized());
    matches.push_back({match.first, second + Vec2(noise(random), noise(random))});
  }
  ASSERT_TRUE(bench.estimator.set_matches(matches, card).ok());
  EXPECT_EQ(bench.estimator.estimate(1).status.code(), StatusCode::too_few_matches);
}

}  // namespace
}  // namespace traygauge::paper
