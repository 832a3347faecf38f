// Where on the table the edges of both views want a dish to stand.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/dish/dish_search.hpp"

namespace traygauge {

// Votes for the centre of an ellipse of known axes.
class Ballot {
 public:
  Ballot(const Vec2& middle_mm, const DishSearchParams& params, std::span<std::uint16_t> votes)
      : cell_mm_(params.cell_mm), votes_(votes) {
    corner_mm_ = middle_mm - Vec2::Constant(0.5 * kCells * cell_mm_);
  }

  void clear() { std::fill(votes_.begin(), votes_.end(), std::uint16_t{0}); }

  void vote(const Vec2& centre_mm) {
    const Vec2 cell = (centre_mm - corner_mm_) / cell_mm_;
    if (!(cell.minCoeff() >= 0.0) || !(cell.maxCoeff() < kCells)) return;
    ++votes_[index(static_cast<int>(cell.x()), static_cast<int>(cell.y()))];
  }

  // The cell whose neighbourhood of 3 × 3 has most votes, among those that `may_stand` admits. Rows without
  // such a cell are left after a pass that the compiler does in lanes.
  template <class MayStand>
  int most(MayStand&& may_stand, Vec2& centre_mm) const {
    int most = 0;
    std::array<std::uint16_t, kBallotCells> columns;  // sums of three rows
    for (int y = 1; y + 1 < kCells; ++y) {
      const std::uint16_t* above = &votes_[index(0, y - 1)];
      const std::uint16_t* row = &votes_[index(0, y)];
      const std::uint16_t* below = &votes_[index(0, y + 1)];
      std::uint16_t greatest = 0;
      for (int x = 0; x < kCells; ++x) {
        const auto at = static_cast<std::size_t>(x);
        columns[at] = static_cast<std::uint16_t>(above[x] + row[x] + below[x]);
        greatest = std::max(greatest, columns[at]);
      }
      if (3 * greatest <= most) continue;
      for (int x = 1; x + 1 < kCells; ++x) {
        const std::uint16_t* three = &columns[static_cast<std::size_t>(x - 1)];
        const int sum = three[0] + three[1] + three[2];
        if (sum <= most) continue;
        const Vec2 place = corner_mm_ + cell_mm_ * Vec2(x + 0.5, y + 0.5);
        if (!may_stand(place)) continue;
        most = sum;
        centre_mm = place;
      }
    }
    return most;
  }

 private:
  static std::size_t index(int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(kCells) + static_cast<std::size_t>(x);
  }

  Vec2 corner_mm_;
  static constexpr int kCells = static_cast<int>(kBallotCells);
  double cell_mm_;
  std::span<std::uint16_t> votes_;
};

}  // namespace traygauge
