#include "core/stereo/median.hpp"

#include <algorithm>
#include <limits>

#include "core/stereo/row_lanes.hpp"

namespace traygauge {
namespace {

// Eight neighbouring pixels of a row at a time.
constexpr int kMedianLanes = kRowLanes;
constexpr int kMaxWindow = (2 * kMaxMedianRadius + 1) * (2 * kMaxMedianRadius + 1);
static_assert(kNoDisparity == std::numeric_limits<Disparity>::min(), "its complement is the highest value");

void order(CostLanes& low, CostLanes& high) {
  const CostLanes a = low;
  low = smaller(a, high);
  high = larger(a, high);
}

// Moves the extremes of `values` to its ends.
void separate_extremes(CostLanes* values, int count) {
  for (int i = 0; i < count / 2; ++i) order(values[i], values[count - 1 - i]);
  for (int i = 1; i < (count + 1) / 2; ++i) order(values[0], values[i]);
  for (int i = count / 2; i < count - 1; ++i) order(values[i], values[count - 1]);
}

// Median of an odd number of values: with more than half of them in hand, neither the smallest nor the
// largest can be the median; both are forgotten and one more value is taken in.
CostLanes median_of(CostLanes* values, int count) {
  if (count == 1) return values[0];
  int held = count / 2 + 2;
  CostLanes* first = values;
  int next = held;
  for (; next < count; --held) {
    separate_extremes(first, held);
    ++first;                           // forgets the smallest
    first[held - 2] = values[next++];  // the new value in place of the largest
  }
  separate_extremes(first, held);
  return first[1];
}

CostLanes load_pixels(ImageView<const Disparity> picture, int x, int y) {
  if (y < 0 || y >= picture.height) return broadcast(kNoDisparity);
  const Disparity* row = picture.row(y);
  if (x >= 0 && x + kMedianLanes <= picture.width) return load_lanes<CostLanes>(row + x);
  CostLanes pixels = broadcast(kNoDisparity);
  for (int i = 0; i < kMedianLanes; ++i) {
    if (x + i >= 0 && x + i < picture.width) pixels[i] = row[x + i];
  }
  return pixels;
}

}  // namespace

void filter_median(ImageView<const Disparity> source, int radius_px, ImageView<Disparity> target) {
  const int count = (2 * radius_px + 1) * (2 * radius_px + 1);
  for (int y = 0; y < source.height; ++y) {
    for (int x = 0; x < source.width; x += kMedianLanes) {
      CostLanes window[kMaxWindow];
      CostLanes highest_next = broadcast(-1);
      CostLanes* value = window;
      for (int dy = -radius_px; dy <= radius_px; ++dy) {
        for (int dx = -radius_px; dx <= radius_px; ++dx) {
          CostLanes pixels = load_pixels(source, x + dx, y + dy);
          // Unknown ones count in turn as the highest and the lowest: the median of the others stays.
          const CostLanes unknown = pixels == broadcast(kNoDisparity);  // all ones where true
          pixels ^= unknown & highest_next;
          highest_next ^= unknown;
          *value++ = pixels;
        }
      }
      const CostLanes median = median_of(window, count);
      const CostLanes centre = load_pixels(source, x, y);
      for (int i = 0; i < kMedianLanes && x + i < source.width; ++i) {
        target.at(x + i, y) = centre[i] == kNoDisparity ? kNoDisparity : median[i];
      }
    }
  }
}

}  // namespace traygauge
