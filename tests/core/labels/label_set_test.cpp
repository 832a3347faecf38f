// Choices of labels against the standard library's sets.
#include "core/labels/label_set.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

TEST(LabelSet, HoldsWhatWasAddedAndNotRemoved) {
  std::mt19937 random(test::random_seed());
  std::uniform_int_distribution<int> value(0, 255);
  LabelSet set;
  std::set<int> truth;
  EXPECT_TRUE(set.empty());
  for (int i = 0; i < 2000; ++i) {
    const int label = value(random);
    if (value(random) < 128) {
      set.add(static_cast<std::uint8_t>(label));
      truth.insert(label);
    } else {
      set.remove(static_cast<std::uint8_t>(label));
      truth.erase(label);
    }
    ASSERT_EQ(set.empty(), truth.empty());
  }
  for (int label = 0; label < 256; ++label)
    EXPECT_EQ(set.contains(static_cast<std::uint8_t>(label)), truth.contains(label)) << label;
}

// As the capture contract numbers them: dish 1, items 2 to 199, further dishes from 201, the card 255.
TEST(LabelSet, OfASingleDishLeavesOutFurtherDishesAndTheCard) {
  constexpr LabelSet kSet = labels_of_single_dish();
  for (const int label : {1, 2, 100, 199}) EXPECT_TRUE(kSet.contains(static_cast<std::uint8_t>(label)));
  for (const int label : {0, 200, 201, 249, 255})
    EXPECT_FALSE(kSet.contains(static_cast<std::uint8_t>(label)));
}

}  // namespace
}  // namespace traygauge
