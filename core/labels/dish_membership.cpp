#include "core/labels/dish_membership.hpp"

#include <algorithm>
#include <cstring>

namespace traygauge {
namespace {

// Counts the pairs (a[i], b[i]) of different labels. Most are equal, so eight are compared at once.
void add_borders(const std::uint8_t* a, const std::uint8_t* b, int count,
                 std::span<std::uint32_t> borders_px) {
  const auto add = [&](int i) {
    if (a[i] == b[i]) return;
    if (is_item(a[i])) ++borders_px[kByteValues * a[i] + b[i]];
    if (is_item(b[i])) ++borders_px[kByteValues * b[i] + a[i]];
  };
  int i = 0;
  for (; i + 8 <= count; i += 8) {
    std::uint64_t eight_a = 0;
    std::uint64_t eight_b = 0;
    std::memcpy(&eight_a, a + i, sizeof(eight_a));
    std::memcpy(&eight_b, b + i, sizeof(eight_b));
    if (eight_a == eight_b) continue;
    for (int k = i; k < i + 8; ++k) add(k);
  }
  for (; i < count; ++i) add(i);
}

void count_borders(ImageView<const std::uint8_t> labels, std::span<std::uint32_t> borders_px) {
  for (int y = 0; y < labels.height; ++y) {
    add_borders(labels.row(y), labels.row(y) + 1, labels.width - 1, borders_px);
    if (y + 1 < labels.height) add_borders(labels.row(y), labels.row(y + 1), labels.width, borders_px);
  }
}

// A dish, and the length of the border that speaks for it; the background: none.
struct Vote {
  std::uint8_t dish = kBackgroundLabel;
  std::uint32_t border_px = 0;
};

class Assignment {
 public:
  Assignment(std::span<const std::uint32_t> borders_px, const DishMembershipParams& params)
      : borders_px_(borders_px), params_(params) {}

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
  std::uint32_t border_px(std::uint8_t item, std::size_t other) const {
    return borders_px_[kByteValues * item + other];
  }

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
      if (is_dish(label)) sums_px[other] += border_px(item, other);
      if (with_items && is_item(label)) sums_px[dishes_[other]] += border_px(item, other);
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
      if (is_dish(label) || is_item(label)) all_px += border_px(item, other);
    }
    const Vote vote = longest_border(item);
    return vote.border_px >= params_.min_dish_border_fraction * all_px ? vote : Vote{};
  }

  // Of the neighbours that have a dish; its own border adds to it, but does not suffice.
  Vote vote_of_neighbours(std::uint8_t item) const {
    for (std::size_t other = kFirstItemLabel; other <= kLastItemLabel; ++other) {
      if (border_px(item, other) > 0 && dishes_[other] != kBackgroundLabel) return winner(item, true);
    }
    return {};
  }

  std::span<const std::uint32_t> borders_px_;
  const DishMembershipParams& params_;
  DishOfItem dishes_{};
};

}  // namespace

DishOfItem find_dishes_of_items(std::span<const ImageView<const std::uint8_t>> views,
                                const DishMembershipParams& params, DishMembershipWorkspace& workspace) {
  std::fill(workspace.borders_px.begin(), workspace.borders_px.end(), 0U);
  for (const ImageView<const std::uint8_t>& labels : views) count_borders(labels, workspace.borders_px);
  return Assignment(workspace.borders_px, params).run();
}

}  // namespace traygauge
