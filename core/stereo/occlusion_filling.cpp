#include "core/stereo/occlusion_filling.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

struct Gap {
  int first;
  int end;
};

// The known sample next to a gap.
struct Known {
  int column = 0;
  int disparity = kNoDisparity;

  bool none() const { return disparity == kNoDisparity; }
};

// 0 to 1 over `spread` to either side of `middle`.
double ramp(double value, double middle, double spread) {
  return std::clamp(0.5 + 0.5 * (value - middle) / spread, 0.0, 1.0);
}

class RowFiller {
 public:
  RowFiller(const RowOfViews& row, const ViewSlope& outline, const OcclusionParams& params,
            std::span<Disparity> disparity)
      : row_(row),
        labels_(row.labels.data()),
        width_(static_cast<int>(row.labels.size())),
        outline_(outline),
        params_(params),
        disparity_(disparity.data()),
        one_surface_(static_cast<int>(std::lround(params.same_surface_px * kDisparityScale))) {}

  void fill() {
    int x = 0;
    while (x < width_) {
      if (labels_[x] == 0 || disparity_[x] != kNoDisparity) {
        ++x;
        continue;
      }
      int end = x + 1;
      while (end < width_ && labels_[end] == labels_[x] && disparity_[end] == kNoDisparity) ++end;
      fill({x, end});
      x = end;
    }
  }

 private:
  // Nearest to x, going by `step` through samples of a label.
  Known find_known(int x, int step, bool same_label) const {
    const std::uint8_t label = labels_[x];
    for (int at = x + step; at >= 0 && at < width_; at += step) {
      if (labels_[at] == 0 || (same_label && labels_[at] != label)) return {};
      if (disparity_[at] != kNoDisparity) return {at, disparity_[at]};
    }
    return {};
  }

  void fill(Gap gap) {
    const bool item = is_item(labels_[gap.first]);
    const Known left = find_known(gap.first, -1, item);
    const Known right = find_known(gap.end - 1, 1, item);
    if (left.none() && right.none()) return;
    if (left.none() || right.none()) {
      const int side = left.none() ? -1 : 1;
      const Known& known = left.none() ? right : left;
      if (!item || known.disparity <= 0) {
        std::fill(disparity_ + gap.first, disparity_ + gap.end, static_cast<Disparity>(known.disparity));
      } else {
        fill_to_outline(gap, known, side);
      }
      return;
    }
    if (std::abs(left.disparity - right.disparity) <= one_surface_) {
      fill_between(gap, left, right, 1.0);
    } else if (!item) {
      fill_between(gap, left, right, 0.0);
    } else if ((left.disparity > right.disparity) == (row_.sign > 0)) {
      fill_occluded(row_.sign > 0 ? left : right, row_.sign > 0 ? right : left);
    } else {
      fill_between(gap, left, right, params_.step_fraction);
    }
  }

  // The straight line, lowered towards the lower end going on.
  void fill_between(Gap gap, const Known& left, const Known& right, double line_fraction) {
    const int lower = std::min(left.disparity, right.disparity);
    for (int i = gap.first; i < gap.end; ++i) {
      const int line = left.disparity +
                       (right.disparity - left.disparity) * (i - left.column) / (right.column - left.column);
      disparity_[i] = static_cast<Disparity>(lower + static_cast<int>(line_fraction * (line - lower)));
    }
  }

  // From `upper`, which hides the gap from the other view, to `lower`, where that view's line of sight past
  // it ends: of an upright wall this view sees as much as its line of sight leans in.
  void fill_occluded(const Known& upper, const Known& lower) {
    const int side = row_.sign;
    const double lean = row_.camera.lean(upper.column + side, side);
    const double other_lean = row_.other_camera.lean(upper.column + side, side);
    constexpr double kLeastLean = 0.02;  // 1 degree between views that tell depths: they are refused below 3
    const double wall_fraction = std::clamp(-lean / std::max(other_lean - lean, kLeastLean), 0.0, 1.0);
    const int apart = std::abs(lower.column - upper.column);
    const double wall = wall_fraction * apart;
    const double hidden = static_cast<double>(std::abs(upper.disparity - lower.disparity)) / kDisparityScale;
    const double slope = params_.unmatched_fall_fraction * (apart - 1 - hidden);
    fall(upper, side, std::max({wall, slope, 1.0}), lower.disparity, lower.column);
  }

