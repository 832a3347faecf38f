// Draws the label pictures of a pair that nobody outlined: card, dishes and food, in the manner of J. Dehais,
// M. Anthimopoulos, S. Mougiakakou, Dish Detection and Segmentation for Dietary Assessment on Smartphones
// (ICIAP workshops 2015). What it draws is then measured as if a person had drawn it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/estimator/configuration.hpp"
#include "core/estimator/stage_clock.hpp"
#include "core/scale/card_alignment.hpp"
#include "core/scale/card_search.hpp"
#include "core/segmentation/dish_relief.hpp"
#include "core/segmentation/food_outline.hpp"
#include "core/surface/dish_search.hpp"

namespace traygauge {

struct SegmenterParams {
  CardSearchParams card;
  DishSearchParams dish;
  DishReliefParams relief;
  FoodOutlineParams food;
  // Insets from the outer edge between which a flange counts as such, and the depth below it where the well
  // begins.
  double flange_begin_mm = 2.5;
  double flange_depth_mm = 6.0;
  double min_flange_mm = 4.0;
  // Over the bottom of the dish, between which food is seen; what is carried to the other view counts where
  // both lead to the same item.
  std::array<double, 2> food_heights_mm{3.0, 22.0};
  double min_confirmed_share = 0.2;  // of an item's pixels in one view over the other's
  int max_alignments = 3;            // of the card, each from the outline that the last one gave
  // Of print and picture, from which the card's place is sure; a print out of focus or hidden reaches less.
  double sure_correlation = 0.9;
};

// A picture to be labelled. `labels` has the frame's size; both belong to the caller.
struct SegmentedView {
  FrameView frame;
  ImageView<std::uint8_t> labels;
  std::optional<LensModel> lens;  // a camera of its own; else the configuration's
};

struct SegmentedDish {
  std::uint8_t label = kDishLabel;
  Status status;
  FoundDish found;
  DishModel model;  // as described, where it was found
};

// What a segmentation found; the labels themselves are in the caller's pictures.
struct Segmentation {
  Status status;
  std::array<CardAlignment, 2> cards;
  std::array<SegmentedDish, kMaxPlacedDishes> dishes;
  std::size_t dish_count = 0;
  int items = 0;  // labels from kFirstItemLabel on
  double card_ms = 0.0;
  double dish_ms = 0.0;
  double food_ms = 0.0;

  double total_ms() const { return card_ms + dish_ms + food_ms; }
};

// Not thread-safe. Nothing allocates, construction included.
class Segmenter {
 public:
  // `block` holds segmenter_bytes(configuration, params), aligned to kArenaAlignmentBytes, and outlives the
  // segmenter; of `configuration`, card, dishes, lens, limits and best.card are read. Check status() before
  // use.
  Segmenter(std::span<std::byte> block, const Configuration& configuration,
            const SegmenterParams& params = {});

  Status status() const { return status_; }

  // Labels both views. card_not_found, rim_not_found (no dish at all), no_food_label; frames of another size
  // than the lens: frame_size_mismatch.
  const Segmentation& segment(const std::array<SegmentedView, 2>& views);

 private:
  struct Memory {
    CardPattern pattern;
    PrintCorners print;
    std::array<ImageView<std::uint8_t>, 2> gray;
    CardAlignmentWorkspace alignment;
    CardSearchWorkspace card;
    DishSearchWorkspace dish;
    DishReliefWorkspace relief;
    FoodOutlineWorkspace food;
    std::span<std::uint8_t> cells;

    template <class Allocator>
    constexpr void allocate(Allocator& arena, const Configuration& configuration,
                            const SegmenterParams& params);
  };
  friend std::size_t segmenter_bytes(const Configuration& configuration, const SegmenterParams& params);
  struct DishInViews {
    InnerSurface inner;
    std::array<StoredView, 2> stored;
    DishRelief relief;
  };

  Status find_card(const SegmentedView& view, const LensModel& lens, std::size_t index);
  Status find_dishes(const DishSearchViews& views);
  void draw_dishes(const std::array<SegmentedView, 2>& views, const DishSearchViews& cameras);
  void draw_food(const std::array<SegmentedView, 2>& views, const DishSearchViews& cameras);
  bool outline_view(const FrameView& frame, const DishSearchView& camera, const SegmentedDish& dish,
                    const DishInViews& scene, std::size_t v, DishRaster& raster,
                    ImageView<std::uint8_t>& cells);
  void carry_labels(const DishRaster& raster, const DishSearchViews& cameras,
                    ImageView<const std::uint8_t> first_labels, const SegmentedDish& dish,
                    ImageView<std::uint8_t> cells) const;
  int keep_confirmed(const std::array<SegmentedView, 2>& views, std::uint8_t first, int items,
                     std::uint8_t dish) const;
  static void draw_cells(const DishRaster& raster, ImageView<const std::uint8_t> cells, std::uint8_t dish,
                         ImageView<std::uint8_t> labels);

  Configuration configuration_;
  SegmenterParams params_;
  std::array<DishModel, kMaxDishCandidates> dishes_{};
  Memory memory_;
  Status status_;
  Segmentation result_;
};

// Bytes that a segmenter takes from its block.
std::size_t segmenter_bytes(const Configuration& configuration, const SegmenterParams& params = {});

}  // namespace traygauge
