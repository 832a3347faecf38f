// The patterns of reference cards: the same for ever, unlike each other, and drawn as they are described.
#include "firmware/card/card_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <string>

#include "simulator/capture/content_hash.hpp"

namespace traygauge {
namespace {

// Cards are printed and lie in kitchens: these never change, new ones are added.
constexpr std::array<const char*, kCardPatterns> kHashes{
    "1bf6f1b42bd7d630", "ab426bf2367ae0b7", "c7f2990006aab688", "462b5dd7e69410f7",
    "96d3e503900e35bb", "01b202530f8405f0", "e2dd80d10c04be02", "cf0cc60250283888",
    "4b0674d07ce4f5f8", "d670bd03aec33da6", "d46b19cceacdf9f3", "3ecb564c1494d36b"};

double mean_difference(const Picture& a, const Picture& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
  return sum / static_cast<double>(a.pixels.size());
}

Picture turned_by_half(Picture picture) {
  std::reverse(picture.pixels.begin(), picture.pixels.end());
  return picture;
}

Picture mirrored(Picture picture) {
  for (auto row = picture.pixels.begin(); row != picture.pixels.end(); row += picture.size.width)
    std::reverse(row, row + picture.size.width);
  return picture;
}

// In 16ths of a unit.
struct Place {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

Place place_of(const CardPoint& point) {
  constexpr std::int64_t kPlaces = 16;
  return {kPlaces * point.x, kPlaces * point.y};
}

// By the number of sides that a ray to the right crosses, exactly.
bool is_inside(const CardShape& shape, const Place& place) {
  bool inside = false;
  for (std::size_t i = 0; i < 4; ++i) {
    const Place a = place_of(shape.corners[i]);
    const Place b = place_of(shape.corners[(i + 1) % 4]);
    if ((a.y > place.y) == (b.y > place.y)) continue;
    if (((place.x - a.x) * (b.y - a.y) < (place.y - a.y) * (b.x - a.x)) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

bool is_ink_at(const std::vector<CardShape>& drawing, const Place& place) {
  const auto top = std::find_if(drawing.rbegin(), drawing.rend(),
                                [&](const CardShape& shape) { return is_inside(shape, place); });
  return top != drawing.rend() && top->is_ink;
}

TEST(CardDrawing, PicturesStayAsTheyArePrinted) {
  for (int number = 1; number <= kCardPatterns; ++number)
    EXPECT_EQ(content_hash(card_picture(number).pixels), kHashes.at(static_cast<std::size_t>(number) - 1))
        << card_id(number);
}

TEST(CardDrawing, IdsAreUnlike) {
  std::set<std::string> ids;
  for (int number = 1; number <= kCardPatterns; ++number) ids.insert(card_id(number));
  EXPECT_EQ(ids.size(), static_cast<std::size_t>(kCardPatterns));
  EXPECT_TRUE(ids.contains("TG-01"));
}

TEST(CardDrawing, PicturesAreUnlikeHoweverTheyLie) {
  std::vector<Picture> pictures;
  for (int number = 1; number <= kCardPatterns; ++number) pictures.push_back(card_picture(number));
  constexpr double kUnlike = 40.0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    EXPECT_GT(mean_difference(pictures[i], mirrored(pictures[i])), kUnlike) << i;
    for (std::size_t j = 0; j <= i; ++j) {
      EXPECT_GT(mean_difference(pictures[i], turned_by_half(pictures[j])), kUnlike) << i << " " << j;
      if (j == i) continue;
      EXPECT_GT(mean_difference(pictures[i], pictures[j]), kUnlike) << i << " " << j;
    }
  }
}

TEST(CardDrawing, PixelsShowTheTopmostShape) {
  for (const int number : {1, 6, kCardPatterns}) {
    const std::vector<CardShape> drawing = draw_card(number);
    const Picture picture = picture_of(drawing, kCardPictureSize, 1);  // a sample in the middle of each pixel
    int compared = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); i += 97) {
      const auto pixel_x = static_cast<std::int64_t>(i) % kCardPictureSize.width;
      const auto pixel_y = static_cast<std::int64_t>(i) / kCardPictureSize.width;
      const Place place{8 * (2 * pixel_x + 1) * kCardWidthUnits / kCardPictureSize.width,
                        8 * (2 * pixel_y + 1) * kCardHeightUnits / kCardPictureSize.height};
      const bool is_ink = is_ink_at(drawing, place);
      // Samples and sides lie on a grid of 16ths: next to a side either colour is right.
      bool is_clear = true;
      for (const std::int64_t x : {-1, 1}) {
        for (const std::int64_t y : {-1, 1})
          is_clear = is_clear && is_ink_at(drawing, {place.x + x, place.y + y}) == is_ink;
      }
      if (!is_clear) continue;
      ++compared;
      EXPECT_EQ(picture.pixels[i], is_ink ? kInkGray : kPaperGray)
          << card_id(number) << " at " << pixel_x << ", " << pixel_y;
    }
    EXPECT_GT(compared, 4000);
  }
}

TEST(CardDrawing, EdgeIsInkAllAround) {
  const Picture picture = card_picture(1);
  const ImageView<const std::uint8_t> gray = picture.gray();
  for (int x = 0; x < gray.width; ++x) {
    EXPECT_EQ(gray.at(x, 0), kInkGray);
    EXPECT_EQ(gray.at(x, gray.height - 1), kInkGray);
  }
  for (int y = 0; y < gray.height; ++y) {
    EXPECT_EQ(gray.at(0, y), kInkGray);
    EXPECT_EQ(gray.at(gray.width - 1, y), kInkGray);
  }
}

}  // namespace
}  // namespace traygauge
