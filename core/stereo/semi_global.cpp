#include "core/stereo/semi_global.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "core/stereo/row_lanes.hpp"
#include "core/stereo/subpixel.hpp"

namespace traygauge {
namespace {

// Path costs stay below worst cost + large penalty; a pad above that never wins and never overflows.
constexpr std::uint8_t kPadCost = 200;
constexpr int kWorstCost = 63;

ByteLanes least(ByteLanes a, ByteLanes b) {
  return a < b ? a : b;
}

std::uint8_t least_lane(ByteLanes lanes) {
  std::uint64_t halves[2];
  std::memcpy(halves, &lanes, sizeof lanes);
  HalfByteLanes low;
  HalfByteLanes high;
  std::memcpy(&low, &halves[0], sizeof low);
  std::memcpy(&high, &halves[1], sizeof high);
  std::uint8_t result = 255;
  const HalfByteLanes both = low < high ? low : high;
  for (int i = 0; i < 8; ++i) result = std::min(result, static_cast<std::uint8_t>(both[i]));
  return result;
}

// One path cost vector with padding: [pad | lanes | pad].
struct PathRow {
  std::uint8_t* lanes;
  std::uint8_t* floors;
  int stride;  // of pixels
  std::uint8_t* at(int x) const { return lanes + (x + 1) * stride + kBandPadding; }
  std::uint8_t& floor(int x) const { return floors[x + 1]; }
};

class Matcher {
 public:
  Matcher(const BandedPair& pair, ImageView<const std::int16_t> first_disparity, int lanes,
          const SemiGlobalParams& params, SemiGlobalWorkspace& workspace)
      : pair_(pair), base_(first_disparity), lanes_(lanes), params_(params), workspace_(workspace) {
    width_ = pair.gray[0].width;
    height_ = pair.gray[0].height;
    stride_ = lanes + 2 * kBandPadding;
    border_penalty_ = static_cast<std::uint8_t>(params.border_penalty);
    for (int contrast = 0; contrast < 256; ++contrast) {
      const int penalty =
          params.large_step_penalty * params.edge_contrast / (params.edge_contrast + contrast);
      large_penalty_[static_cast<std::size_t>(contrast)] =
          static_cast<std::uint8_t>(std::max(penalty, params.least_large_penalty));
    }
  }

  void sweep(bool forward, const std::array<ImageView<Disparity>, 2>* disparity);

 private:
  PathRow path_row(int which, int direction) const {
    const auto row = static_cast<std::size_t>(which);
    const int columns = width_ + 2;
    return {workspace_.paths[row].data() + direction * columns * stride_,
            workspace_.floors[row].data() + direction * columns, stride_};
  }
  void clear(const PathRow& row, int x) const {
    std::uint8_t* path = row.at(x) - kBandPadding;
    std::memset(path, kPadCost, static_cast<std::size_t>(stride_));
    std::memset(path + kBandPadding, 0, static_cast<std::size_t>(lanes_));
    row.floor(x) = 0;
  }
  void load_second_row(int y);
  void compute_costs(int x, int y);
  std::uint8_t extend(const std::uint8_t* before, std::uint8_t floor, int shift, std::uint8_t large,
                      std::uint8_t* path) const;
  void choose(int y, const std::array<ImageView<Disparity>, 2>& disparity);
  // What a jump between two neighbours costs.
  std::uint8_t large_penalty(int x, int y, int from_x, int from_y) const {
    if (pair_.labels[0].at(x, y) != pair_.labels[0].at(from_x, from_y)) return border_penalty_;
    const int contrast = std::abs(pair_.gray[0].at(x, y) - pair_.gray[0].at(from_x, from_y));
    return large_penalty_[static_cast<std::size_t>(contrast)];
  }
  std::uint16_t* sums_at(int x, int y) const {
    return workspace_.sums.data() + (static_cast<std::ptrdiff_t>(y) * width_ + x) * lanes_;
  }

