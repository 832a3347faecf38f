#include "core/labels/label_borders.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "tests/support/allocated.hpp"

namespace traygauge {
namespace {

// A yolk (3) in its white (2), on a dish (1) beside another item (9).
constexpr std::array<std::uint8_t, 20> kFriedEgg = {
    2, 2, 2, 2, 1,  //
    2, 3, 3, 2, 1,  //
    2, 3, 2, 2, 1,  //
    2, 2, 2, 9, 9,
};

TEST(LabelBorders, CountSidesOfPixels) {
  const std::array<ImageView<const std::uint8_t>, 1> view = {{{kFriedEgg.data(), 5, 4}}};
  test::Allocated<LabelBorders> borders;
  std::fill(borders->borders_px.begin(), borders->borders_px.end(), 77U);  // of a tray before
  count_borders(view, *borders);
  EXPECT_EQ(borders->border_px(3, 2), 8U);
  EXPECT_EQ(borders->border_px(3, 1) + borders->border_px(3, 9), 0U);
  EXPECT_EQ(borders->border_px(2, 3), 8U);
  EXPECT_EQ(borders->border_px(2, 1), 3U);
  EXPECT_EQ(borders->border_px(2, 9), 2U);
  EXPECT_EQ(borders->border_px(2, 2), 0U) << "it does not touch itself";
  for (std::size_t other = 0; other < kByteValues; ++other)
    EXPECT_EQ(borders->border_px(7, other), 0U) << "there is no such label";
}

TEST(LabelBorders, AreSummedOverViews) {
  const ImageView<const std::uint8_t> view{kFriedEgg.data(), 5, 4};
  const std::array<ImageView<const std::uint8_t>, 2> views = {view, view};
  test::Allocated<LabelBorders> borders;
  count_borders(views, *borders);
  EXPECT_EQ(borders->border_px(3, 2), 16U);
}

}  // namespace
}  // namespace traygauge
