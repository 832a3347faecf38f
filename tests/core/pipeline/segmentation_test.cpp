// What is said of labels that were found, and when the card is blamed instead.
#include "core/pipeline/segmentation.hpp"

#include <gtest/gtest.h>

namespace traygauge {
namespace {

TEST(Segmentation, BlamesADoubtfulCardForWhatWasNotMeasured) {
  Segmentation found;
  for (const StatusCode code : {StatusCode::ok, StatusCode::partial, StatusCode::dish_unknown}) {
    EXPECT_EQ(blame_card(found, code).code(), code);
  }
  found.is_card_doubtful = true;
  EXPECT_EQ(blame_card(found, StatusCode::ok).code(), StatusCode::ok);
  EXPECT_EQ(blame_card(found, StatusCode::partial).code(), StatusCode::partial);
  EXPECT_EQ(blame_card(found, StatusCode::dish_unknown).code(), StatusCode::card_hidden);
}

TEST(Segmentation, WarnsOfEachDoubtAndNothingElse) {
  Segmentation found;
  found.dish_count = 2;
  found.dishes[1].label = 201;
  WarningSet none;
  warn_about_labels(found, none);
  for (std::size_t i = 0; i < kWarningCount; ++i) EXPECT_FALSE(none.holds(static_cast<Warning>(i))) << i;

  found.dishes[0].is_split_doubtful = true;
  found.dishes[1].status = StatusCode::dish_unknown;
  found.is_card_doubtful = true;
  WarningSet warnings;
  warn_about_labels(found, warnings);
  EXPECT_TRUE(warnings.holds(Warning::items_doubtful));
  EXPECT_TRUE(warnings.holds(Warning::dish_not_found));
  EXPECT_TRUE(warnings.holds(Warning::card_partly_hidden));
  EXPECT_TRUE(found.has_doubtful_items());
  EXPECT_FALSE(found.has_all_dishes());

  Segmentation missing;
  missing.misses_hint = true;
  WarningSet hint;
  warn_about_labels(missing, hint);
  EXPECT_TRUE(hint.holds(Warning::items_doubtful));
  EXPECT_TRUE(missing.has_doubtful_items());

  Segmentation full;
  full.leaves_food = true;
  WarningSet rest;
  warn_about_labels(full, rest);
  EXPECT_TRUE(rest.holds(Warning::unknown_object));
}

TEST(Segmentation, FoodToldByHeightAloneIsDoubtful) {
  Segmentation found;
  found.dish_count = 1;
  found.dishes[0].is_told_by_height = true;
  WarningSet warnings;
  warn_about_labels(found, warnings);
  EXPECT_TRUE(warnings.holds(Warning::items_doubtful));
  EXPECT_TRUE(found.has_doubtful_items());
}

// What a dish beyond dish_count holds is of an earlier tray.
TEST(Segmentation, CountsDishesOfThisTrayAlone) {
  Segmentation found;
  found.dish_count = 1;
  found.dishes[1].status = StatusCode::dish_unknown;
  found.dishes[1].is_split_doubtful = true;
  EXPECT_TRUE(found.has_all_dishes());
  EXPECT_FALSE(found.has_doubtful_items());
}

}  // namespace
}  // namespace traygauge
