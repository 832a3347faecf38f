// The card in a picture without labels: searched by the corners of its print, then aligned by its grey
// values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/result.hpp"
#include "core/base/status.hpp"
#include "core/card/card.hpp"
#include "core/card/card_alignment.hpp"
#include "core/card/card_pattern.hpp"
#include "core/card/card_search.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

// How often a card that was found is aligned, each time from the outline that the last one gave.
struct CardRoundsParams {
  int max_alignments = 3;  // two or six leave the captures' volumes as they are (numbers.tsv)
  // Of print and picture, from which the card's place is sure; a print out of focus or hidden reaches less,
  // and one seen from above, tilted the wrong way, 0.94.
  double sure_correlation = 0.95;
};

struct CardLocationParams {
  CardSearchParams search;
  CardDetectionParams detection;  // of the homography among the corners found
  CardAlignmentParams alignment;
  CardRoundsParams rounds;
};

// What is known of the print, and scratch.
struct CardLocationWorkspace {
  CardPattern pattern;
  PrintCorners print;
  CardAlignmentWorkspace alignment;
  CardSearchWorkspace search;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_frame_width, int max_frame_height,
                          const CardLocationParams& params) {
    pattern.allocate(arena, params.alignment.pattern);
    print.allocate(arena, params.search);
    alignment.allocate(arena, params.alignment);
    search.allocate(arena, max_frame_width, max_frame_height, params.search);
  }
};

// Learns the printed side; once, before locate_card. invalid_configuration when it is empty or shows no
// corners.
Status learn_card(ImageView<const std::uint8_t> picture, const CardModelSize& size,
                  const CardLocationParams& params, CardLocationWorkspace& workspace);

// On each side of an outline, which a lens bends: chords between them leave a 64th of a side's bend.
inline constexpr std::size_t kCardSideCorners = 8;
using CardPolygon = std::array<Vec2, 4 * kCardSideCorners>;

// What the place of a card is found with, by whoever keeps it.
struct CardLocator {
  const CardPattern& pattern;
  const PrintCorners& print;
  const CardSearchParams& search;
  const CardParams& detection;
  const CardAlignmentParams& alignment;
  CardRoundsParams rounds;
  CardSearchWorkspace& search_space;
  CardAlignmentWorkspace& alignment_space;
};

// `gray` as stored, of the lens's size; `labels` of the same size is scratch, and shows the card and nothing
// else afterwards, within `outline_px`. card_not_found where no print is beyond chance, or the place found
// does not show it.
Status locate_card(ImageView<const std::uint8_t> gray, ImageView<std::uint8_t> labels, const LensModel& lens,
                   const CardLocator& locator, CardAlignment& alignment, CardPolygon& outline_px);

// The same with what learn_card() left in `workspace`.
Result<CardAlignment> locate_card(ImageView<const std::uint8_t> gray, ImageView<std::uint8_t> labels,
                                  const LensModel& lens, const CardLocationParams& params,
                                  CardLocationWorkspace& workspace);

}  // namespace traygauge
