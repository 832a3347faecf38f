// What was found on a tray that nobody outlined.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/status.hpp"
#include "core/card/card_alignment.hpp"
#include "core/dish/dish_search.hpp"
#include "core/dish/dish_sighting.hpp"
#include "core/pipeline/own_motion.hpp"
#include "core/quality/warning.hpp"

namespace traygauge {

struct SegmentedDish {
  std::uint8_t label = kDishLabel;
  Status status;
  FoundDish found;
  std::array<DishSighting, 2> sightings;  // of its rim in each view by itself
  DishModel model;                        // as described, where it was found
  int items = 0;                          // that lie on it: their labels follow those of the dish before
  bool is_split_doubtful = false;         // two of them may be one food
  bool is_bare = false;                   // found, and neither view shows food on it
  bool is_told_by_height = false;         // some of its food, and by nothing else

  bool has_doubtful_items() const { return is_split_doubtful || is_told_by_height; }
};

// The labels themselves are in the pictures that were to be filled.
struct Segmentation {
  Status status;
  std::array<CardAlignment, 2> cards;
  bool is_card_doubtful = false;  // in one of the views: part of its print is covered, or out of its place
  std::array<SegmentedDish, kMaxPlacedDishes> dishes;  // and behind them places of the tray with food
  std::size_t dish_count = 0;
  std::size_t place_count = 0;
  int items = 0;             // labels from kFirstItemLabel on
  bool leaves_food = false;  // more places with food beside the dishes than there is room for
  bool misses_hint = false;  // a number of items was asked for, and there are more or fewer
  double card_ms = 0.0;
  OwnMotion own_motion;  // of all dishes, from the first picture to the second
  double dish_ms = 0.0;
  double food_ms = 0.0;

  std::span<const SegmentedDish> sought() const { return std::span(dishes).first(dish_count); }
  std::span<const SegmentedDish> places() const { return std::span(dishes).subspan(dish_count, place_count); }
  std::span<const SegmentedDish> drawn() const { return std::span(dishes).first(dish_count + place_count); }
  std::span<SegmentedDish> drawn() { return std::span(dishes).first(dish_count + place_count); }
  bool has_all_dishes() const {
    return std::ranges::all_of(sought(), [](const SegmentedDish& dish) { return dish.status.ok(); });
  }
  // Every dish that was asked for was found, and neither view shows food on any of them, or beside.
  bool is_bare() const {
    return dish_count > 0 && items == 0 && std::ranges::all_of(sought(), &SegmentedDish::is_bare);
  }
  bool has_doubtful_items() const {
    return misses_hint || std::ranges::any_of(drawn(), &SegmentedDish::has_doubtful_items);
  }
  double total_ms() const { return card_ms + dish_ms + food_ms; }
};

// `status`, or card_hidden where nothing was measured and the card is doubtful: outlines that were drawn
// after a card out of its place contradict each other, and every other refusal would blame the wrong thing.
Status blame_card(const Segmentation& segmentation, Status status);

// Raises what is doubtful about labels that were found, where they were found at all.
void warn_about_labels(const Segmentation& segmentation, WarningSet& warnings);

}  // namespace traygauge
