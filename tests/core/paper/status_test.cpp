// Each way to fail, by an input that has that fault and no other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "tests/core/paper/paper_bench.hpp"

namespace traygauge::paper {
namespace {

using Pixels = std::vector<std::uint8_t>;

ImageView<const std::uint8_t> view_of(const Pixels& pixels) {
  return {pixels.data(), kTrayWidthPx, kTrayHeightPx};
}

ViewInput with_gray(ViewInput input, const Pixels& gray) {
  input.frame.data = gray.data();
  return input;
}

Pixels relabel(Pixels labels, std::uint8_t from, std::uint8_t to) {
  std::replace(labels.begin(), labels.end(), from, to);
  return labels;
}

class StatusTest : public testing::Test {
 protected:
  const TrayScene& tray_ = default_tray();
  MeasuringBench bench_{configuration_of(tray_)};

  // The same fault in the first and in the second view.
  void expect_view_fault(StatusCode code, const ViewInput& first, const ViewInput& second) {
    EXPECT_EQ(bench_.measure(first, tray_.view(1)).status.code(), code) << "first view";
    EXPECT_TRUE(bench_.estimator.estimate(1).items.empty());
    EXPECT_EQ(bench_.measure(tray_.view(0), second).status.code(), code) << "second view";
    EXPECT_TRUE(bench_.measure(tray_).status.ok()) << "and the next measurement is right";
  }
  void expect_label_fault(StatusCode code, Pixels (*spoil)(const Pixels&)) {
    const Pixels first = spoil(tray_.views[0].labels);
    const Pixels second = spoil(tray_.views[1].labels);
    expect_view_fault(code, tray_.view(0, view_of(first)), tray_.view(1, view_of(second)));
  }
  void expect_gray_fault(StatusCode code, const Pixels& gray) {
    expect_view_fault(code, with_gray(tray_.view(0), gray), with_gray(tray_.view(1), gray));
  }
  StatusCode status_with(Configuration configuration, const ViewInput& first, const ViewInput& second) const {
    MeasuringBench bench(configuration);
    return bench.measure(first, second).status.code();
  }
};

TEST_F(StatusTest, FrameMissing) {
  expect_view_fault(StatusCode::frame_missing, ViewInput{{}, tray_.view(0).labels, {}, {}},
                    ViewInput{{}, tray_.view(1).labels, {}, {}});
  bench_.estimator.reset();
  EXPECT_EQ(bench_.estimator.estimate(1).status.code(), StatusCode::frame_missing) << "no view at all";
  EXPECT_TRUE(bench_.estimator.add_view(tray_.view(0)).ok());
  EXPECT_EQ(bench_.estimator.estimate(1).status.code(), StatusCode::frame_missing) << "one view";
}

TEST_F(StatusTest, FrameSizeMismatch) {
  for (const auto& [width, height] : {std::pair{kTrayWidthPx - 1, kTrayHeightPx},
                                      {kTrayWidthPx, kTrayHeightPx - 1},
                                      {kTrayHeightPx, kTrayWidthPx}}) {
    ViewInput first = tray_.view(0);
    ViewInput second = tray_.view(1);
    first.frame.width = second.frame.width = width;
    first.frame.height = second.frame.height = height;
    expect_view_fault(StatusCode::frame_size_mismatch, first, second);
  }
}

TEST_F(StatusTest, FrameBeyondTheReservedSize) {
  Configuration configuration = configuration_of(tray_);
  configuration.limits.max_frame_width = kTrayWidthPx - 1;
  EXPECT_EQ(status_with(configuration, tray_.view(0), tray_.view(1)), StatusCode::frame_size_mismatch);
}

TEST_F(StatusTest, LensOfAViewIsChecked) {
  ViewInput first = tray_.view(0);
  ViewInput second = tray_.view(1);
  first.lens = second.lens = configuration_of(tray_).lens;
  first.lens->pinhole.fx_px = second.lens->pinhole.fx_px = 0.0;
  expect_view_fault(StatusCode::invalid_configuration, first, second);
}

TEST_F(StatusTest, LabelsSizeMismatch) {
  const ImageView<const std::uint8_t> smaller =
      tray_.view(0).labels.sub(0, 0, kTrayWidthPx, kTrayHeightPx - 1);
  expect_view_fault(StatusCode::labels_size_mismatch, tray_.view(0, smaller), tray_.view(1, smaller));
  expect_view_fault(StatusCode::labels_size_mismatch, tray_.view(0, {}), tray_.view(1, {}));
}

TEST_F(StatusTest, TooDarkTooBrightUniformBlurred) {
  expect_gray_fault(StatusCode::frame_too_dark, Pixels(kTrayWidthPx * kTrayHeightPx, 2));
  expect_gray_fault(StatusCode::frame_too_bright, Pixels(kTrayWidthPx * kTrayHeightPx, 255));
  expect_gray_fault(StatusCode::too_few_features, Pixels(kTrayWidthPx * kTrayHeightPx, 128));
  Pixels blurred = tray_.views[0].gray;
  cv::Mat picture(kTrayHeightPx, kTrayWidthPx, CV_8UC1, blurred.data());
  cv::GaussianBlur(picture, picture, {0, 0}, 40.0);
  cv::normalize(picture, picture, 60, 200, cv::NORM_MINMAX);
  cv::GaussianBlur(picture, picture, {0, 0}, 20.0);
  expect_gray_fault(StatusCode::too_few_features, blurred);
}

TEST_F(StatusTest, NoDishNoFoodCutOff) {
  expect_label_fault(StatusCode::no_dish_label,
                     [](const Pixels& labels) { return Pixels(labels.size(), 0); });
  expect_label_fault(StatusCode::no_food_label, [](const Pixels& labels) { return relabel(labels, 2, 1); });
  expect_label_fault(StatusCode::dish_cut_off, [](const Pixels& labels) {
    Pixels cut = labels;
    std::fill_n(cut.begin() + 300, 100, kDishLabel);  // up to the upper edge
    return cut;
  });
}

TEST_F(StatusTest, IdenticalViews) {
  EXPECT_EQ(bench_.measure(tray_.view(0), tray_.view(0)).status.code(), StatusCode::views_identical);
  EXPECT_TRUE(bench_.estimator.estimate(2).items.empty());
}

// Another picture from the same place: sensor noise is all that differs.
TEST_F(StatusTest, SamePlaceOtherNoise) {
  cv::RNG random(11);
  Pixels noisy = tray_.views[0].gray;
  for (std::uint8_t& pixel : noisy) pixel = cv::saturate_cast<std::uint8_t>(pixel + random.gaussian(4.0));
  const StatusCode code = bench_.measure(tray_.view(0), with_gray(tray_.view(0), noisy)).status.code();
  EXPECT_TRUE(code == StatusCode::views_identical || code == StatusCode::views_too_close) << name(code);
}

TEST_F(StatusTest, ViewsTooClose) {
  TrayOptions options;
  options.tilt_deg = {6.0, 7.5};
  const TrayScene close(options);
  EXPECT_EQ(bench_.measure(close).status.code(), StatusCode::views_too_close);
  EXPECT_TRUE(bench_.estimator.estimate(2).items.empty());
}

TEST_F(StatusTest, ViewsTooFarApart) {
  Configuration configuration = configuration_of(tray_);
  configuration.geometry.max_angle_deg = 15.0;
  EXPECT_EQ(status_with(configuration, tray_.view(0), tray_.view(1)), StatusCode::views_too_far_apart);
}

// Dish and table differ, and the card is the same: the views do not belong together.
TEST_F(StatusTest, ViewsOfDifferentDishes) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Measurement& measurement = bench_.measure(tray_.view(0), other_tray().view(1), seed);
    EXPECT_FALSE(measurement.status.ok()) << name(measurement.status.code());
    EXPECT_TRUE(measurement.items.empty());
  }
}