  // From `from` in a straight line to a disparity `run` columns to its `side`, and level on to before `end`.
  void fall(const Known& from, int side, double run, int to, int end) {
    for (int x = from.column + side; x != end; x += side) {
      const double share = std::min(side * (x - from.column) / run, 1.0);
      disparity_[x] = static_cast<Disparity>(from.disparity + share * (to - from.disparity));
    }
  }

  void fill_to_outline(Gap gap, const Known& known, int side) {
    const int outline = side > 0 ? gap.end - 1 : gap.first;
    if (side == row_.sign && fill_within_hull(known, outline, side)) return;
    const int beyond = outline + side;
    const double share = params_.contact_fraction +
                         ramp(row_.camera.lean(beyond, side), params_.flank_run, params_.lean_spread) *
                             (params_.limb_fraction - params_.contact_fraction);
    const Known end{beyond, static_cast<int>(share * known.disparity)};
    fill_between(gap, side > 0 ? known : end, side > 0 ? end : known, 1.0);
  }

  // Where the other view's picture of the item ends on `side`; nothing where the sample's partner is not on
  // it.
  std::optional<int> other_outline(const Known& known, int side) const {
    const int other_width = static_cast<int>(row_.other_labels.size());
    const std::uint8_t* other = row_.other_labels.data();
    int x = known.column + row_.sign * whole_px(known.disparity);
    if (x < 0 || x >= other_width || other[x] != labels_[known.column]) return {};
    while (x + side >= 0 && x + side < other_width && other[x + side] == other[x]) x += side;
    return x;
  }

  // On the side that this view sees more of. Down to where the other view's outline lies the surface is seen
  // by both, beyond by this view alone.
  bool fill_within_hull(const Known& known, int outline, int side) {
    const auto other = other_outline(known, side);
    if (!other) return false;
    const double height = known.disparity;
    const double bound = std::clamp(side * (*other - outline) * kDisparityScale / height, 0.0, 1.0);
    const double over = ramp(outline_.at(outline, side), 0.0, params_.lean_spread);
    const double of_bound = params_.seen_wall_fraction + over * (1.0 - params_.seen_wall_fraction);
    const double share = std::max(bound * of_bound, params_.contact_fraction);
    const double open = 1.0 - bound;
    const double other_fraction = std::max(
        params_.other_outline_fraction + (1.0 - params_.other_outline_fraction) * (1.0 - open * open), share);
    const int run = side * (outline - known.column);
    const int to_other = side * (*other - known.column) -
                         static_cast<int>(std::lround(other_fraction * height / kDisparityScale));
    const int seen_by_both = std::clamp(to_other, 0, run);
    const Known edge{known.column + side * seen_by_both, static_cast<int>(other_fraction * height)};
    fall(known, side, std::max(seen_by_both, 1), edge.disparity, edge.column + side);
    fall(edge, side, std::max(run - seen_by_both, 1), static_cast<int>(share * height), outline + side);
    return true;
  }

  const RowOfViews& row_;
  const std::uint8_t* labels_;
  int width_;
  const ViewSlope& outline_;
  const OcclusionParams& params_;
  Disparity* disparity_;
  int one_surface_;
};

}  // namespace

void fill_occlusions(const RowOfViews& row, const ViewSlope& outline, const OcclusionParams& params,
                     std::span<Disparity> disparity) {
  RowFiller(row, outline, params, disparity).fill();
}

}  // namespace traygauge
