// Draws the label pictures of a pair that nobody outlined: card, dishes and food, in the manner of J. Dehais,
// M. Anthimopoulos, S. Mougiakakou, Dish Detection and Segmentation for Dietary Assessment on Smartphones
// (ICIAP workshops 2015). What it draws is then measured as if a person had drawn it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/status.hpp"
#include "core/card/card_alignment.hpp"
#include "core/pipeline/configuration.hpp"
#include "core/pipeline/segmenter_memory.hpp"
#include "core/pipeline/stage_clock.hpp"

namespace traygauge {

// A picture to be labelled. All three are of one size and belong to the caller, until segment() returns.
struct SegmentedView {
  FrameView frame;
  ImageView<std::uint8_t> labels;
  ImageView<std::uint8_t> gray;   // the picture's grey values, which a measurement needs as well
  std::optional<LensModel> lens;  // a camera of its own; else the configuration's
};

struct SegmentedDish {
  std::uint8_t label = kDishLabel;
  Status status;
  FoundDish found;
  DishModel model;                 // as described, where it was found
  int items = 0;                   // that lie on it: their labels follow those of the dish before
  bool is_split_doubtful = false;  // two of them may be one food
};

// What a segmentation found; the labels themselves are in the caller's pictures.
struct Segmentation {
  Status status;
  std::array<CardAlignment, 2> cards;
  bool is_card_doubtful = false;  // in one of the views: part of its print is covered, or out of its place
  std::array<SegmentedDish, kMaxPlacedDishes> dishes;
  std::size_t dish_count = 0;
  int items = 0;             // labels from kFirstItemLabel on
  bool misses_hint = false;  // a number of items was asked for, and there are more or fewer
  double card_ms = 0.0;
  double dish_ms = 0.0;
  double food_ms = 0.0;

  bool has_all_dishes() const {
    return std::all_of(dishes.begin(), dishes.begin() + static_cast<std::ptrdiff_t>(dish_count),
                       [](const SegmentedDish& dish) { return dish.status.ok(); });
  }
  bool is_split_doubtful() const {
    return misses_hint ||
           std::any_of(dishes.begin(), dishes.begin() + static_cast<std::ptrdiff_t>(dish_count),
                       [](const SegmentedDish& dish) { return dish.is_split_doubtful; });
  }
  double total_ms() const { return card_ms + dish_ms + food_ms; }
};

// Not thread-safe. Nothing allocates, construction included.
class Segmenter {
 public:
  Segmenter(const Segmenter&) = delete;
  Segmenter& operator=(const Segmenter&) = delete;
  // `block` holds segmenter_bytes(configuration), aligned to kArenaAlignmentBytes, and outlives the
  // segmenter; of `configuration`, card, dishes, lens, limits, exposure, view_checks, segmentation and
  // best.card are read. `pattern` is the card's as an estimator has it, and outlives the segmenter, too.
  // Check status() before use.
  Segmenter(std::span<std::byte> block, const Configuration& configuration, const CardPattern& pattern);

  Status status() const { return status_; }

  // Takes the first, then the second view: makes its grey picture and finds its card. frame_size_mismatch:
  // of another size than the lens or the pictures to be filled; frame_too_dark, frame_too_bright;
  // card_not_found; card_hidden where it is cut off. What fails here is also what segment()
  // reports. A third view is refused (wrong_call) and changes nothing.
  Status add_view(const SegmentedView& view);
  // Draws the labels of both views. rim_not_found (no dish at all), dish_cut_off (none whole), no_food_label;
  // card_hidden instead of each where a card is doubtful.
  const Segmentation& segment();
  // Of the view that was added first or second.
  const CardAlignment& card(std::size_t view) const { return result_.cards[view]; }
  // Forgets both views.
  void reset();

 private:
  // One dish as both views show it.
  struct DishInViews {
    InnerSurface inner;
    std::array<StoredView, 2> stored;
    DishRelief relief;
  };

  Status check_view(const SegmentedView& view, const LensModel& lens) const;
  Status find_card(const SegmentedView& view, const LensModel& lens, std::size_t index);
  Status find_dishes();
  void draw_dishes() const;
  void draw_items(const FoodOutlineParams& params);
  void meet_hint();
  bool join_most_alike();
  void draw_food(const FoodOutlineParams& params);
  bool outline_view(const SegmentedDish& dish, const DishInViews& scene, std::size_t v, DishRaster& raster,
                    ImageView<const ReliefSample>& relief, ImageView<std::uint8_t>& cells);
  void carry_labels(const DishRaster& raster, const SegmentedDish& dish, ImageView<std::uint8_t> cells) const;
  int keep_confirmed(std::uint8_t first, int items, std::uint8_t dish) const;
  void rename_items(std::uint8_t first, int items, const std::array<std::uint8_t, 256>& renamed) const;
  static void draw_cells(const DishRaster& raster, ImageView<const std::uint8_t> cells, std::uint8_t dish,
                         ImageView<std::uint8_t> labels);

  Configuration configuration_;
  const SegmenterParams& params_ = configuration_.segmentation;
  std::array<DishModel, kMaxDishCandidates> dishes_{};
  SegmenterMemory memory_;
  const CardPattern& pattern_;
  Status status_;
  std::array<SegmentedView, 2> views_;
  DishSearchViews cameras_;
  std::size_t view_count_ = 0;
  Segmentation result_;
};

}  // namespace traygauge
