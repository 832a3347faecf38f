// A choice of label values: what stands on one dish, say.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/base/units.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

class LabelSet {
 public:
  constexpr void add(std::uint8_t label) { contains_[label] = true; }
  constexpr void remove(std::uint8_t label) { contains_[label] = false; }
  constexpr bool empty() const {
    return std::none_of(contains_.begin(), contains_.end(), [](bool contained) { return contained; });
  }
  constexpr bool contains(std::uint8_t label) const { return contains_[label]; }

 private:
  std::array<bool, kByteValues> contains_{};
};

// The first dish with every item: all of it when there is one dish only.
constexpr LabelSet labels_of_single_dish() {
  LabelSet set;
  for (int label = kDishLabel; label <= kLastItemLabel; ++label) set.add(static_cast<std::uint8_t>(label));
  return set;
}

}  // namespace traygauge
