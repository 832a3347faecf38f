// When another lens is tried, when it explains everything, and what is said then.
#include "core/pipeline/lens_doubt.hpp"

#include <gtest/gtest.h>

#include <array>

namespace traygauge {
namespace {

Measurement agreeing(double scale_percent) {
  Measurement measurement;
  measurement.checks.add({CheckKind::scale_percent, 1, scale_percent, 0.3, 1.0});
  return measurement;
}

TEST(LensDoubt, AChangeScalesBothFocalLengthsAndKeepsTheRest) {
  LensModel lens{1600, 1200, {1380.0, 1390.0, 800.0, 600.0}, -0.06, 0.01};
  LensModel longer = LensChange{1.1}.of(lens);
  EXPECT_DOUBLE_EQ(longer.pinhole.fx_px, 1518.0);
  EXPECT_DOUBLE_EQ(longer.pinhole.fy_px, 1529.0);
  longer.pinhole.fx_px = lens.pinhole.fx_px;
  longer.pinhole.fy_px = lens.pinhole.fy_px;
  EXPECT_EQ(longer, lens);
  lens.k1 -= 0.1;
  EXPECT_EQ(LensChange({1.0, -0.1}).of({1600, 1200, lens.pinhole, -0.06, 0.01}), lens);
}

// Each contradiction by itself, be it of the pair, of an item or a mere doubt, and nothing else.
TEST(LensDoubt, IsRaisedByContradictionsAlone) {
  EXPECT_FALSE(may_be_the_lens({}));
  for (const StatusCode code : {StatusCode::card_lifted, StatusCode::pose_contradicts_card,
                                StatusCode::labels_inconsistent, StatusCode::dish_unknown}) {
    Measurement pair;
    pair.status = code;
    EXPECT_TRUE(may_be_the_lens(pair)) << name(code);
    std::array<ItemResult, 2> items;
    items[1].status = code;
    Measurement of_item;
    of_item.status = StatusCode::partial;
    of_item.items = items;
    EXPECT_TRUE(may_be_the_lens(of_item)) << name(code);
  }
  for (const StatusCode code :
       {StatusCode::card_not_found, StatusCode::too_blurred, StatusCode::views_identical,
        StatusCode::item_textureless, StatusCode::item_moved, StatusCode::card_not_flat}) {
    Measurement pair;
    pair.status = code;
    EXPECT_FALSE(may_be_the_lens(pair)) << name(code);
  }
  for (std::size_t i = 0; i < kWarningCount; ++i) {
    const auto warning = static_cast<Warning>(i);
    Measurement doubted;
    doubted.warnings.raise(warning, 2);
    const bool is_contradiction = warning == Warning::dish_moved || warning == Warning::scale_disagrees ||
                                  warning == Warning::card_lifted || warning == Warning::dish_differs;
    EXPECT_EQ(may_be_the_lens(doubted), is_contradiction) << name(warning);
  }
}

TEST(LensDoubt, ALensExplainsOnlyWhereEveryDishConfirmsTheScale) {
  Measurement unchecked;
  EXPECT_FALSE(scale_if_all_agrees(unchecked));
  Measurement measurement = agreeing(0.1);
  EXPECT_EQ(scale_if_all_agrees(measurement), 0.1);
  measurement.checks.add({CheckKind::scale_percent, 201, -0.7, 0.3, 1.0});
  EXPECT_EQ(scale_if_all_agrees(measurement), 0.7) << "the worst of all dishes";
  measurement.status = StatusCode::partial;
  EXPECT_FALSE(scale_if_all_agrees(measurement));
  for (const Warning warning : {Warning::dish_moved, Warning::item_moved, Warning::card_not_flat,
                                Warning::dish_not_found, Warning::unknown_object}) {
    Measurement doubted = agreeing(0.1);
    doubted.warnings.raise(warning);
    EXPECT_FALSE(scale_if_all_agrees(doubted)) << name(warning);
  }
}

TEST(LensDoubt, NamesTheLensOfAPairThatWasRefused) {
  std::array<ItemResult, 2> items;
  for (ItemResult& item : items) item.status = StatusCode::card_lifted;
  Measurement measurement = agreeing(1.5);
  measurement.status = StatusCode::card_lifted;
  measurement.items = items;
  blame_lens({1.1}, {}, items, measurement);
  EXPECT_EQ(measurement.status.code(), StatusCode::lens_does_not_fit);
  for (const ItemResult& item : items) EXPECT_EQ(item.status, StatusCode::lens_does_not_fit);
  const Check& check = measurement.checks.items().back();
  EXPECT_EQ(check.kind, CheckKind::focal_percent);
  EXPECT_NEAR(check.value, 10.0, 1e-9);
  EXPECT_NEAR(check.sigma, 1.4434, 1e-3);
  EXPECT_EQ(check.verdict, Verdict::refused);
}

TEST(LensDoubt, WarnsOfTheLensOfAPairThatWasMeasured) {
  std::array<ItemResult, 2> items;
  items[1].status = StatusCode::dish_moved;
  Measurement measurement = agreeing(1.5);
  measurement.status = StatusCode::partial;
  measurement.items = items;
  blame_lens({1.0, -0.1}, {}, items, measurement);
  EXPECT_EQ(measurement.status.code(), StatusCode::partial);
  EXPECT_EQ(items[0].status, StatusCode::ok);
  EXPECT_EQ(items[1].status, StatusCode::dish_moved);
  EXPECT_TRUE(measurement.warnings.holds(Warning::lens_does_not_fit));
  EXPECT_EQ(measurement.checks.items().size(), 1U) << "no focal length is blamed";
}

}  // namespace
}  // namespace traygauge
