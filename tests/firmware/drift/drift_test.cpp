#include "firmware/drift/drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace traygauge::test {
namespace {

constexpr DriftParams kParams;

bool drifts(WatchedCheck check, const MedianEstimate& last,
            const std::optional<MedianEstimate>& first = std::nullopt) {
  return judge_trend(check, last, first, kParams).drifts;
}

double above(double value) {
  return std::nextafter(value, std::numeric_limits<double>::infinity());
}

TEST(Drift, TheParametersAreThoseThatWereAgreed) {
  EXPECT_EQ(kParams.values, 50U);
  EXPECT_EQ(kParams.min_values, 20U);
  EXPECT_EQ(kParams.max_scale_change_percent, 0.3);
  EXPECT_EQ(kParams.max_dish_height_change_mm, 0.2);
  EXPECT_EQ(kParams.max_scale_percent, 0.6);
  EXPECT_EQ(kParams.max_dish_height_mm, 1.0);
  EXPECT_EQ(kParams.max_glaze_height_mm, 0.4);
  EXPECT_EQ(kParams.max_blur_ratio, 1.3);
  EXPECT_EQ(kParams.sigmas, 3.0);
}

TEST(Drift, OfScaleAndHeightBeginsBeyondTheLimit) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_FALSE(drifts(WatchedCheck::scale_percent, {sign * 0.6, 0.01, 50}));
    EXPECT_TRUE(drifts(WatchedCheck::scale_percent, {sign * above(0.6), 0.01, 50}));
    EXPECT_FALSE(drifts(WatchedCheck::dish_height_mm, {sign * 1.0, 0.01, 50}));
    EXPECT_TRUE(drifts(WatchedCheck::dish_height_mm, {sign * above(1.0), 0.01, 50}));
    EXPECT_FALSE(drifts(WatchedCheck::glaze_height_mm, {sign * 0.4, 0.01, 50}));
    EXPECT_TRUE(drifts(WatchedCheck::glaze_height_mm, {sign * above(0.4), 0.01, 50}));
  }
}

TEST(Drift, BeginsBeyondThreeStandardErrors) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_FALSE(drifts(WatchedCheck::scale_percent, {sign * 0.75, 0.25, 50}));
    EXPECT_TRUE(drifts(WatchedCheck::scale_percent, {sign * above(0.75), 0.25, 50}));
    EXPECT_FALSE(drifts(WatchedCheck::dish_height_mm, {sign * 1.5, 0.5, 50}));
    EXPECT_TRUE(drifts(WatchedCheck::dish_height_mm, {sign * above(1.5), 0.5, 50}));
    EXPECT_FALSE(drifts(WatchedCheck::glaze_height_mm, {sign * 0.75, 0.25, 50}));
    EXPECT_TRUE(drifts(WatchedCheck::glaze_height_mm, {sign * above(0.75), 0.25, 50}));
  }
  EXPECT_TRUE(drifts(WatchedCheck::scale_percent, {0.7, 0.0, 50}));
}

TEST(Drift, NeedsTwentyValues) {
  const MedianEstimate sharp{0.8, 0.01, 20};
  for (const std::size_t count : {std::size_t{0}, std::size_t{19}}) {
    EXPECT_FALSE(drifts(WatchedCheck::scale_percent, {0.7, 0.01, count}));
    EXPECT_FALSE(drifts(WatchedCheck::dish_height_mm, {1.1, 0.01, count}));
    EXPECT_FALSE(drifts(WatchedCheck::scale_percent, {0.5, 0.01, count}, MedianEstimate{0.0, 0.01, 50}));
    EXPECT_FALSE(drifts(WatchedCheck::scale_percent, {0.5, 0.01, 50}, MedianEstimate{0.0, 0.01, count}));
    EXPECT_FALSE(drifts(WatchedCheck::glaze_height_mm, {0.5, 0.01, count}));
    EXPECT_FALSE(drifts(WatchedCheck::blur_px, {2.0, 0.01, count}, sharp));
    EXPECT_FALSE(drifts(WatchedCheck::blur_px, {2.0, 0.01, 50}, MedianEstimate{0.8, 0.01, count}));
  }
  EXPECT_TRUE(drifts(WatchedCheck::scale_percent, {0.7, 0.01, 20}));
  EXPECT_TRUE(drifts(WatchedCheck::dish_height_mm, {1.1, 0.01, 20}));
  EXPECT_TRUE(drifts(WatchedCheck::scale_percent, {0.5, 0.01, 20}, MedianEstimate{0.0, 0.01, 20}));
  EXPECT_TRUE(drifts(WatchedCheck::glaze_height_mm, {0.5, 0.01, 20}));
  EXPECT_TRUE(drifts(WatchedCheck::blur_px, {2.0, 0.01, 20}, sharp));
}

