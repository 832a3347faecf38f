#include "core/paper/stereo/dynamic_programming.hpp"

#include <algorithm>

namespace traygauge::paper {
namespace {

// A step costs at most this; with the highest window sum and one more step it still fits 16 bits.
constexpr int kHighestStep = 8000;

// Path costs of a column, relative to the best of each row.
struct PathColumn {
  Interval band;
  CostLanes* costs;
  CostLanes best{};  // its disparity
};

// The cheapest way to each disparity of `band` from an equal or smaller one. What nothing reaches at a lower
// cost is reached from the best for kHighestStep.
void climb(const PathColumn& from, Interval band, CostLanes step, CostLanes* costs, CostLanes* origins) {
  const CostLanes highest = broadcast(kHighestStep);
  CostLanes cost = highest;
  CostLanes origin = from.best;
  for (int d = std::min(from.band.lo, band.lo); d <= band.hi; ++d) {
    cost = smaller(cost + step, highest);
    if (from.band.contains(d)) {
      const CostLanes stay = from.costs[d - from.band.lo];
      const auto better = stay <= cost;
      origin = better ? broadcast(d) : origin;
      cost = smaller(stay, cost);
    }
    if (d < band.lo) continue;
    costs[d - band.lo] = cost;
    origins[d - band.lo] = cost < highest ? origin : from.best;
  }
}

// The same from the next larger disparity, where that is cheaper: two successive pixels then share a partner.
// Two or more down would walk backwards in the second picture.
void descend(const PathColumn& from, Interval band, CostLanes step, CostLanes* costs, CostLanes* origins) {
  const Interval reached{std::max(band.lo, from.band.lo - 1), std::min(band.hi, from.band.hi - 1)};
  for (int d = reached.lo; d <= reached.hi; ++d) {
    const CostLanes cost = from.costs[d + 1 - from.band.lo] + step;
    CostLanes& known = costs[d - band.lo];
    CostLanes& origin = origins[d - band.lo];
    origin = cost < known ? broadcast(d + 1) : origin;
    known = smaller(cost, known);
  }
}

// Adds the column's own costs, then takes the best as zero.
void settle(const CostLanes* own, PathColumn& column) {
  const int count = column.band.count();
  CostLanes lowest = column.costs[0] + own[0];
  column.costs[0] = lowest;
  column.best = broadcast(column.band.lo);
  for (int k = 1; k < count; ++k) {
    const CostLanes cost = column.costs[k] + own[k];
    column.costs[k] = cost;
    column.best = cost < lowest ? broadcast(column.band.lo + k) : column.best;
    lowest = smaller(cost, lowest);
  }
  for (int k = 0; k < count; ++k) column.costs[k] -= lowest;
}

}  // namespace

void find_best_paths(const PathStates& states, Interval columns, std::span<const CostLanes> smoothness,
                     std::span<CostLanes> disparities) {
  const std::size_t half = states.paths.size() / 2;
  PathColumn previous{{}, states.paths.data(), {}};
  PathColumn current{{}, states.paths.data() + half, {}};
  for (int x = columns.lo; x <= columns.hi; ++x) {
    const auto column = static_cast<std::size_t>(x);
    current.band = states.bands[column];
    if (x == columns.lo) {
      std::fill_n(current.costs, current.band.count(), CostLanes{});
    } else {
      const CostLanes step = smaller(smoothness[column], broadcast(kHighestStep));
      climb(previous, current.band, step, current.costs, states.predecessors_of(x));
      descend(previous, current.band, step, current.costs, states.predecessors_of(x));
    }
    settle(states.costs_of(x), current);
    std::swap(previous, current);
  }
  CostLanes path = previous.best;
  for (int x = columns.hi; x >= columns.lo; --x) {
    const auto column = static_cast<std::size_t>(x);
    disparities[column] = path;
    if (x == columns.lo) break;
    const CostLanes* predecessors = states.predecessors_of(x);
    for (int r = 0; r < kRowLanes; ++r) path[r] = predecessors[path[r] - states.bands[column].lo][r];
  }
}

}  // namespace traygauge::paper
