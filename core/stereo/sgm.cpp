#include "core/stereo/sgm.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/units.hpp"
#include "core/stereo/path_costs.hpp"
#include "core/stereo/subpixel.hpp"
#include "core/stereo/symmetric_census.hpp"

namespace traygauge {
namespace {

// Costs are bytes: a worse penalty would overflow.
constexpr SgmParams kUsual;
constexpr int kWorstPath = kWorstCost + kUsual.large_step_penalty;
static_assert(kSymmetricCensusBits + kUsual.label_penalty <= kWorstCost);
static_assert(kPadCost > kWorstPath && kPadCost + kUsual.small_step_penalty < static_cast<int>(kByteValues));
static_assert(2 * kWorstPath < static_cast<int>(kByteValues));  // two path costs are added as bytes
static_assert(4 * kWorstPath < 1 << 10);                        // four leave room for the lane

template <int kChunks>
class Matcher {
 public:
  static constexpr int kLanes = kChunks * kBandLanes;
  using Path = PathCosts<kChunks>;

  Matcher(const BandedPair& pair, ImageView<const std::int16_t> first_disparity, const SgmParams& params,
          SgmWorkspace& workspace)
      : pair_(pair), base_(first_disparity), params_(params), workspace_(workspace) {
    width_ = pair.gray[0].width;
    height_ = pair.gray[0].height;
    border_penalty_ = spread(static_cast<std::uint8_t>(params.border_penalty));
    label_penalty_ = spread(static_cast<std::uint8_t>(params.label_penalty));
    small_penalty_ = spread(static_cast<std::uint8_t>(params.small_step_penalty));
    for (int contrast = 0; contrast < 256; ++contrast) {
      const int penalty =
          params.large_step_penalty * params.edge_contrast / (params.edge_contrast + contrast);
      large_penalty_[static_cast<std::size_t>(contrast)] =
          spread(static_cast<std::uint8_t>(std::max(penalty, params.least_large_penalty)));
    }
  }

  void sweep(bool forward, ImageView<Disparity> disparity);

 private:
  // Path costs of the pixels of a row, down its columns, with one pixel beyond either end.
  Path* path_row(int which) const {
    return reinterpret_cast<Path*>(workspace_.paths[static_cast<std::size_t>(which)].data()) + 1;
  }
  void load_second_row(int y);
  void compute_costs(int x, int y);
  void start(Path& path) const;
  void extend(const Path& before, int shift, ByteLanes large, Path& path) const;
  void sweep_row(int y, int previous_y, int step);
  void choose(int y, Disparity* disparity) const;
  // What a jump between two neighbours costs.
  ByteLanes large_penalty(int x, int y, int from_x, int from_y) const {
    if (pair_.labels[0].at(x, y) != pair_.labels[0].at(from_x, from_y)) return border_penalty_;
    const int contrast = std::abs(pair_.gray[0].at(x, y) - pair_.gray[0].at(from_x, from_y));
    return large_penalty_[static_cast<std::size_t>(contrast)];
  }
  std::uint16_t* sums_at(int x, int y) const {
    return workspace_.sums.data() + (static_cast<std::ptrdiff_t>(y) * width_ + x) * kLanes;
  }

