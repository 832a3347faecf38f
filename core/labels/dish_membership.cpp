#include "core/labels/dish_membership.hpp"

#include <algorithm>

namespace traygauge {
namespace {

// A dish, and the length of the border that speaks for it; the background: none.
struct Vote {
  std::uint8_t dish = kBackgroundLabel;
  std::uint32_t border_px = 0;
};

class Assignment {
 public:
  Assignment(const LabelBorders& borders, const DishMembershipParams& params)
      : borders_(borders), params_(params) {}

  // Settles every item that borders a dish or an item that does, directly or over others. Each round settles
  // at least one more of the 198 items, or is the last.
  DishOfItem run() {
    settle([&](std::uint8_t item) { return vote_of_border(item); });
    for (bool changed = true; changed;) {
      changed = settle([&](std::uint8_t item) { return vote_of_neighbours(item); });
      // Nobody is left to ask: a short border is better than none.
      if (!changed) changed = settle([&](std::uint8_t item) { return longest_border(item); });
    }
    return dishes_;
  }

 private:
  // Gives every item without a dish the one that `vote` names; all vote before any is settled.
  template <class VoteOf>
  bool settle(const VoteOf& vote) {
    DishOfItem next = dishes_;
    for (int item = kFirstItemLabel; item <= kLastItemLabel; ++item) {
      const auto label = static_cast<std::uint8_t>(item);
      if (dishes_[label] == kBackgroundLabel) next[label] = vote(label).dish;
    }
    const bool changed = next != dishes_;
    dishes_ = next;
    return changed;
  }

  // Adds the border of each neighbour to the dish that it is, or that it lies on.
  Vote winner(std::uint8_t item, bool with_items) const {
    std::array<std::uint32_t, kByteValues> sums_px{};
    for (std::size_t other = 0; other < kByteValues; ++other) {
      const auto label = static_cast<std::uint8_t>(other);
      if (is_dish(label)) sums_px[other] += borders_.border_px(item, other);
      if (with_items && is_item(label)) sums_px[dishes_[other]] += borders_.border_px(item, other);
    }
    sums_px[kBackgroundLabel] = 0;
    const auto* const most = std::max_element(sums_px.begin(), sums_px.end());
    return *most == 0 ? Vote{} : Vote{static_cast<std::uint8_t>(most - sums_px.begin()), *most};
  }

  Vote longest_border(std::uint8_t item) const { return winner(item, false); }

  Vote vote_of_border(std::uint8_t item) const {
    std::uint32_t all_px = 0;
    for (std::size_t other = 0; other < kByteValues; ++other) {
      const auto label = static_cast<std::uint8_t>(other);
      if (is_dish(label) || is_item(label)) all_px += borders_.border_px(item, other);
    }
    const Vote vote = longest_border(item);
    return vote.border_px >= params_.min_dish_border_fraction * all_px ? vote : Vote{};
  }

  // Of the neighbours that have a dish; its own border adds to it, but does not suffice.
  Vote vote_of_neighbours(std::uint8_t item) const {
    for (std::size_t other = kFirstItemLabel; other <= kLastItemLabel; ++other) {
      if (borders_.border_px(item, other) > 0 && dishes_[other] != kBackgroundLabel)
        return winner(item, true);
    }
    return {};
  }

  const LabelBorders& borders_;
  const DishMembershipParams& params_;
  DishOfItem dishes_{};
};

}  // namespace

DishOfItem find_dishes_of_items(std::span<const ImageView<const std::uint8_t>> views,
                                const DishMembershipParams& params, LabelBorders& borders) {
  count_borders(views, borders);
  return Assignment(borders, params).run();
}

bool lies_apart(std::uint8_t item, const DishMembershipParams& params, const LabelBorders& borders) {
  std::uint32_t all_px = 0;
  std::uint32_t dishes_px = 0;
  for (std::size_t other = 0; other < kByteValues; ++other) {
    const std::uint32_t border_px = borders.border_px(item, other);
    all_px += border_px;
    if (is_dish(static_cast<std::uint8_t>(other))) dishes_px += border_px;
  }
  return dishes_px <= params.max_passing_border_fraction * all_px;
}

}  // namespace traygauge
