// Dirt on the lens, told over many trays: whatever lies on the dishes, it is dark at the same place of both
// pictures, and around it dishes and food were bright at one time or another.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/image_view/image_view.hpp"
#include "firmware/station/block_means.hpp"

namespace traygauge {

struct LensWatchParams {
  // What was seen counts for so many trays, and for twice as many at most. Where every second food is dark,
  // a place has nothing else on 20 trays once in a million times.
  int trays = 20;
  int min_dish_trays = 5;  // that showed a dish or food at the place: elsewhere things are dark for good
  int blocks_across = 80;  // of the longer side: 20 px of 1600
  // From a spot's middle to the blocks around it, so that it is 2 to 10 blocks wide. A bowl's inside is
  // wider.
  int nearest_ring = 2;
  int farthest_ring = 5;
  // Of the spot to the darkest block around it. Clean trays of a rendered station have 0.93 and more, spots
  // that let 5 % of the light through 0.3 to 0.6.
  double max_brightness_ratio = 0.7;
};

// In pixels of the camera's pictures.
struct LensSpot {
  double x_px = 0.0;
  double y_px = 0.0;
  double width_px = 0.0;
};

struct WatchedView {
  FrameView frame;
  ImageView<const std::uint8_t> labels;  // of the same picture, of its size or smaller
};

// Takes its memory at construction.
class LensWatch {
 public:
  explicit LensWatch(const LensWatchParams& params = {});

  // Of a tray that was measured, both views through one lens. Pictures of another size begin anew.
  void add(const std::array<WatchedView, 2>& views);
  // The darkest, where one is seen. A tray that shows the place bright ends it.
  const std::optional<LensSpot>& spot() const { return spot_; }

 private:
  struct Block {
    std::uint8_t brightest = 0;  // mean of its pixels, on any tray
    std::uint8_t on_dish = 0;    // trays that showed a dish or food there
  };
  // Of each view, row by row.
  using Blocks = std::array<std::vector<Block>, 2>;
  struct Offset {
    int columns = 0;
    int rows = 0;
  };
  struct Surroundings {
    std::array<std::uint8_t, 2> darkest{};  // of the blocks around, in each view
    double brightness_ratio = 1.0;          // in the view where it is larger
  };

  void begin(const FrameView& frame);
  void clear(Blocks& blocks) const;
  void look(const WatchedView& view, std::vector<Block>& blocks);
  bool shows_dish(const WatchedView& view, int column, int row) const;
  void unite_windows();
  void find_spot();
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  std::optional<Surroundings> surroundings(int column, int row, const std::vector<Offset>& ring) const;
  LensSpot measure_spot(int column, int row, int radius, const Surroundings& around) const;

  LensWatchParams params_;
  std::vector<std::vector<Offset>> rings_;  // from nearest_ring to farthest_ring
  BlockMeans means_;
  int block_px_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  int width_ = 0;  // of the pictures
  int height_ = 0;
  int trays_ = 0;          // in the current window
  bool is_known_ = false;  // a whole window was seen
  Blocks current_;
  Blocks earlier_;
  Blocks seen_;  // in both windows
  std::optional<LensSpot> spot_;
};

}  // namespace traygauge