  const BandedPair& pair_;
  ImageView<const std::int16_t> base_;
  const SgmParams& params_;
  SgmWorkspace& workspace_;
  int width_ = 0;
  int height_ = 0;
  std::array<ByteLanes, kByteValues> large_penalty_{};
  ByteLanes border_penalty_{};
  ByteLanes label_penalty_{};
  ByteLanes small_penalty_{};
  std::array<ByteLanes, static_cast<std::size_t>(kChunks)> costs_{};
};

// The second picture's row between paddings that match nothing.
template <int kChunks>
void Matcher<kChunks>::load_second_row(int y) {
  const auto padding = static_cast<std::size_t>(kMaxBandLanes);
  const auto columns = static_cast<std::size_t>(width_);
  std::memcpy(workspace_.padded_codes.data() + padding, pair_.codes[1].row(y),
              columns * sizeof(std::uint32_t));
  std::memset(workspace_.padded_labels.data(), 0, padding);
  std::memcpy(workspace_.padded_labels.data() + padding, pair_.labels[1].row(y), columns);
  std::memset(workspace_.padded_labels.data() + padding + columns, 0, padding);
}

template <int kChunks>
void Matcher<kChunks>::compute_costs(int x, int y) {
  const std::uint32_t code = pair_.codes[0].at(x, y);
  const std::uint32_t mask = pair_.mask.at(x, y);
  const ByteLanes label = spread(pair_.labels[0].at(x, y));
  // A band may start far outside; it stays within the padding, where nothing matches.
  const int start = std::clamp(x + base_.at(x, y), -kMaxBandLanes, width_ + kMaxBandLanes - kLanes);
  const std::uint32_t* codes = workspace_.padded_codes.data() + kMaxBandLanes + start;
  const std::uint8_t* labels = workspace_.padded_labels.data() + kMaxBandLanes + start;
  for (int chunk = 0; chunk < kChunks; ++chunk) {
    std::uint8_t bits[kBandLanes];
    for (int k = 0; k < kBandLanes; ++k) {
      std::uint32_t v = (code ^ codes[chunk * kBandLanes + k]) & mask;
      v = v - ((v >> 1) & 0x55555555U);
      v = (v & 0x33333333U) + ((v >> 2) & 0x33333333U);
      v = (v + (v >> 4)) & 0x0f0f0f0fU;
      v = v + (v >> 8);
      bits[k] = static_cast<std::uint8_t>((v + (v >> 16)) & 0x3fU);
    }
    const auto others = load_lanes<ByteLanes>(labels + std::ptrdiff_t{chunk} * kBandLanes);
    const auto different = reinterpret_cast<ByteLanes>(others != label);
    const ByteLanes cost = load_lanes<ByteLanes>(bits) + (different & label_penalty_);
    costs_[static_cast<std::size_t>(chunk)] = others == ByteLanes{} ? spread(kWorstCost) : cost;
  }
}

// A path that begins here.
template <int kChunks>
void Matcher<kChunks>::start(Path& path) const {
  path.clear();
  ByteLanes lowest = spread(255);
  for (int chunk = 0; chunk < kChunks; ++chunk) {
    const ByteLanes cost = costs_[static_cast<std::size_t>(chunk)];
    std::memcpy(path.lanes + chunk * kBandLanes, &cost, sizeof cost);
    lowest = least(lowest, cost);
  }
  path.least = spread_least(lowest);
}

// L(d) = C(d) + min(L'(d), L'(d ± 1) + P1, min L' + P2) − min L', with the neighbour's band `shift` lower.
template <int kChunks>
void Matcher<kChunks>::extend(const Path& before, int shift, ByteLanes large, Path& path) const {
  const bool apart = std::abs(shift) >= kBandPadding;
  const ByteLanes jump = before.least + large;
  ByteLanes lowest = spread(255);
  for (int chunk = 0; chunk < kChunks; ++chunk) {
    ByteLanes best = jump;
    if (!apart) {
      // From the whole object: a band that is shifted reads its neighbour's padding.
      const std::uint8_t* from = reinterpret_cast<const std::uint8_t*>(&before) + kBandPadding +
                                 std::ptrdiff_t{chunk} * kBandLanes + shift;
      const ByteLanes beside = least(load_lanes<ByteLanes>(from - 1), load_lanes<ByteLanes>(from + 1));
      best = least(best, least(load_lanes<ByteLanes>(from), beside + small_penalty_));
    }
    const ByteLanes total = costs_[static_cast<std::size_t>(chunk)] + (best - before.least);
    std::memcpy(path.lanes + chunk * kBandLanes, &total, sizeof total);
    lowest = least(lowest, total);
  }
  path.least = spread_least(lowest);
}

template <int kChunks>
void Matcher<kChunks>::sweep_row(int y, int previous_y, int step) {
  const int parity = y & 1;
  Path* now = path_row(parity);
  const Path* before = path_row(1 - parity);
  const bool has_previous = previous_y >= 0 && previous_y < height_;
  const std::uint8_t* labels = pair_.labels[0].row(y);
  const std::uint8_t* previous_labels = has_previous ? pair_.labels[0].row(previous_y) : nullptr;
  std::array<Path, 2> along;
  for (Path& path : along) path.clear();
  bool open = false;
  for (int j = 0; j < width_; ++j) {
    const int x = step > 0 ? j : width_ - 1 - j;
    if (labels[x] == 0) {
      open = false;
      continue;
    }
    compute_costs(x, y);
    const int base = base_.at(x, y);
    Path& here = along[static_cast<std::size_t>(j & 1)];
    if (open) {
      extend(along[static_cast<std::size_t>(1 - (j & 1))], base - base_.at(x - step, y),
             large_penalty(x, y, x - step, y), here);
    } else {
      start(here);
      open = true;
    }
    std::uint16_t* sums = sums_at(x, y);
    Path& down = now[x];
    if (has_previous && previous_labels[x] != 0) {
      extend(before[x], base - base_.at(x, previous_y), large_penalty(x, y, x, previous_y), down);
    } else {
      start(down);
    }
    add_paths(here, down, step > 0, sums);
  }
}

template <int kChunks>
void Matcher<kChunks>::sweep(bool forward, ImageView<Disparity> disparity) {
  for (int which = 0; which < 2; ++which) {
    for (int i = -1; i <= width_; ++i) path_row(which)[i].clear();
  }
  const int step = forward ? 1 : -1;
  for (int i = 0; i < height_; ++i) {
    const int y = forward ? i : height_ - 1 - i;
    load_second_row(y);
    sweep_row(y, y - step, step);
    if (!forward) choose(y, disparity.row(y));
  }
}

template <int kChunks>
void Matcher<kChunks>::choose(int y, Disparity* disparity) const {
  for (int x = 0; x < width_; ++x) {
    disparity[x] = kNoDisparity;
    if (pair_.labels[0].at(x, y) == 0) continue;
    const std::uint16_t* sums = sums_at(x, y);
    const int best = find_least<kLanes>(sums);
    int fraction = 0;
    if (best > 0 && best + 1 < kLanes) {
      fraction = parabola_offset(sums[sum_index(best - 1)], sums[sum_index(best)], sums[sum_index(best + 1)]);
    }
    disparity[x] = static_cast<Disparity>((base_.at(x, y) + best) * kDisparityScale + fraction);
  }
}

template <int kChunks>
void match_band(const BandedPair& pair, ImageView<const std::int16_t> first_disparity,
                const SgmParams& params, SgmWorkspace& workspace, ImageView<Disparity> disparity) {
  Matcher<kChunks> matcher(pair, first_disparity, params, workspace);
  matcher.sweep(true, disparity);
  matcher.sweep(false, disparity);
}

}  // namespace

void match_sgm(const BandedPair& pair, ImageView<const std::int16_t> first_disparity, int lanes,
               const SgmParams& params, SgmWorkspace& workspace, ImageView<Disparity> disparity) {
  switch (lanes / kBandLanes) {
    case 1:
      return match_band<1>(pair, first_disparity, params, workspace, disparity);
    case 2:
      return match_band<2>(pair, first_disparity, params, workspace, disparity);
    case 3:
      return match_band<3>(pair, first_disparity, params, workspace, disparity);
    default:
      return match_band<4>(pair, first_disparity, params, workspace, disparity);
  }
}

}  // namespace traygauge
