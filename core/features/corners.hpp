// Corners of a view, spread over the picture and over what lies on it, so that table, dish and food all get
// their share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/bounded_list.hpp"
#include "core/base/random.hpp"
#include "core/features/corner_response.hpp"
#include "core/image_view/image_view.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

// What a point lies on, as far as tracking it is concerned.
enum class Ground : std::uint8_t { table, card, dish, food };
inline constexpr std::size_t kGrounds = static_cast<std::size_t>(Ground::food) + 1;

constexpr Ground ground_of(std::uint8_t label) {
  if (label == kBackgroundLabel) return Ground::table;
  if (label == kCardLabel) return Ground::card;
  return is_item(label) ? Ground::food : Ground::dish;
}

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.06 points at most
// (tests/evaluation/numbers.tsv).
struct CornerParams {
  // Side of a cell of the picture searched. Every ground in a cell has a bucket of its own.
  int cell_px = 32;
  // Strongest corners that a bucket keeps, and how many of them are drawn at most: the closer both numbers,
  // the less two seeds differ.
  int candidates_per_bucket = 14;
  int corners_per_bucket = 10;
  // Squared grey values per pixel: ten times what white noise of two grey values leaves at half size. Below,
  // wood and smooth leather give corners by the thousand that no other view confirms.
  float min_response = 2.0F;
  // Of the strongest response in the bucket; what is weaker is not drawn.
  float min_share_of_best = 0.1F;
  // Of the labels' picture. A corner closer to another ground may hang over it.
  int label_margin_px = 8;
  // Grey value from which a pixel may be a highlight, which moves with the eye.
  std::uint8_t burnt_level = 250;
};

// In the picture searched.
struct Corner {
  std::uint16_t x = 0;
  std::uint16_t y = 0;
  float response = 0.0F;
  std::uint8_t label = 0;
};

// A strict order, so that equal responses do not depend on the search.
inline bool is_better(const Corner& a, const Corner& b) {
  if (a.response != b.response) return a.response > b.response;
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}

// Cells row by row; the last of a row or column may be narrower.
struct CornerGrid {
  int cell_px = 1;
  int columns = 0;
  int rows = 0;

  constexpr CornerGrid(int width, int height, const CornerParams& params)
      : cell_px(params.cell_px > 0 ? params.cell_px : 1),
        columns((width + cell_px - 1) / cell_px),
        rows((height + cell_px - 1) / cell_px) {}
  constexpr std::size_t cells() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  constexpr std::size_t cell_of(int x, int y) const {
    return static_cast<std::size_t>(y / cell_px) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(x / cell_px);
  }
};

struct CornerWorkspace {
  CornerResponseWorkspace response;
  std::array<std::span<float>, 3> responses;  // of three rows
  std::span<float> peaks;                     // of one row
  std::span<Corner> candidates;               // candidates_per_bucket for each ground of each cell
  std::span<std::uint8_t> counts;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_width, int max_height, const CornerParams& params) {
    response.allocate(arena, max_width);
    const auto width = static_cast<std::size_t>(max_width);
    for (std::span<float>& row : responses) row = arena.template take<float>(width);
    peaks = arena.template take<float>(width);
    const std::size_t buckets = kGrounds * CornerGrid(max_width, max_height, params).cells();
    candidates =
        arena.template take<Corner>(buckets * static_cast<std::size_t>(params.candidates_per_bucket));
    counts = arena.template take<std::uint8_t>(buckets);
  }
};

struct CornerPicture {
  ImageView<const std::uint8_t> gray;
  ImageView<const std::uint8_t> labels;  // empty: everything is table
  int label_scale = 1;                   // the labels are so many times as large
  std::span<const std::uint8_t> hidden;  // cells that hold no corners, not 0; empty: none is hidden
};

// Fills `corners`, round by round with one of each bucket, so that a full list is still spread. Candidates of
// a bucket are its strongest local maxima; `random` draws those that are used.
void find_corners(const CornerPicture& picture, const CornerParams& params, Random& random,
                  CornerWorkspace& workspace, BoundedList<Corner>& corners);

}  // namespace traygauge
