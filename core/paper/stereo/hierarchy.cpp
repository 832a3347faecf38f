#include "core/paper/stereo/hierarchy.hpp"

#include <algorithm>

namespace traygauge::paper {
namespace {

constexpr int floor_of_shift(int value, int level) {
  return value >> level;
}

constexpr int ceiling_of_shift(int value, int level) {
  return -((-value) >> level);
}

// The disparities around one coarse column, in pixels of the finer level.
Interval search_neighbourhood(ImageView<const Disparity> coarse, int column, int top, int bottom,
                              int reach_px) {
  int low = kDisparityScale * (1 << 16);
  int high = -low;
  for (int y = top; y <= bottom; ++y) {
    const Disparity* row = coarse.row(y);
    const int end = std::min(column + reach_px, coarse.width - 1);
    for (int x = std::max(column - reach_px, 0); x <= end; ++x) {
      if (row[x] == kNoDisparity) continue;
      low = std::min<int>(low, row[x]);
      high = std::max<int>(high, row[x]);
    }
  }
  if (high < low) return {};
  constexpr int kHalfScale = kDisparityScale / 2;  // a coarse pixel is two fine ones
  const int fine_low = low >= 0 ? low / kHalfScale : -((-low + kHalfScale - 1) / kHalfScale);
  const int fine_high = high >= 0 ? (high + kHalfScale - 1) / kHalfScale : -((-high) / kHalfScale);
  return {fine_low, fine_high};
}

void fill_occlusions(DisparityRange range, Interval columns, std::span<Interval> bands) {
  Interval last;
  for (int x = columns.lo; x <= columns.hi; ++x) {
    Interval& band = bands[static_cast<std::size_t>(x)];
    if (band.empty()) band = last;
    last = band;
  }
  last = {range.min_px, range.max_px};
  for (int x = columns.hi; x >= columns.lo; --x) {
    Interval& band = bands[static_cast<std::size_t>(x)];
    if (band.empty()) band = last;
    last = band;
  }
}

}  // namespace

DisparityRange range_at_level(DisparityRange range, int level) {
  return {floor_of_shift(range.min_px, level), ceiling_of_shift(range.max_px, level)};
}

void open_bands(DisparityRange range, Interval columns, std::span<Interval> bands) {
  std::fill(bands.begin(), bands.end(), Interval{});
  for (int x = columns.lo; x <= columns.hi; ++x) {
    bands[static_cast<std::size_t>(x)] = {range.min_px, range.max_px};
  }
}

void narrow_bands(ImageView<const Disparity> coarse, int top, DisparityRange range,
                  const StereoParams& params, Interval columns, std::span<Interval> bands) {
  const int reach = params.band_reach_px;
  const int first_row = std::max(top / 2 - reach, 0);
  const int last_row = std::min((top + kRowLanes - 1) / 2 + reach, coarse.height - 1);
  std::fill(bands.begin(), bands.end(), Interval{});
  for (int x = columns.lo; x <= columns.hi; ++x) {
    Interval& band = bands[static_cast<std::size_t>(x)];
    if (x % 2 != 0 && x > columns.lo) {  // shares its coarse pixel
      band = bands[static_cast<std::size_t>(x - 1)];
      continue;
    }
    const Interval found = search_neighbourhood(coarse, x / 2, first_row, last_row, reach);
    if (found.empty()) continue;
    band.lo = std::clamp(found.lo - params.band_px, range.min_px, range.max_px);
    band.hi = std::clamp(found.hi + params.band_px, range.min_px, range.max_px);
  }
  fill_occlusions(range, columns, bands);
}

}  // namespace traygauge::paper
