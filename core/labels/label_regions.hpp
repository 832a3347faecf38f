// What a label picture holds: values as in the capture contract.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/status.hpp"
#include "core/base/units.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

// The capture contract's.
inline constexpr std::uint8_t kBackgroundLabel = 0;
inline constexpr std::uint8_t kDishLabel = 1;
inline constexpr std::uint8_t kFirstItemLabel = 2;
inline constexpr std::uint8_t kLastItemLabel = 199;
inline constexpr std::uint8_t kFirstFurtherDishLabel = 201;
inline constexpr std::uint8_t kLastFurtherDishLabel = 249;
inline constexpr std::uint8_t kCardLabel = 255;
// Places of the tray on which items lie beside the dishes; label pictures show them as background.
inline constexpr std::uint8_t kFirstTrayPlace = 250;
inline constexpr std::uint8_t kLastTrayPlace = 254;
inline constexpr std::size_t kMaxTrayPlaces = kLastTrayPlace - kFirstTrayPlace + 1;

constexpr bool is_item(std::uint8_t label) {
  return label >= kFirstItemLabel && label <= kLastItemLabel;
}
constexpr bool is_dish(std::uint8_t label) {
  return label == kDishLabel || (label >= kFirstFurtherDishLabel && label <= kLastFurtherDishLabel);
}
constexpr bool is_tray_place(std::uint8_t label) {
  return label >= kFirstTrayPlace && label <= kLastTrayPlace;
}
// The dish of a single-dish tray with everything on it.
constexpr bool is_on_dish(std::uint8_t label) {
  return label == kDishLabel || is_item(label);
}

struct PixelBox {
  int left = 0;
  int top = 0;
  int right = 0;   // exclusive
  int bottom = 0;  // exclusive

  constexpr int width() const { return right - left; }
  constexpr int height() const { return bottom - top; }
  constexpr bool empty() const { return right <= left || bottom <= top; }
};

constexpr PixelBox united(const PixelBox& a, const PixelBox& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {a.left < b.left ? a.left : b.left, a.top < b.top ? a.top : b.top,
          a.right > b.right ? a.right : b.right, a.bottom > b.bottom ? a.bottom : b.bottom};
}

struct LabelRegions {
  int width = 0;  // of the picture, px
  int height = 0;
  std::array<std::uint32_t, kByteValues> pixels{};  // per label
  std::array<PixelBox, kByteValues> boxes{};        // per label
  std::uint32_t dish_pixels = 0;                    // dish and items together
  PixelBox dish;                                    // around dish and items
  PixelBox card;                                    // around the card, where it is labelled

  // Of the picture: what lies in the box may be cut off.
  constexpr bool touches_edge(const PixelBox& box) const {
    return !box.empty() && (box.left == 0 || box.top == 0 || box.right == width || box.bottom == height);
  }
};

// One pass over the labels.
LabelRegions measure_regions(ImageView<const std::uint8_t> labels);

}  // namespace traygauge
