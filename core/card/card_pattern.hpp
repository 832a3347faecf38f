// The card's print at several degrees of blur, to compare pictures of any scale with it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/card/card_size.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.04 points at most
// (tests/evaluation/numbers.tsv).
struct CardPatternParams {
  int max_level_px = 300'000;     // of the finest level: an ID-1 card at 8 px/mm; a larger card gets fewer
  double finest_px_per_mm = 8.0;  // twice what a 2 MP view shows: linear interpolation then loses nothing
  double finest_blur_px = 0.8;    // standard deviation, of the level; sharper would alias between its pixels
};

// Two degrees of blur an octave, √2 apart: 0.1 to 1.1 mm, which covers views with 0.5 to 6 px/mm.
inline constexpr int kCardPatternLevels = 8;

struct CardPatternLevel {
  ImageView<std::uint8_t> gray;
  std::array<double, 2> px_per_axis_mm{};  // pixel = mm · px_per_mm − 0.5
  double blur_mm = 0.0;                    // standard deviation

  Vec2 px_per_mm() const { return {px_per_axis_mm[0], px_per_axis_mm[1]}; }
};

struct CardPattern {
  CardModelSize size;
  std::array<CardPatternLevel, kCardPatternLevels> levels;
  std::array<std::span<std::uint8_t>, kCardPatternLevels> storage;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const CardPatternParams& params) {
    for (std::size_t i = 0; i < storage.size(); ++i) {
      storage[i] =
          arena.template take<std::uint8_t>(static_cast<std::size_t>(params.max_level_px) >> (i / 2 * 2));
    }
  }

  // The level whose blur is nearest in ratio.
  const CardPatternLevel& nearest_level(double blur_mm) const;
};

// Blurs the printed side's picture, which fills the card whatever its resolution, in linear light: lenses and
// pixels average light, not grey values, and tone curves are near a square root. The kernel is the cubic
// B-spline: within 1% of Gauss's, and exact on every processor.
// invalid_configuration when picture or card are empty or the card is too narrow for the coarsest level;
// wrong_call when the storage is smaller than what allocate() takes for `params`.
Status prepare_card_pattern(ImageView<const std::uint8_t> picture, const CardModelSize& size,
                            const CardPatternParams& params, CardPattern& pattern);

}  // namespace traygauge
