#include "firmware/station/lens_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kMostTrays = std::numeric_limits<std::uint8_t>::max();

// The card lies where it always lies.
bool is_dish_or_food(std::uint8_t label) {
  return is_dish(label) || is_item(label) || is_tray_place(label);
}

}  // namespace

LensWatch::LensWatch(const LensWatchParams& params) : params_(params) {
  for (int radius = params_.nearest_ring; radius <= params_.farthest_ring; ++radius) {
    std::vector<Offset>& ring = rings_.emplace_back();
    for (int rows = -radius; rows <= radius; ++rows) {
      for (int columns = -radius; columns <= radius; ++columns) {
        if (std::lround(std::hypot(columns, rows)) == radius) ring.push_back({columns, rows});
      }
    }
  }
  const auto most =
      static_cast<std::size_t>(params_.blocks_across) * static_cast<std::size_t>(params_.blocks_across);
  for (Blocks* blocks : {&current_, &earlier_, &seen_}) {
    for (std::vector<Block>& view : *blocks) view.reserve(most);
  }
  means_.set_block_px(1);  // until begin(): as many blocks as ever
  means_.reserve(params_.blocks_across, params_.blocks_across);
}

void LensWatch::begin(const FrameView& frame) {
  width_ = frame.width;
  height_ = frame.height;
  block_px_ = blocks_along(std::max(width_, height_), params_.blocks_across);
  means_.set_block_px(block_px_);
  columns_ = blocks_along(width_, block_px_);
  rows_ = blocks_along(height_, block_px_);
  trays_ = 0;
  is_known_ = false;
  clear(current_);
  clear(earlier_);
  spot_.reset();
}

void LensWatch::clear(Blocks& blocks) const {
  for (std::vector<Block>& view : blocks)
    view.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), {});
}

void LensWatch::add(const std::array<WatchedView, 2>& views) {
  const auto fits = [this](const WatchedView& view) {
    return view.frame.width == width_ && view.frame.height == height_;
  };
  if (!fits(views[0])) begin(views[0].frame);
  if (!fits(views[1])) return;
  if (trays_ == params_.trays) {
    std::swap(current_, earlier_);
    clear(current_);
    trays_ = 0;
  }
  for (std::size_t i = 0; i < 2; ++i) look(views[i], current_[i]);
  ++trays_;
  is_known_ = is_known_ || trays_ == params_.trays;
  unite_windows();
  find_spot();
}

void LensWatch::look(const WatchedView& view, std::vector<Block>& blocks) {
  means_.compute(view.frame);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      Block& block = blocks[index(column, row)];
      block.brightest = std::max(block.brightest, means_.means()[index(column, row)]);
      if (block.on_dish < kMostTrays && shows_dish(view, column, row)) ++block.on_dish;
    }
  }
}

// At its corners and in its middle.
bool LensWatch::shows_dish(const WatchedView& view, int column, int row) const {
  if (view.labels.empty()) return false;
  const auto shows = [&](int x_px, int y_px) {
    const int x = std::min(x_px, width_ - 1) * view.labels.width / width_;
    const int y = std::min(y_px, height_ - 1) * view.labels.height / height_;
    return is_dish_or_food(view.labels.at(x, y));
  };
  const int left = column * block_px_;
  const int top = row * block_px_;
  const int last = block_px_ - 1;
  return shows(left, top) && shows(left + last, top) && shows(left, top + last) &&
         shows(left + last, top + last) && shows(left + last / 2, top + last / 2);
}

void LensWatch::unite_windows() {
  for (std::size_t i = 0; i < 2; ++i) {
    seen_[i].assign(current_[i].begin(), current_[i].end());
    for (std::size_t k = 0; k < seen_[i].size(); ++k) {
      Block& block = seen_[i][k];
      block.brightest = std::max(block.brightest, earlier_[i][k].brightest);
      block.on_dish =
          static_cast<std::uint8_t>(std::min<int>(block.on_dish + earlier_[i][k].on_dish, kMostTrays));
    }
  }
}

void LensWatch::find_spot() {
  spot_.reset();
  if (!is_known_) return;
  double least = params_.max_brightness_ratio;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const bool is_often_on_dish = std::ranges::all_of(seen_, [&](const std::vector<Block>& view) {
        return view[index(column, row)].on_dish >= params_.min_dish_trays;
      });
      if (!is_often_on_dish) continue;
      for (std::size_t i = 0; i < rings_.size(); ++i) {
        const std::optional<Surroundings> around = surroundings(column, row, rings_[i]);
        if (!around || around->brightness_ratio > least) continue;
        least = around->brightness_ratio;
        spot_ = measure_spot(column, row, params_.nearest_ring + static_cast<int>(i), *around);
      }
    }
  }
}

// None where part of the ring lies beyond the picture, or is black.
std::optional<LensWatch::Surroundings> LensWatch::surroundings(int column, int row,
                                                               const std::vector<Offset>& ring) const {
  Surroundings around;
  around.brightness_ratio = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    std::uint8_t darkest = std::numeric_limits<std::uint8_t>::max();
    for (const Offset& offset : ring) {
      const int x = column + offset.columns;
      const int y = row + offset.rows;
      if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return std::nullopt;
      darkest = std::min(darkest, seen_[i][index(x, y)].brightest);
    }
    if (darkest == 0) return std::nullopt;
    around.darkest[i] = darkest;
    const double ratio = static_cast<double>(seen_[i][index(column, row)].brightest) / darkest;
    around.brightness_ratio = std::max(around.brightness_ratio, ratio);
  }
  return around;
}

// The blocks within the ring that are nearer to the middle's brightness, in both views, than to what is
// around: their centre, and the width of a circle as large.
LensSpot LensWatch::measure_spot(int column, int row, int radius, const Surroundings& around) const {
  int blocks = 0;
  int columns = 0;
  int rows = 0;
  for (int y = row - radius + 1; y < row + radius; ++y) {
    for (int x = column - radius + 1; x < column + radius; ++x) {
      bool is_dark = std::hypot(x - column, y - row) < radius;
      for (std::size_t i = 0; is_dark && i < 2; ++i) {
        const int middle = seen_[i][index(column, row)].brightest;
        is_dark = 2 * seen_[i][index(x, y)].brightest <= middle + around.darkest[i];
      }
      if (!is_dark) continue;
      ++blocks;
      columns += x;
      rows += y;
    }
  }
  const auto centre_px = [&](int sum) { return (static_cast<double>(sum) / blocks + 0.5) * block_px_ - 0.5; };
  return {centre_px(columns), centre_px(rows), block_px_ * 2.0 * std::sqrt(blocks / std::numbers::pi)};
}

}  // namespace traygauge
