// Corners of a view, spread over the picture and over what lies on it, so that table, dish and food all get
// their share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/bounded_list.hpp"
#include "core/base/random.hpp"
#include "core/features/corner_response.hpp"
#include "core/image_view/image_view.hpp"
#include "core/segmentation/label_regions.hpp"

namespace traygauge {

// What a point lies on, as far as tracking it is concerned.
enum class Ground : std::uint8_t { table, card, dish, food };
inline constexpr std::size_t kGrounds = 4;

constexpr Ground ground_of(std::uint8_t label) {
  if (label == kBackgroundLabel) return Ground::table;
  if (label == kCardLabel) return Ground::card;
  return is_item(label) ? Ground::food : Ground::dish;
}

struct CornerParams {
  int cell_px = 32;  // side of a bucket in the picture searched; corners keep such distances on average
  int corners_per_cell = 3;  // drawn from a cell, of each ground: more take longer, fewer are less accurate
  int candidates_per_cell =
      6;  // among which they are drawn: more weaken the corners, fewer the seeds' effect
  float min_response =
      0.4F;  // squared grey values per pixel; what noise of 2 grey values yields in half size
  float min_share_of_best = 0.1F;  // of the strongest response in the cell; below, a corner is not drawn
  int label_margin_px = 8;  // of the labels' picture: a corner closer to another ground may hang over it
  std::uint8_t burnt_level =
      250;  // grey value from which a pixel may be a highlight, which moves with the eye
};

// In the picture searched.
struct Corner {
  std::uint16_t x = 0;
  std::uint16_t y = 0;
  float response = 0.0F;
  std::uint8_t label = 0;
};

constexpr std::size_t corner_cells(int length_px, int cell_px) {
  return static_cast<std::size_t>((length_px + cell_px - 1) / cell_px);
}

struct CornerWorkspace {
  CornerResponseWorkspace response;
  std::array<std::span<float>, 3> responses;  // of three rows
  std::span<Corner> candidates;               // candidates_per_cell for each ground of each cell
  std::span<std::uint8_t> counts;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_width, int max_height, const CornerParams& params) {
    response.allocate(arena, max_width);
    for (std::span<float>& row : responses)
      row = arena.template take<float>(static_cast<std::size_t>(max_width));
    const std::size_t buckets =
        kGrounds * corner_cells(max_width, params.cell_px) * corner_cells(max_height, params.cell_px);
    candidates = arena.template take<Corner>(buckets * static_cast<std::size_t>(params.candidates_per_cell));
    counts = arena.template take<std::uint8_t>(buckets);
  }
};

// Fills `corners` round by round (one of each bucket a round, so that a list that overflows is still spread)
// from `gray`, whose `labels` are `label_scale` times as large; empty labels make everything table. The
// strongest candidates of a bucket are its local maxima; which of them are used is drawn from `random`.
void find_corners(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels, int label_scale,
                  const CornerParams& params, Random& random, CornerWorkspace& workspace,
                  BoundedList<Corner>& corners);

}  // namespace traygauge