TEST_F(StatusTest, DifferentScenesWithoutACard) {
  TrayOptions options;
  options.with_card = false;
  const TrayScene one(options);
  options.texture_seed = 99;
  const TrayScene other(options);
  const StatusCode code = bench_.measure(one.view(0), other.view(1)).status.code();
  EXPECT_TRUE(code == StatusCode::too_few_matches || code == StatusCode::pose_not_found) << name(code);
}

TEST_F(StatusTest, CardNotFound) {
  TrayOptions options;
  options.with_card = false;
  const TrayScene bare(options);
  EXPECT_EQ(bench_.measure(bare).status.code(), StatusCode::card_not_found);
  for (std::uint32_t seed = 50; seed < 55; ++seed) {
    const TrayPattern wrong(seed);
    Configuration configuration = configuration_of(tray_);
    configuration.card.pattern = wrong.view();
    EXPECT_EQ(status_with(configuration, tray_.view(0), tray_.view(1)), StatusCode::card_not_found) << seed;
  }
}

TEST_F(StatusTest, LabelsExchangedOrTakenTwice) {
  const auto first = tray_.view(0).labels;
  const auto second = tray_.view(1).labels;
  for (const auto& [a, b] : {std::pair{second, first}, {first, first}, {second, second}}) {
    const Measurement& measurement = bench_.measure(tray_.view(0, a), tray_.view(1, b));
    EXPECT_EQ(measurement.status.code(), StatusCode::labels_inconsistent) << name(measurement.status.code());
    EXPECT_TRUE(measurement.items.empty());
  }
}

