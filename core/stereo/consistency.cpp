#include "core/stereo/consistency.hpp"

#include <algorithm>
#include <cmath>

#include "core/segmentation/label_regions.hpp"

namespace traygauge {
namespace {

int to_whole(int disparity) {
  return (disparity + kDisparityScale / 2) >> 4;
}
static_assert(kDisparityScale == 16);

// The known disparity nearest to x in a row, going by `step` through samples of a label; kNoDisparity if
// none.
Disparity find_known(const Disparity* disparity, const std::uint8_t* labels, int width, int x, int step,
                     bool same_label, int& at) {
  const std::uint8_t label = labels[x];
  for (at = x + step; at >= 0 && at < width; at += step) {
    if (labels[at] == 0 || (same_label && labels[at] != label)) return kNoDisparity;
    if (disparity[at] != kNoDisparity) return disparity[at];
  }
  return kNoDisparity;
}

struct Gap {
  int first;
  int end;
};

// Where an item's gap reaches its border with the dish it has fallen from its last known height to this
// share.
void fill_gap(Disparity* row, const std::uint8_t* labels, int width, Gap gap, int one_surface,
              const ConsistencyParams& params) {
  const bool item = is_item(labels[gap.first]);
  int left_at = 0;
  int right_at = 0;
  int left = find_known(row, labels, width, gap.first, -1, item, left_at);
  int right = find_known(row, labels, width, gap.end - 1, 1, item, right_at);
  if (left == kNoDisparity && right == kNoDisparity) return;
  const bool at_border = left == kNoDisparity || right == kNoDisparity;
  const auto fallen = [&](int known) {
    return item && known > 0 ? static_cast<int>(params.border_share * known) : known;
  };
  if (left == kNoDisparity) left = fallen(right);
  if (right == kNoDisparity) right = fallen(left);
  const int lower = std::min(left, right);
  const bool one = at_border || std::abs(left - right) <= one_surface;
  const double above_lower = one ? 1.0 : item ? params.chord_share : 0.0;
  for (int i = gap.first; i < gap.end; ++i) {
    const int mixed = left + (right - left) * (i - left_at) / std::max(right_at - left_at, 1);
    row[i] = static_cast<Disparity>(lower + static_cast<int>(above_lower * (mixed - lower)));
  }
}

}  // namespace

void keep_consistent(ImageView<const Disparity> own, ImageView<const Disparity> other, int sign,
                     const ConsistencyParams& params, ImageView<Disparity> kept) {
  const int most = static_cast<int>(std::lround(params.max_difference_px * kDisparityScale));
  for (int y = 0; y < own.height; ++y) {
    for (int x = 0; x < own.width; ++x) {
      const int d = own.at(x, y);
      kept.at(x, y) = kNoDisparity;
      if (d == kNoDisparity) continue;
      const int partner = x + sign * to_whole(d);
      if (partner < 0 || partner >= other.width) continue;
      const int back = other.at(partner, y);
      if (back != kNoDisparity && std::abs(back - d) <= most) kept.at(x, y) = static_cast<Disparity>(d);
    }
  }
}

void fill_gaps(ImageView<const std::uint8_t> labels, const ConsistencyParams& params,
               ImageView<Disparity> disparity) {
  const int one_surface = static_cast<int>(std::lround(params.same_surface_px * kDisparityScale));
  for (int y = 0; y < disparity.height; ++y) {
    Disparity* row = disparity.row(y);
    const std::uint8_t* label = labels.row(y);
    int x = 0;
    while (x < disparity.width) {
      if (label[x] == 0 || row[x] != kNoDisparity) {
        ++x;
        continue;
      }
      int end = x + 1;  // of the gap
      while (end < disparity.width && label[end] == label[x] && row[end] == kNoDisparity) ++end;
      fill_gap(row, label, disparity.width, {x, end}, one_surface, params);
      x = end;
    }
  }
}

}  // namespace traygauge
