#include "core/segmentation/item_assignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/units.hpp"
#include "core/labels/label_regions.hpp"
#include "core/segmentation/colour_classes.hpp"
#include "core/segmentation/colour_sum.hpp"
#include "core/segmentation/square_sums.hpp"

namespace traygauge {
namespace {

// Classes of each channel, as many food in each: luma depends on shade, so that fewer of it will do.
constexpr int kLumaClasses = 4;
constexpr int kShareClasses = 8;
constexpr int kColourClasses = kLumaClasses * kShareClasses * kShareClasses;
static_assert(kColourClasses <= 256);

constexpr int kMostNear = (4 * kMaxSquareRadius + 1) * (4 * kMaxSquareRadius + 1);
constexpr float kLogUnit = 256.0F;  // logarithms are summed as whole numbers

class ItemAssignment {
 public:
  ItemAssignment(const DishRaster& raster, std::uint8_t unknown, const ItemAssignmentParams& params,
                 ItemAssignmentWorkspace& workspace, ImageView<std::uint8_t> cells)
      : raster_(raster),
        unknown_(unknown),
        params_(params),
        workspace_(workspace),
        cells_(cells),
        width_(raster.width() / params.fold),
        height_(raster.height() / params.fold),
        radius_(std::clamp(static_cast<int>(std::lround(params.window_mm / (raster.cell_mm * params.fold))),
                           1, kMaxSquareRadius)) {
    for (std::size_t i = 1; i < logarithms_.size(); ++i) logarithms_[i] = std::log(static_cast<float>(i));
  }

  // False when there is one item or none.
  bool run() {
    read_labels();
    if (measure_items() < 2) return false;
    classify_colours();
    const PixelBox all{0, 0, width_, height_};
    const auto is_food = [&](std::size_t at) { return workspace_.is_food[at] ? 1 : 0; };
    sum_squares(all, radius_, is_food, [&](std::size_t at, int sum) { workspace_.seen[at] = count_of(sum); });
    sum_squares(all, 2 * radius_, is_food,
                [&](std::size_t at, int sum) { workspace_.near[at] = count_of(sum); });
    for (int round = 0; round < params_.rounds; ++round) {
      if (round > 0 && measure_items() < 2) return false;
      start_round();
      for (std::size_t label = kFirstItemLabel; label <= kLastItemLabel; ++label)
        if (sizes_[label] > 0) try_item(static_cast<std::uint8_t>(label));
      std::swap(workspace_.labels, workspace_.next);
    }
    return true;
  }

  void write() const {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const bool is_sure = workspace_.is_food[at(x, y)] && !is_border(x, y);
        write_cell(x, y, is_sure ? label_at(x, y) : unknown_);
      }
    }
  }

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  std::uint8_t label_at(int x, int y) const { return workspace_.labels[at(x, y)]; }
  bool is_food_cell(std::uint8_t cell) const { return cell == unknown_ || is_item(cell); }
  static std::uint16_t count_of(int sum) { return static_cast<std::uint16_t>(sum); }

  template <class Take>
  void for_each_cell_of(int x, int y, Take&& take) const {
    for (int j = y * params_.fold; j < (y + 1) * params_.fold; ++j) {
      for (int i = x * params_.fold; i < (x + 1) * params_.fold; ++i) take(i, j);
    }
  }

