// Semi-global matching (Hirschmüller 2008) in a band: every pixel has its own first disparity and the same
// number of them, so that memory does not grow with the range; the bands come from a coarser level. Costs are
// bytes, sixteen disparities a SIMD register.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"
#include "core/stereo/disparity.hpp"
#include "core/stereo/row_lanes.hpp"

namespace traygauge {

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.15 points at most
// (tests/evaluation/numbers.tsv), but for large_step_penalty (-0.42 and +0.28), edge_contrast (-0.20) and
// twice of border_penalty (-0.35). What these six gain, other food loses: penalties of 10 for borders and 31
// for labels were worse on meals-14 (tests/evaluation/experiments.md).
struct SgmParams {
  // In bits of the census, of 31.
  int small_step_penalty = 3;    // a change by one disparity: slanted food is the rule
  int large_step_penalty = 28;   // by more, in plain areas
  int least_large_penalty = 10;  // where the picture has an edge of several edge_contrast
  int border_penalty = 8;        // between samples of different labels
  int edge_contrast = 12;        // grey levels that halve the large penalty
  int label_penalty = 16;        // partners with different labels
};

inline constexpr int kBandLanes = sizeof(ByteLanes);  // disparities in a register
inline constexpr int kMaxBandLanes = 4 * kBandLanes;  // widest band
inline constexpr int kBandPadding = kBandLanes;       // of path costs, either side

// Both pictures of a level and what matching needs of them. Labels 0 are not matched.
struct BandedPair {
  std::array<ImageView<const std::uint8_t>, 2> gray;
  std::array<ImageView<const std::uint8_t>, 2> labels;
  std::array<ImageView<const std::uint32_t>, 2> codes;
  ImageView<const std::uint32_t> mask;  // bits of the first picture's codes that count
};

struct SgmWorkspace {
  std::span<std::uint16_t> sums;                 // path costs of all pixels and disparities
  std::array<std::span<std::uint8_t>, 2> paths;  // two rows of path costs
  std::span<std::uint32_t> padded_codes;         // one row of the second picture
  std::span<std::uint8_t> padded_labels;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_columns, int max_states) {
    const auto columns = static_cast<std::size_t>(max_columns) + 2;
    constexpr auto kLanes = std::size_t{kMaxBandLanes} + std::size_t{2} * kBandPadding + kBandLanes;
    sums = arena.template take<std::uint16_t>(static_cast<std::size_t>(max_states));
    for (auto& row : paths) row = arena.template take<std::uint8_t>(columns * kLanes);
    padded_codes = arena.template take<std::uint32_t>(columns + std::size_t{2} * kMaxBandLanes);
    padded_labels = arena.template take<std::uint8_t>(columns + std::size_t{2} * kMaxBandLanes);
  }
};

// Finds the disparities of the first picture: column of the partner less own column. `first_disparity` holds
// the start of each pixel's band of `lanes` disparities (a multiple of kBandLanes, all within
// ±kMaxDisparityPx); pixels × lanes ≤ the workspace's states. Results in sixteenths, kNoDisparity outside of
// the labels and where nothing matched.
void match_sgm(const BandedPair& pair, ImageView<const std::int16_t> first_disparity, int lanes,
               const SgmParams& params, SgmWorkspace& workspace, ImageView<Disparity> disparity);

}  // namespace traygauge
