// The card in a picture without labels: searched by the corners of its print, then aligned by its grey
// values.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/geometry.hpp"
#include "core/base/status.hpp"
#include "core/image/camera.hpp"
#include "core/scale/card.hpp"
#include "core/scale/card_alignment.hpp"
#include "core/scale/card_pattern.hpp"
#include "core/scale/card_search.hpp"

namespace traygauge {

struct CardLocationParams {
  CardSearchParams search;
  CardDetectionParams detection;  // of the homography among the corners found
  CardAlignmentParams alignment;
  int max_alignments = 3;  // each from the outline that the last one gave
  // Of print and picture, from which the card's place is sure; a print out of focus or hidden reaches less.
  double sure_correlation = 0.9;
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

// `gray` as stored, of the lens's size; `labels` of the same size is scratch, and shows the card afterwards.
// card_not_found where no print is beyond chance, or the place found does not show it.
Status locate_card(ImageView<const std::uint8_t> gray, ImageView<std::uint8_t> labels, const LensModel& lens,
                   const CardLocationParams& params, CardLocationWorkspace& workspace,
                   CardAlignment& alignment);

}  // namespace traygauge
