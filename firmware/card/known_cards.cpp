#include "firmware/card/known_cards.hpp"

#include <algorithm>
#include <cstdlib>

#include "firmware/card/card_drawing.hpp"
#include "firmware/card/card_finder.hpp"

namespace traygauge {
namespace {

// Between two grey pictures, a pixel; those of two cards differ by 60 and more.
constexpr std::uint64_t kMaxMeanDifference = 16;

bool is_picture_of(int number, ImageView<const std::uint8_t> picture) {
  const Picture card = card_picture(number);
  std::uint64_t difference = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x)
      difference += static_cast<std::uint64_t>(std::abs(picture.at(x, y) - card.gray().at(x, y)));
  }
  return difference <= kMaxMeanDifference * card.pixels.size();
}

PictureSize largest_of(std::span<const CardSight> sights) {
  PictureSize size;
  for (const CardSight& sight : sights) {
    size.width = std::max(size.width, sight.lens.width);
    size.height = std::max(size.height, sight.lens.height);
  }
  return size;
}

}  // namespace

std::optional<int> number_of_card(ImageView<const std::uint8_t> picture) {
  if (picture.width != kCardPictureSize.width || picture.height != kCardPictureSize.height)
    return std::nullopt;
  for (int number = 1; number <= kCardPatterns; ++number) {
    if (is_picture_of(number, picture)) return number;
  }
  return std::nullopt;
}

std::optional<int> find_other_card(std::span<const CardSight> sights, const ReferenceCard& expected) {
  const std::optional<int> own = number_of_card(expected.pattern);
  const PictureSize size = largest_of(sights);
  CardFinder finder(size.width, size.height);
  for (int number = 1; number <= kCardPatterns; ++number) {
    if (number == own) continue;
    const Picture picture = card_picture(number);
    ReferenceCard card = expected;
    card.pattern = picture.gray();
    if (!finder.learn(card).ok()) continue;
    const bool is_seen = std::any_of(sights.begin(), sights.end(), [&](const CardSight& sight) {
      CardAlignment found;
      return finder.find(sight.frame, sight.lens, found).ok();
    });
    if (is_seen) return number;
  }
  return std::nullopt;
}

std::string tell_other_card(int other, const ReferenceCard& expected, const std::string& pattern) {
  const std::optional<int> own = number_of_card(expected.pattern);
  const std::string lies = "Card " + card_id(other) + " lies there, but ";
  const std::string make = "the picture that traygauge card --pattern " + std::to_string(other) + " makes";
  if (own) {
    return lies + card_id(*own) + " was expected, whose picture is " + pattern + ": lay " + card_id(*own) +
           " there, or name " + make + ".";
  }
  return lies + pattern + " is the picture of another card: lay that one there, or name " + make + ".";
}

}  // namespace traygauge
