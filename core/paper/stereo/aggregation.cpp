#include "core/paper/stereo/aggregation.hpp"

#include <algorithm>

namespace traygauge::paper {
namespace {

std::size_t slot_of(int x) {
  return static_cast<std::size_t>(x % WindowSums::kMaxColumns);
}

}  // namespace

Interval needed_disparities(std::span<const Interval> bands, int x, int radius_px) {
  Interval needed;
  const int end = std::min(x + radius_px, static_cast<int>(bands.size()) - 1);
  for (int i = std::max(x - radius_px, 0); i <= end; ++i) {
    needed = hull(needed, bands[static_cast<std::size_t>(i)]);
  }
  return needed;
}

void add_column(const MatchingBlock& block, int x, Interval interval, const StereoParams& params,
                WindowSums& sums) {
  sums.intervals[slot_of(x)] = interval;
  if (interval.empty()) return;
  local_costs(block, x, interval, params, sums.local.data());
  CostLanes* column = &sums.columns[slot_of(x) * sums.stride];
  const int radius = params.window_radius_px;
  for (int k = 0; k < interval.count(); ++k) {
    const auto* rows = reinterpret_cast<const std::uint8_t*>(&sums.local[static_cast<std::size_t>(k)]);
    CostLanes sum{};
    for (int dy = kMaxWindowRadius - radius; dy <= kMaxWindowRadius + radius; ++dy) {
      sum += __builtin_convertvector(load_lanes<HalfByteLanes>(rows + dy), CostLanes);
    }
    column[k] = sum;
  }
}

void sum_window(const WindowSums& sums, int x, int width, Interval interval, int radius_px,
                CostLanes* costs) {
  std::fill_n(costs, interval.count(), CostLanes{});
  const int end = std::min(x + radius_px, width - 1);
  for (int i = std::max(x - radius_px, 0); i <= end; ++i) {
    const CostLanes* column = &sums.columns[slot_of(i) * sums.stride] - sums.intervals[slot_of(i)].lo;
    for (int d = interval.lo; d <= interval.hi; ++d) costs[d - interval.lo] += column[d];
  }
}

}  // namespace traygauge::paper