// What the light does to the edges of a station's dishes stays; a worn card changes.
TEST(Drift, OfScaleAndEdgesSinceTheFirstScansIsToldEarlier) {
  for (const double sign : {1.0, -1.0}) {
    const MedianEstimate scale{sign * -0.3, 0.01, 50};
    EXPECT_FALSE(drifts(WatchedCheck::scale_percent, {sign * -0.3, 0.01, 50}, scale));
    EXPECT_FALSE(drifts(WatchedCheck::scale_percent, {sign * -0.59, 0.01, 50}, scale));
    EXPECT_TRUE(drifts(WatchedCheck::scale_percent, {sign * -0.61, 0.01, 50}, scale));
    EXPECT_TRUE(drifts(WatchedCheck::scale_percent, {sign * 0.31, 0.01, 50}, scale));
    const MedianEstimate height{sign * 0.6, 0.01, 50};
    EXPECT_FALSE(drifts(WatchedCheck::dish_height_mm, {sign * 0.79, 0.01, 50}, height));
    EXPECT_TRUE(drifts(WatchedCheck::dish_height_mm, {sign * 0.81, 0.01, 50}, height));
    EXPECT_TRUE(drifts(WatchedCheck::dish_height_mm, {sign * 0.39, 0.01, 50}, height));
    EXPECT_FALSE(drifts(WatchedCheck::dish_height_mm, {sign * 0.19, 0.01, 50}, height)) << "mended";
    EXPECT_FALSE(drifts(WatchedCheck::scale_percent, {sign * 0.29, 0.01, 50}, scale)) << "mended";
  }
  // The errors of both count: 0.06 and 0.08 % make 0.1 %, of which three are 0.3 %.
  EXPECT_TRUE(drifts(WatchedCheck::scale_percent, {0.31, 0.08, 50}, MedianEstimate{0.0, 0.06, 50}));
  EXPECT_FALSE(drifts(WatchedCheck::scale_percent, {0.31, 0.08, 50}, MedianEstimate{0.0, 0.07, 50}));
}

TEST(Drift, OfBlurIsAgainstTheFirstScans) {
  const MedianEstimate first{0.8, 0.01, 50};
  EXPECT_FALSE(drifts(WatchedCheck::blur_px, {2.0, 0.01, 50})) << "there are no others to compare with";
  EXPECT_FALSE(drifts(WatchedCheck::blur_px, {1.3 * 0.8, 0.01, 50}, first));
  EXPECT_TRUE(drifts(WatchedCheck::blur_px, {above(1.3 * 0.8), 0.01, 50}, first));
  EXPECT_FALSE(drifts(WatchedCheck::blur_px, {0.4, 0.01, 50}, first)) << "sharper is no fault";
  // The errors of both count: 0.3 and 0.4 px make 0.5 px, of which three are 1.5 px.
  EXPECT_FALSE(drifts(WatchedCheck::blur_px, {2.5, 0.4, 50}, MedianEstimate{1.0, 0.3, 50}));
  EXPECT_TRUE(drifts(WatchedCheck::blur_px, {2.51, 0.4, 50}, MedianEstimate{1.0, 0.3, 50}));
}

TEST(Drift, SaysWhatWasFoundAndWhatToDo) {
  const auto sentence = [](WatchedCheck check, const MedianEstimate& last,
                           const std::optional<MedianEstimate>& first = std::nullopt) {
    return drift_sentence(judge_trend(check, last, first, kParams));
  };
  EXPECT_EQ(sentence(WatchedCheck::scale_percent, {0.4249, 0.0512, 50}),
            "In the last 50 trays the card made everything 0.42 % larger than the dishes say (± 0.05 %). "
            "Measure the "
            "card with a caliper, and look whether it is worn or another lies there.");
  EXPECT_NE(sentence(WatchedCheck::scale_percent, {-0.5, 0.05, 21})
                .find("21 trays the card made everything 0.50 % smaller"),
            std::string::npos);
  EXPECT_NE(sentence(WatchedCheck::dish_height_mm, {0.31, 0.04, 50})
                .find("0.31 mm above where the card puts them (± 0.04 mm)"),
            std::string::npos);
  EXPECT_NE(sentence(WatchedCheck::dish_height_mm, {-0.31, 0.04, 50}).find("0.31 mm below"),
            std::string::npos);
  EXPECT_NE(sentence(WatchedCheck::dish_height_mm, {-0.31, 0.04, 50}, MedianEstimate{0.05, 0.04, 50})
                .find("(± 0.04 mm), after 0.05 mm above in the first 50 that are stored. Look whether"),
            std::string::npos);
  EXPECT_EQ(sentence(WatchedCheck::glaze_height_mm, {1.02, 0.2, 23}),
            "In the last 23 trays bare glaze inside of the dishes came out 1.02 mm above where their "
            "descriptions put it (± 0.20 mm). Look whether they are the dishes that are described, and learn "
            "those in use anew with traygauge enrol-dish.");
  EXPECT_NE(
      sentence(WatchedCheck::blur_px, {1.2, 0.02, 50}, MedianEstimate{0.8, 0.01, 50})
          .find(
              "1.50 times as blurred as in the first 50 that are stored: 1.20 px (± 0.02 px), then 0.80 px"),
      std::string::npos);
}

}  // namespace
}  // namespace traygauge::test
