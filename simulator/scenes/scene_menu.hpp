// Foods dealt out to the scenes of a set.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/food_kinds.hpp"

namespace traygauge {

// Deals foods like cards: each kind comes up once before any comes up again.
class Menu {
 public:
  Menu(Draws& draws, std::initializer_list<FoodGroup> groups, FoodServing serving) : draws_(draws) {
    for (const FoodKind& kind : food_kinds()) {
      if (kind.serving != serving) continue;
      if (std::find(groups.begin(), groups.end(), kind.group) != groups.end()) kinds_.push_back(&kind);
    }
    next_ = kinds_.size();
  }

  const FoodKind* deal() {
    if (next_ == kinds_.size()) {
      draws_.shuffle(std::span<const FoodKind*>(kinds_));
      next_ = 0;
    }
    return kinds_[next_++];
  }

  // All different.
  std::vector<const FoodKind*> deal(std::size_t count) {
    std::vector<const FoodKind*> hand;
    while (hand.size() < count) {
      const FoodKind* kind = deal();
      if (std::find(hand.begin(), hand.end(), kind) == hand.end()) hand.push_back(kind);
    }
    return hand;
  }

 private:
  Draws& draws_;
  std::vector<const FoodKind*> kinds_;
  std::size_t next_ = 0;
};

}  // namespace traygauge
