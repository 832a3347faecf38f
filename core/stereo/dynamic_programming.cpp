#include "core/stereo/dynamic_programming.hpp"

#include <algorithm>

namespace traygauge {
namespace {

// Highest cost of a step: with the highest window sum and one more smoothness cost it still fits 16 bits.
constexpr int kHighestStep = 8000;

// Path costs of a column, relative to the best of each row.
struct PathColumn {
  Interval band;
  CostLanes* costs;
  CostLanes best{};  // its disparity
};

// The cheapest way to each disparity of `band` from an equal or smaller one.
void climb(const PathColumn& from, Interval band, CostLanes step, CostLanes limit, CostLanes* costs,
           CostLanes* origins) {
  CostLanes cost = limit;
  CostLanes origin = from.best;
  for (int d = std::min(from.band.lo, band.lo); d <= band.hi; ++d) {
    cost = smaller(cost + step, limit);
    if (from.band.contains(d)) {
      const CostLanes stay = from.costs[d - from.band.lo];
      const auto better = stay <= cost;
      origin = better ? broadcast(d) : origin;
      cost = smaller(stay, cost);
    }
    if (d < band.lo) continue;
    costs[d - band.lo] = cost;
    origins[d - band.lo] = origin;
  }
}

// The same from a larger disparity, where that is cheaper.
void descend(const PathColumn& from, Interval band, CostLanes step, CostLanes limit, CostLanes* costs,
             CostLanes* origins) {
  CostLanes cost = limit;
  CostLanes origin = from.best;
  for (int d = std::max(from.band.hi, band.hi); d >= band.lo; --d) {
    cost = smaller(cost + step, limit);
    if (from.band.contains(d)) {
      const CostLanes stay = from.costs[d - from.band.lo];
      const auto better = stay <= cost;
      origin = better ? broadcast(d) : origin;
      cost = smaller(stay, cost);
    }
    if (d > band.hi) continue;
    CostLanes& known = costs[d - band.lo];
    CostLanes& known_origin = origins[d - band.lo];
    known_origin = cost < known ? origin : known_origin;
    known = smaller(cost, known);
    // A step that reached the limit may come from anywhere: from the best.
    known_origin = known >= limit ? from.best : known_origin;
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
                     int limit_px, std::span<CostLanes> disparities) {
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
      CostLanes limit = broadcast(kHighestStep);
      for (int r = 0; r < kRowLanes; ++r) {
        limit[r] = static_cast<std::int16_t>(std::min(kHighestStep, step[r] * limit_px));
      }
      climb(previous, current.band, step, limit, current.costs, states.predecessors_of(x));
      descend(previous, current.band, step, limit, current.costs, states.predecessors_of(x));
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

}  // namespace traygauge