  // Food where half of the raster's cells are.
  void read_labels() {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        int food = 0;
        std::uint8_t label = kBackgroundLabel;
        for_each_cell_of(x, y, [&](int i, int j) {
          const std::uint8_t cell = cells_.at(i, j);
          food += is_food_cell(cell) ? 1 : 0;
          if (is_item(cell)) label = cell;
        });
        const bool is_food = 2 * food >= params_.fold * params_.fold;
        workspace_.is_food[at(x, y)] = is_food;
        workspace_.labels[at(x, y)] = is_food ? label : kBackgroundLabel;
      }
    }
  }

  CellColour mean_colour(int x, int y) const {
    ColourSum sum;
    for_each_cell_of(x, y, [&](int i, int j) { sum.add(raster_.colours.at(i, j)); });
    return sum.mean(params_.fold * params_.fold);
  }

  void classify_colours() {
    ColourCounts counts;
    const auto for_each_food = [&](auto&& take) {
      for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
          if (workspace_.is_food[at(x, y)]) take(at(x, y), mean_colour(x, y));
        }
      }
    };
    for_each_food([&](std::size_t, const CellColour& colour) { counts.add(colour); });
    const ColourClasses classes = counts.equal_classes(kLumaClasses, kShareClasses);
    for_each_food([&](std::size_t cell, const CellColour& colour) {
      workspace_.colours[cell] = static_cast<std::uint8_t>(
          (classes.luma[colour.luma] * kShareClasses + classes.red[colour.red]) * kShareClasses +
          classes.green[colour.green]);
    });
  }

  // Where each item is; returns how many there are.
  int measure_items() {
    sizes_.fill(0);
    boxes_.fill({});
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const std::uint8_t label = label_at(x, y);
        if (label == kBackgroundLabel) continue;
        ++sizes_[label];
        boxes_[label] = united(boxes_[label], {x, y, x + 1, y + 1});
      }
    }
    return static_cast<int>(
        std::count_if(sizes_.begin(), sizes_.end(), [](std::int32_t size) { return size > 0; }));
  }

  void start_round() {
    const std::size_t count = at(0, height_);
    std::fill_n(workspace_.next.begin(), count, kBackgroundLabel);
    std::fill_n(workspace_.scores.begin(), count, -std::numeric_limits<float>::infinity());
  }

  template <class Value, class Take>
  void sum_squares(const PixelBox& box, int radius, Value&& value, Take&& take) {
    for_each_square_sum(
        box.width(), box.height(), radius, workspace_.row_sums, workspace_.column_sums,
        [&](int x, int y) { return value(at(box.left + x, box.top + y)); },
        [&](int x, int y, int sum) { take(at(box.left + x, box.top + y), sum); });
  }

  // Within reach of the item.
  void try_item(std::uint8_t label) {
    const std::array<std::int32_t, kColourClasses> rarity = rarity_of(label);
    const int reach = 2 * radius_;
    const PixelBox& own = boxes_[label];
    const PixelBox box{std::max(0, own.left - reach), std::max(0, own.top - reach),
                       std::min(width_, own.right + reach), std::min(height_, own.bottom + reach)};
    sum_squares(
        box, reach, [&](std::size_t cell) { return workspace_.labels[cell] == label ? 1 : 0; },
        [&](std::size_t cell, int sum) { workspace_.own[cell] = count_of(sum); });
    sum_squares(
        box, radius_,
        [&](std::size_t cell) { return workspace_.is_food[cell] ? rarity[workspace_.colours[cell]] : 0; },
        [&](std::size_t cell, int sum) {
          if (!workspace_.is_food[cell] || workspace_.own[cell] == 0) return;
          const float colours =
              static_cast<float>(sum) / (kLogUnit * static_cast<float>(workspace_.seen[cell]));
          const float nearness = logarithms_[workspace_.own[cell]] - logarithms_[workspace_.near[cell]];
          const float score = static_cast<float>(params_.nearness) * nearness - colours;
          if (!(score > workspace_.scores[cell])) return;
          workspace_.scores[cell] = score;
          workspace_.next[cell] = label;
        });
  }

  // Minus the logarithm of how often an item has each colour; none is impossible (Laplace's rule).
  std::array<std::int32_t, kColourClasses> rarity_of(std::uint8_t label) const {
    std::array<int, kColourClasses> counts{};
    const PixelBox& box = boxes_[label];
    for (int y = box.top; y < box.bottom; ++y) {
      for (int x = box.left; x < box.right; ++x)
        if (label_at(x, y) == label) ++counts[workspace_.colours[at(x, y)]];
    }
    const float all = std::log(static_cast<float>(sizes_[label] + kColourClasses));
    std::array<std::int32_t, kColourClasses> rarity{};
    for (std::size_t i = 0; i < rarity.size(); ++i)
      rarity[i] = static_cast<std::int32_t>(
          std::lround(kLogUnit * (all - std::log(static_cast<float>(counts[i] + 1)))));
    return rarity;
  }

  // Of no item, or one of the eight about it is of another.
  bool is_border(int x, int y) const {
    const std::uint8_t own = label_at(x, y);
    if (own == kBackgroundLabel) return true;
    for (int j = std::max(0, y - 1); j <= std::min(height_ - 1, y + 1); ++j) {
      for (int i = std::max(0, x - 1); i <= std::min(width_ - 1, x + 1); ++i) {
        const std::uint8_t other = label_at(i, j);
        if (other != kBackgroundLabel && other != own) return true;
      }
    }
    return false;
  }

  void write_cell(int x, int y, std::uint8_t label) const {
    for_each_cell_of(x, y, [&](int i, int j) {
      std::uint8_t& cell = cells_.at(i, j);
      if (is_food_cell(cell)) cell = label;
    });
  }

  const DishRaster& raster_;
  std::uint8_t unknown_;
  const ItemAssignmentParams& params_;
  ItemAssignmentWorkspace& workspace_;
  ImageView<std::uint8_t> cells_;
  int width_;
  int height_;
  int radius_;
  std::array<float, kMostNear + 1> logarithms_{};
  std::array<std::int32_t, kByteValues> sizes_{};
  std::array<PixelBox, kByteValues> boxes_{};
};

}  // namespace

void assign_items(const DishRaster& raster, std::uint8_t unknown, const ItemAssignmentParams& params,
                  ItemAssignmentWorkspace& workspace, ImageView<std::uint8_t> cells) {
  ItemAssignment assignment(raster, unknown, params, workspace, cells);
  if (assignment.run()) assignment.write();
}

}  // namespace traygauge