  const BandedPair& pair_;
  ImageView<const std::int16_t> base_;
  int lanes_;
  const SemiGlobalParams& params_;
  SemiGlobalWorkspace& workspace_;
  int width_ = 0;
  int height_ = 0;
  int stride_ = 0;
  std::array<std::uint8_t, 256> large_penalty_{};
  std::uint8_t border_penalty_ = 0;
  alignas(16) std::array<std::uint8_t, kMaxBandLanes> costs_{};
};

// The second picture's row between paddings that match nothing.
void Matcher::load_second_row(int y) {
  const auto padding = static_cast<std::size_t>(kMaxBandLanes);
  const auto columns = static_cast<std::size_t>(width_);
  std::memcpy(workspace_.padded_codes.data() + padding, pair_.codes[1].row(y),
              columns * sizeof(std::uint32_t));
  std::memset(workspace_.padded_labels.data(), 0, padding);
  std::memcpy(workspace_.padded_labels.data() + padding, pair_.labels[1].row(y), columns);
  std::memset(workspace_.padded_labels.data() + padding + columns, 0, padding);
}

void Matcher::compute_costs(int x, int y) {
  const std::uint32_t code = pair_.codes[0].at(x, y);
  const std::uint32_t mask = pair_.mask.at(x, y);
  const std::uint8_t label = pair_.labels[0].at(x, y);
  const auto penalty = static_cast<std::uint8_t>(params_.label_penalty);
  // A band may start far outside; it stays within the padding, where nothing matches.
  const int start = std::clamp(x + base_.at(x, y), -kMaxBandLanes, width_ + kMaxBandLanes - lanes_);
  const std::uint32_t* codes = workspace_.padded_codes.data() + kMaxBandLanes + start;
  const std::uint8_t* labels = workspace_.padded_labels.data() + kMaxBandLanes + start;
  std::uint8_t* costs = costs_.data();
  for (int chunk = 0; chunk < lanes_; chunk += kBandLanes) {
    std::uint32_t bits[kBandLanes];
    for (int k = 0; k < kBandLanes; ++k) {
      std::uint32_t v = (code ^ codes[chunk + k]) & mask;
      v = v - ((v >> 1) & 0x55555555U);
      v = (v & 0x33333333U) + ((v >> 2) & 0x33333333U);
      v = (v + (v >> 4)) & 0x0f0f0f0fU;
      v = v + (v >> 8);
      bits[k] = (v + (v >> 16)) & 0x3fU;
    }
    for (int k = 0; k < kBandLanes; ++k) {
      const std::uint8_t other = labels[chunk + k];
      const auto different = static_cast<std::uint8_t>(other == label ? 0 : penalty);
      const auto cost = static_cast<std::uint8_t>(static_cast<std::uint8_t>(bits[k]) + different);
      costs[chunk + k] = other == 0 ? static_cast<std::uint8_t>(kWorstCost) : cost;
    }
  }
}

// L(d) = C(d) + min(L'(d), L'(d ± 1) + P1, min L' + P2) − min L', with the neighbour's band `shift` lower.
std::uint8_t Matcher::extend(const std::uint8_t* before, std::uint8_t floor, int shift, std::uint8_t large,
                             std::uint8_t* path) const {
  const bool apart = std::abs(shift) >= kBandPadding;
  const ByteLanes jump = broadcast_byte(static_cast<std::uint8_t>(floor + large));
  const ByteLanes small = broadcast_byte(static_cast<std::uint8_t>(params_.small_step_penalty));
  const ByteLanes floors = broadcast_byte(floor);
  ByteLanes lowest = broadcast_byte(255);
  for (int chunk = 0; chunk < lanes_; chunk += kBandLanes) {
    ByteLanes best = jump;
    if (!apart) {
      const std::uint8_t* from = before + chunk + shift;
      const ByteLanes beside = least(load_lanes<ByteLanes>(from - 1), load_lanes<ByteLanes>(from + 1));
      best = least(best, least(load_lanes<ByteLanes>(from), beside + small));
    }
    const ByteLanes total = load_lanes<ByteLanes>(costs_.data() + chunk) + (best - floors);
    std::memcpy(path + chunk, &total, sizeof total);
    lowest = least(lowest, total);
  }
  return least_lane(lowest);
}

void Matcher::sweep(bool forward, const std::array<ImageView<Disparity>, 2>* disparity) {
  const int step = forward ? 1 : -1;
  const int directions = params_.diagonal_paths ? 3 : 1;
  for (int which = 0; which < 2; ++which) {
    for (int direction = 0; direction < 3; ++direction) {
      const PathRow row = path_row(which, direction);
      for (int x = -1; x <= width_; ++x) clear(row, x);
    }
  }
  alignas(16) std::array<std::uint8_t, kMaxBandLanes + 2 * kBandPadding> row_path{};
  for (int i = 0; i < height_; ++i) {
    const int y = forward ? i : height_ - 1 - i;
    const int previous_y = y - step;
    const bool has_previous = i > 0;
    const int current = i & 1;
    load_second_row(y);
    std::memset(row_path.data(), kPadCost, row_path.size());
    std::uint8_t* along = row_path.data() + kBandPadding;
    std::uint8_t along_floor = 0;
    bool along_open = false;
    for (int j = 0; j < width_; ++j) {
      const int x = forward ? j : width_ - 1 - j;
      std::array<PathRow, 3> rows;
      for (int k = 0; k < directions; ++k) rows[static_cast<std::size_t>(k)] = path_row(current, k);
      if (pair_.labels[0].at(x, y) == 0) {
        for (int k = 0; k < directions; ++k) clear(rows[static_cast<std::size_t>(k)], x);
        along_open = false;
        continue;
      }
      compute_costs(x, y);
      const int base = base_.at(x, y);
      std::uint16_t* sums = sums_at(x, y);
      if (forward) std::memset(sums, 0, static_cast<std::size_t>(lanes_) * sizeof *sums);
      const auto add = [&](const std::uint8_t* path) {
        for (int k = 0; k < lanes_; ++k) sums[k] = static_cast<std::uint16_t>(sums[k] + path[k]);
      };
      if (!along_open) {
        std::memset(along, 0, static_cast<std::size_t>(lanes_));
        along_floor = 0;
        along_floor = extend(along, 0, 0, 0, along);
        along_open = true;
      } else {
        alignas(16) std::array<std::uint8_t, kMaxBandLanes> next{};
        along_floor = extend(along, along_floor, base - base_.at(x - step, y),
                             large_penalty(x, y, x - step, y), next.data());
        std::memcpy(along, next.data(), static_cast<std::size_t>(lanes_));
      }
      add(along);
      constexpr std::array<int, 3> kSides{0, -1, 1};
      for (int k = 0; k < directions; ++k) {
        const int from_x = x + kSides[static_cast<std::size_t>(k)];
        const PathRow before = path_row(1 - current, k);
        const PathRow& now = rows[static_cast<std::size_t>(k)];
        const bool known =
            has_previous && from_x >= 0 && from_x < width_ && pair_.labels[0].at(from_x, previous_y) != 0;
        if (!known) {
          clear(now, x);
          now.floor(x) = extend(now.at(x), 0, 0, 0, now.at(x));
        } else {
          now.floor(x) = extend(before.at(from_x), before.floor(from_x), base - base_.at(from_x, previous_y),
                                large_penalty(x, y, from_x, previous_y), now.at(x));
        }
        add(now.at(x));
      }
    }
    if (disparity != nullptr) choose(y, *disparity);
  }
}

// The least sum of every pixel of the first picture, and of all that meet in one of the second.
void Matcher::choose(int y, const std::array<ImageView<Disparity>, 2>& disparity) {
  Disparity* first = disparity[0].row(y);
  Disparity* second = disparity[1].row(y);
  std::uint16_t* second_best = workspace_.second_best.data();
  std::fill_n(second, width_, kNoDisparity);
  std::fill_n(second_best, width_, std::numeric_limits<std::uint16_t>::max());
  for (int x = 0; x < width_; ++x) {
    first[x] = kNoDisparity;
    if (pair_.labels[0].at(x, y) == 0) continue;
    const std::uint16_t* sums = sums_at(x, y);
    const int base = base_.at(x, y);
    int best = -1;
    for (int k = 0; k < lanes_; ++k) {
      const int partner = x + base + k;
      if (partner < 0 || partner >= width_ || pair_.labels[1].at(partner, y) == 0) continue;
      if (best < 0 || sums[k] < sums[best]) best = k;
      if (sums[k] >= second_best[partner]) continue;
      second_best[partner] = sums[k];
      second[partner] = static_cast<Disparity>((base + k) * kDisparityScale);
    }
    if (best < 0) continue;
    int fraction = 0;
    if (best > 0 && best + 1 < lanes_) fraction = parabola_offset(sums[best - 1], sums[best], sums[best + 1]);
    first[x] = static_cast<Disparity>((base + best) * kDisparityScale + fraction);
  }
}

}  // namespace

void match_semi_global(const BandedPair& pair, ImageView<const std::int16_t> first_disparity, int lanes,
                       const SemiGlobalParams& params, SemiGlobalWorkspace& workspace,
                       const std::array<ImageView<Disparity>, 2>& disparity) {
  Matcher matcher(pair, first_disparity, lanes, params, workspace);
  matcher.sweep(true, nullptr);
  matcher.sweep(false, &disparity);
}

}  // namespace traygauge
