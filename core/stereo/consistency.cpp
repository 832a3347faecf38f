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

struct Gap {
  int first;
  int end;
};

class RowFiller {
 public:
  RowFiller(std::span<const std::uint8_t> labels, const RowSight& sight, const ConsistencyParams& params,
            std::span<Disparity> disparity)
      : labels_(labels.data()),
        width_(static_cast<int>(labels.size())),
        sight_(sight),
        params_(params),
        row_(disparity.data()),
        one_surface_(static_cast<int>(std::lround(params.same_surface_px * kDisparityScale))) {}

  void fill() {
    int x = 0;
    while (x < width_) {
      if (labels_[x] == 0 || row_[x] != kNoDisparity) {
        ++x;
        continue;
      }
      int end = x + 1;
      while (end < width_ && labels_[end] == labels_[x] && row_[end] == kNoDisparity) ++end;
      fill({x, end});
      x = end;
    }
  }

 private:
  // The known disparity nearest to x, going by `step` through samples of a label; kNoDisparity if none.
  Disparity find_known(int x, int step, bool same_label, int& at) const {
    const std::uint8_t label = labels_[x];
    for (at = x + step; at >= 0 && at < width_; at += step) {
      if (labels_[at] == 0 || (same_label && labels_[at] != label)) return kNoDisparity;
      if (row_[at] != kNoDisparity) return row_[at];
    }
    return kNoDisparity;
  }

  // Share of its height that an item's flank has at its outline, which lies at x, on its `side` (−1, 1).
  double outline_share(int x, int side) const {
    const double leans_out = side * (x - sight_.foot_column) / sight_.height_columns;
    const double beyond = leans_out - params_.flank_run;
    const double limb = beyond >= params_.flank_run_spread    ? 1.0
                        : beyond <= -params_.flank_run_spread ? 0.0
                                                              : 0.5 + 0.5 * beyond / params_.flank_run_spread;
    return params_.contact_share + limb * (params_.limb_share - params_.contact_share);
  }

  void fill(Gap gap) {
    const bool item = is_item(labels_[gap.first]);
    int left_at = 0;
    int right_at = 0;
    int left = find_known(gap.first, -1, item, left_at);
    int right = find_known(gap.end - 1, 1, item, right_at);
    if (left == kNoDisparity && right == kNoDisparity) return;
    const bool at_border = left == kNoDisparity || right == kNoDisparity;
    const auto fallen = [&](int known, int side) {
      if (!item || known <= 0) return known;
      return static_cast<int>(outline_share(side > 0 ? right_at : left_at, side) * known);
    };
    if (left == kNoDisparity) left = fallen(right, -1);
    if (right == kNoDisparity) right = fallen(left, 1);
    const int lower = std::min(left, right);
    const bool one = at_border || std::abs(left - right) <= one_surface_;
    const double above_lower = one ? 1.0 : item ? params_.chord_share : 0.0;
    for (int i = gap.first; i < gap.end; ++i) {
      const int mixed = left + (right - left) * (i - left_at) / std::max(right_at - left_at, 1);
      row_[i] = static_cast<Disparity>(lower + static_cast<int>(above_lower * (mixed - lower)));
    }
  }

  const std::uint8_t* labels_;
  int width_;
  const RowSight& sight_;
  const ConsistencyParams& params_;
  Disparity* row_;
  int one_surface_;
};

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

void fill_gaps(std::span<const std::uint8_t> labels, const RowSight& sight, const ConsistencyParams& params,
               std::span<Disparity> disparity) {
  RowFiller(labels, sight, params, disparity).fill();
}

}  // namespace traygauge
