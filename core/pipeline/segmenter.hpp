// Draws the label pictures of a pair that nobody outlined: card, dishes and food, in the manner of J. Dehais,
// M. Anthimopoulos, S. Mougiakakou, Dish Detection and Segmentation for Dietary Assessment on Smartphones
// (ICIAP workshops 2015). What it draws is then measured as if a person had drawn
// it, but the rims of the dishes are read in the pictures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/bounded_list.hpp"
#include "core/base/status.hpp"
#include "core/base/units.hpp"
#include "core/dish/dish_outline.hpp"
#include "core/pipeline/configuration.hpp"
#include "core/pipeline/segmentation.hpp"
#include "core/pipeline/segmenter_memory.hpp"
#include "core/pipeline/table_rectangle.hpp"

namespace traygauge {

// A picture to be labelled. All three are of one size.
struct SegmentedView {
  FrameView frame;
  ImageView<std::uint8_t> labels;
  ImageView<std::uint8_t> gray;  // the picture's grey values, which a measurement needs as well
  std::span<SeenRim> rims;       // of the dishes sought, in their order, which a measurement needs as well
  LensModel lens;
};

// One pair through one segmenter. What it is constructed with outlives it; pictures do until segment()
// returns.
class Segmenter {
 public:
  // Learns the print. The configuration has a network. Check status() before use.
  Segmenter(const Configuration& configuration, const CardPattern& pattern, SegmenterMemory& memory,
            Segmentation& result);

  Status status() const { return status_; }

  // Takes the first, then the second view: makes its grey picture and finds its card. frame_size_mismatch: of
  // another size than the lens or the pictures to be filled; frame_too_dark, frame_too_bright;
  // card_not_found; card_hidden where it is cut off. What fails here is also what segment() reports.
  Status add_view(const SegmentedView& view);
  // Draws the labels of both views. rim_not_found (no dish at all), dish_cut_off (none whole), no_food_label
  // (none was found, and yet the tray is not seen to be bare), picture_without_colour (food in a grey
  // picture); card_hidden instead of each where a card is doubtful.
  void segment();

 private:
  // One dish as both views show it, before anything is drawn on it.
  struct DishInViews {
    bool is_described = false;
    InnerSurface inner;
    std::array<StoredView, 2> stored;
    HeightEvidence relief;
  };

  Status check_view(const SegmentedView& view, const LensModel& lens) const;
  Status find_card(const SegmentedView& view, const LensModel& lens, std::size_t index);
  Status find_dishes();
  void keep_rims(std::size_t dish) const;
  void follow_own_motion();
  void draw_dishes() const;
  void read_pictures();
  BoundedList<TableRectangle> see_food_beside(std::size_t v, std::span<TableRectangle> storage);
  void find_tray_places();
  void draw_tray_places() const;
  void leave_out_others(const SegmentedDish& place, std::size_t v, DishRaster& raster) const;
  void keep_seen_food(const DishRaster& raster, std::size_t v, ImageView<std::uint8_t> cells) const;
  void clear_tray_places() const;
  void look_at_dishes();
  void draw_items(const FoodOutlineParams& params);
  void meet_hint();
  bool join_most_alike();
  void draw_food(const FoodOutlineParams& params);
  bool outline_view(SegmentedDish& dish, const DishInViews& scene, std::size_t v, DishRaster& raster,
                    ImageView<std::uint8_t>& cells);
  void carry_labels(const DishRaster& raster, const SegmentedDish& dish, ImageView<std::uint8_t> cells) const;
  int keep_confirmed(std::uint8_t first, int items, std::uint8_t dish) const;
  void rename_items(std::uint8_t first, int items,
                    const std::array<std::uint8_t, kByteValues>& renamed) const;
  static void draw_cells(const DishRaster& raster, ImageView<const std::uint8_t> cells, std::uint8_t dish,
                         ImageView<std::uint8_t> labels);

  const Configuration& configuration_;
  const SegmenterParams& params_ = configuration_.segmentation;
  const CardPattern& pattern_;
  SegmenterMemory& memory_;
  Segmentation& result_;
  Status status_;
  std::array<SegmentedView, 2> views_;
  DishSearchViews cameras_;
  std::array<DishInViews, kMaxPlacedDishes> scenes_;
  std::array<PictureReading, 2> readings_;
  std::size_t view_count_ = 0;
};

}  // namespace traygauge
