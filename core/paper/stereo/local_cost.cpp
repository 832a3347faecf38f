#include "core/paper/stereo/local_cost.hpp"

#include <algorithm>

namespace traygauge::paper {
namespace {

ByteLanes absolute_difference(ByteLanes a, ByteLanes b) {
  return (a > b ? a - b : b - a);
}

void absolute_differences(const MatchingBlock& block, int x, Interval partners, int limit, ByteLanes* costs) {
  const auto first =
      load_lanes<ByteLanes>(block.first.pixels[static_cast<std::size_t>(x)].row + kMaxCensusRadius);
  const ByteLanes highest = broadcast_byte(static_cast<std::uint8_t>(limit));
  for (int partner = partners.lo; partner <= partners.hi; ++partner) {
    const auto second =
        load_lanes<ByteLanes>(block.second.pixels[static_cast<std::size_t>(partner)].row + kMaxCensusRadius);
    const ByteLanes difference = absolute_difference(first, second);
    *costs++ = difference < highest ? difference : highest;
  }
}

}  // namespace

int highest_local_cost(const StereoParams& params) {
  return params.cost == MatchingCost::census ? 8 * census_bytes(params.census_radius_px) : params.sad_limit;
}

void local_costs(const MatchingBlock& block, int x, Interval interval, const StereoParams& params,
                 ByteLanes* costs) {
  const ByteLanes wanted = block.first.inside[static_cast<std::size_t>(x)];
  const ByteLanes outside = wanted & broadcast_byte(static_cast<std::uint8_t>(highest_local_cost(params)));
  const Interval partners{std::max(x + interval.lo, 0), std::min(x + interval.hi, block.second.width - 1)};
  if (partners.empty()) {
    std::fill_n(costs, interval.count(), outside);
    return;
  }
  ByteLanes* compared = std::fill_n(costs, partners.lo - (x + interval.lo), outside);
  if (params.cost == MatchingCost::census) {
    const auto bytes = static_cast<std::size_t>(census_bytes(params.census_radius_px));
    hamming_distances(&block.first_codes[static_cast<std::size_t>(x) * bytes],
                      &block.second_codes[static_cast<std::size_t>(partners.lo) * bytes],
                      params.census_radius_px, partners.count(), compared);
  } else {
    absolute_differences(block, x, partners, params.sad_limit, compared);
  }
  for (int partner = partners.lo; partner <= partners.hi; ++partner, ++compared) {
    const ByteLanes inside = block.second.inside[static_cast<std::size_t>(partner)];
    *compared = (*compared & inside & wanted) | (outside & ~inside);
  }
  std::fill(compared, costs + interval.count(), outside);
}

}  // namespace traygauge::paper