// At a small angle the outlines move little, but so does everything.
TEST_F(StatusTest, LabelsExchangedAtFiveDegrees) {
  TrayOptions options;
  options.tilt_deg = {6.0, 11.0};
  const TrayScene close(options);
  ASSERT_TRUE(bench_.measure(close).status.ok());
  const auto first = close.view(0).labels;
  const auto second = close.view(1).labels;
  for (const auto& [a, b] : {std::pair{second, first}, {first, first}, {second, second}}) {
    EXPECT_EQ(bench_.measure(close.view(0, a), close.view(1, b)).status.code(),
              StatusCode::labels_inconsistent);
  }
}

TEST_F(StatusTest, DishUnknown) {
  for (const DishModel& dish : {DishModel{{200.0, 200.0}, 0.0, 0.0}, DishModel{{160.0, 130.0}, 0.0, 0.0},
                                DishModel{{160.0, 160.0}, 20.0, 0.0}}) {
    const std::array<DishModel, 1> dishes = {dish};
    Configuration configuration = configuration_of(tray_);
    configuration.dishes = dishes;
    EXPECT_EQ(status_with(configuration, tray_.view(0), tray_.view(1)), StatusCode::dish_unknown);
  }
}

TEST_F(StatusTest, DishIsChosenAmongCandidates) {
  const std::array<DishModel, 3> dishes = {DishModel{{200.0, 200.0}, 0.0, 0.0}, tray_.dish[0],
                                           DishModel{{160.0, 160.0}, 5.0, 1.0}};
  Configuration configuration = configuration_of(tray_);
  configuration.dishes = dishes;
  MeasuringBench bench(configuration);
  const Measurement& measurement = bench.measure(tray_);
  EXPECT_TRUE(measurement.status.ok());
  EXPECT_EQ(measurement.report.dish_index, 1);
  EXPECT_TRUE(measurement.warnings.holds(Warning::dish_guessed));
}

// An item in one view only, and one of a few pixels: the solid is measured all the same.
TEST_F(StatusTest, HiddenAndTinyItems) {
  Pixels first = tray_.views[0].labels;
  Pixels second = tray_.views[1].labels;
  const auto mark = [](Pixels& labels, int x, int y, int side, std::uint8_t label) {
    for (int i = 0; i < side * side; ++i) {
      std::uint8_t& pixel = labels[static_cast<std::size_t>((y + i / side) * kTrayWidthPx + x + i % side)];
      ASSERT_EQ(pixel, kDishLabel);
      pixel = label;
    }
  };
  const Vec2 place = tray_.cameras[0].project({0.0, 65.0, 0.0});
  const Vec2 other_place = tray_.cameras[1].project({0.0, 65.0, 0.0});
  const Vec2 hidden = tray_.cameras[0].project({0.0, -65.0, 0.0});
  mark(first, static_cast<int>(place.x()), static_cast<int>(place.y()), 4, 3);
  mark(second, static_cast<int>(other_place.x()), static_cast<int>(other_place.y()), 4, 3);
  mark(first, static_cast<int>(hidden.x()), static_cast<int>(hidden.y()), 12, 4);
  const Measurement& measurement =
      bench_.measure(tray_.view(0, view_of(first)), tray_.view(1, view_of(second)));
  EXPECT_EQ(measurement.status.code(), StatusCode::partial) << name(measurement.status.code());
  ASSERT_EQ(measurement.items.size(), 3U);
  EXPECT_EQ(measurement.items[0].status, StatusCode::ok);
  EXPECT_EQ(measurement.items[1].status, StatusCode::item_too_small);
  EXPECT_EQ(measurement.items[2].status, StatusCode::item_hidden);
}

TEST_F(StatusTest, AThirdViewIsRefusedAndChangesNothing) {
  const auto expected = numbers_of(bench_.measure(tray_));
  EXPECT_EQ(bench_.estimator.add_view(other_tray().view(0)).code(), StatusCode::wrong_call);
  EXPECT_EQ(bench_.estimator.add_view_without_features(tray_.view(0)).code(), StatusCode::wrong_call);
  EXPECT_TRUE(have_equal_bits(expected, numbers_of(bench_.estimator.estimate(1))));
}

}  // namespace
}  // namespace traygauge::paper
