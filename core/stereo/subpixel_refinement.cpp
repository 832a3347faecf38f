#include "core/stereo/subpixel_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

constexpr int kChannels = SubpixelRefinementWorkspace::kChannels;
constexpr int kOutlinePx = 2 * kRefinementRadius;
constexpr float kLeastEnergy = 0.01F;  // grey², of a window without any gradient, and of what holds a sample

// Value and slope of the cubic through four samples (Catmull-Rom).
struct CubicSample {
  float value;
  float slope;
};

CubicSample interpolate(const std::uint8_t* at, float t) {
  const auto p0 = static_cast<float>(at[-1]);
  const auto p1 = static_cast<float>(at[0]);
  const auto p2 = static_cast<float>(at[1]);
  const auto p3 = static_cast<float>(at[2]);
  const float a = 0.5F * (p3 - p0) + 1.5F * (p1 - p2);
  const float b = p0 - 2.5F * p1 + 2.0F * p2 - 0.5F * p3;
  const float c = 0.5F * (p2 - p0);
  return {p1 + t * (c + t * (b + t * a)), c + t * (2.0F * b + 3.0F * t * a)};
}

class Refinement {
 public:
  Refinement(const RefinementPair& pair, ImageView<const std::uint8_t> trusted,
             const SubpixelRefinementParams& params, SubpixelRefinementWorkspace& workspace,
             ImageView<float> disparity)
      : pair_(pair), trusted_(trusted), params_(params), workspace_(workspace), disparity_(disparity) {
    columns_ = static_cast<std::ptrdiff_t>(disparity.width) + std::ptrdiff_t{2} * kRefinementRadius;
  }

  void tie_neighbours();
  void smooth();
  void collect_evidence();
  void relax(bool downwards);

 private:
  float* terms(int y, int channel) const {
    const int slot = y % (2 * kRefinementRadius + 1);
    return workspace_.terms.data() + (slot * kChannels + channel) * columns_ + kRefinementRadius;
  }
  float* windows(int channel) const { return workspace_.windows.data() + channel * columns_; }
  float* sums(int channel) const { return workspace_.sums.data() + channel * columns_ + kRefinementRadius; }
  static std::ptrdiff_t at(ImageView<float> picture, int y) { return std::ptrdiff_t{y} * picture.width; }
  // First labelled column of a row, and the one behind the last.
  std::pair<int, int> labelled_columns(int y) const {
    const std::uint8_t* labels = pair_.labels.row(y);
    int first = 0;
    int last = disparity_.width;
    while (first < last && labels[first] == 0) ++first;
    while (last > first && labels[last - 1] == 0) --last;
    return {first, last};
  }
  void compute_terms(int y);
  // Whether the row has one label around a sample, a window's width to either side: nearer to another one its
  // gradient is its outline's.
  bool is_inside_outline(const std::uint8_t* labels, int x) const {
    const int left = std::max(x - kOutlinePx, 0);
    const int right = std::min(x + kOutlinePx, disparity_.width - 1);
    return labels[left] == labels[x] && labels[right] == labels[x];
  }
  void solve_row(int y);

  const RefinementPair& pair_;
  ImageView<const std::uint8_t> trusted_;
  const SubpixelRefinementParams& params_;
  SubpixelRefinementWorkspace& workspace_;
  ImageView<float> disparity_;
  std::ptrdiff_t columns_ = 0;
};

void Refinement::tie_neighbours() {
  const auto border = static_cast<float>(params_.border_tie);
  const auto most = static_cast<float>(kOneSurfacePx);
  const auto tie = [&](int x, int y, int to_x, int to_y) {
    if (to_x >= disparity_.width || to_y >= disparity_.height) return 0.0F;
    const std::uint8_t a = pair_.labels.at(x, y);
    const std::uint8_t b = pair_.labels.at(to_x, to_y);
    if (a == 0 || b == 0 || !(std::abs(disparity_.at(x, y) - disparity_.at(to_x, to_y)) <= most)) return 0.0F;
    return a == b ? 1.0F : border;
  };
  for (int y = 0; y < disparity_.height; ++y) {
    float* right = workspace_.right_tie.data() + at(disparity_, y);
    float* lower = workspace_.lower_tie.data() + at(disparity_, y);
    for (int x = 0; x < disparity_.width; ++x) {
      right[x] = tie(x, y, x + 1, y);
      lower[x] = tie(x, y, x, y + 1);
    }
  }
}

// A window's samples are resampled each at its own disparity, so what they scatter must go first.
void Refinement::smooth() {
  const auto hold = static_cast<float>(params_.smoothing_hold * params_.stiffness);
  const std::ptrdiff_t samples = at(disparity_, disparity_.height);
  std::fill_n(workspace_.certainty.data(), samples, hold);
  for (std::ptrdiff_t i = 0; i < samples; ++i) {
    workspace_.target[static_cast<std::size_t>(i)] = hold * disparity_.data[i];
  }
  for (int i = 0; i < params_.smoothings; ++i) relax(i % 2 == 0);
}

// Count, residual, gradient, gradient², gradient · residual of every sample of a row.
void Refinement::compute_terms(int y) {
  std::array<float*, kChannels> out;
  for (int k = 0; k < kChannels; ++k) {
    out[static_cast<std::size_t>(k)] = terms(y, k);
    std::fill_n(terms(y, k) - kRefinementRadius, columns_, 0.0F);
  }
  const std::uint8_t* gray = pair_.gray.row(y);
  const std::uint8_t* labels = pair_.labels.row(y);
  const std::uint8_t* other = pair_.other_gray.row(y);
  const std::uint8_t* other_labels = pair_.other_labels.row(y);
  const auto last = static_cast<float>(pair_.other_gray.width - 3);
  const auto sign = static_cast<float>(pair_.sign);
  const float dish_weight = params_.refines_dish ? 1.0F : 0.0F;
  for (int x = 0; x < disparity_.width; ++x) {
    if (trusted_.at(x, y) == 0 || pair_.labels.at(x, y) == 0) continue;
    const float place = static_cast<float>(x) + sign * disparity_.at(x, y);
    if (!(place >= 1.0F && place <= last)) continue;
    const int left = static_cast<int>(place);
    if (other_labels[left] == 0) continue;
    const CubicSample sample = interpolate(other + left, place - static_cast<float>(left));
    const float gradient = sign * sample.slope;
    const float residual = static_cast<float>(gray[x]) - sample.value;
    const float weight = is_item(labels[x]) && is_inside_outline(labels, x) ? 1.0F : dish_weight;
    const float weighted = weight * gradient;
    out[0][x] = weight;
    out[1][x] = weight * residual;
    out[2][x] = weighted;
    out[3][x] = weighted * gradient;
    out[4][x] = weighted * residual;
  }
}

// What the windows around a row ask for.
void Refinement::solve_row(int y) {
  constexpr int kRadius = kRefinementRadius;
  const int top = std::max(y - kRadius, 0);
  const int bottom = std::min(y + kRadius, disparity_.height - 1);
  for (int k = 0; k < kChannels; ++k) {
    float* sum = sums(k) - kRefinementRadius;
    std::memcpy(sum, terms(top, k) - kRefinementRadius, static_cast<std::size_t>(columns_) * sizeof(float));
    for (int i = top + 1; i <= bottom; ++i) {
      const float* term = terms(i, k) - kRefinementRadius;
      for (std::ptrdiff_t x = 0; x < columns_; ++x) sum[x] += term[x];
    }
  }
  float* certainty = workspace_.certainty.data() + at(disparity_, y);
  float* target = workspace_.target.data() + at(disparity_, y);
  const float* disparity = disparity_.row(y);
  const auto most = static_cast<float>(params_.max_step_px);
  const auto [first, last] = labelled_columns(y);
  for (int k = 0; k < kChannels; ++k) {
    const float* sum = sums(k) - kRadius;
    float* window = windows(k);
    for (int x = first; x < last; ++x) window[x] = sum[x];
    for (int i = 1; i <= 2 * kRadius; ++i) {
      for (int x = first; x < last; ++x) window[x] += sum[x + i];
    }
  }
  const std::uint8_t* trusted = trusted_.row(y);
  const float* count = windows(0);
  const float* residual = windows(1);
  const float* gradient = windows(2);
  const float* square = windows(3);
  const float* product = windows(4);
  for (int x = first; x < last; ++x) {
    const float share = count[x] > 0.0F ? 1.0F / count[x] : 0.0F;
    const float energy = square[x] - gradient[x] * gradient[x] * share;
    const float correlation = product[x] - gradient[x] * residual[x] * share;
    const float weight = trusted[x] != 0 ? std::max(energy, 0.0F) * share : 0.0F;
    const float step = correlation / std::max(energy, kLeastEnergy);
    certainty[x] = weight;
    target[x] = weight * (disparity[x] + std::max(std::min(step, most), -most));
  }
}

void Refinement::collect_evidence() {
  constexpr int kRadius = kRefinementRadius;
  for (int y = 0; y < std::min(kRadius, disparity_.height); ++y) compute_terms(y);
  for (int y = 0; y < disparity_.height; ++y) {
    if (y + kRadius < disparity_.height) compute_terms(y + kRadius);
    solve_row(y);
  }
}

// A row of the membrane and what pulls at it.
struct MembraneRow {
  float* disparity;
  const float* old;  // a copy, with one more at either end
  const float* above;
  const float* below;
  const float* certainty;
  const float* target;
  const float* right_tie;
  const float* lower_tie;
  const float* upper_tie;
};

void relax_row(const MembraneRow& row, float up, float stiffness, int first, int last) {
  float* __restrict__ disparity = row.disparity;
  const float* __restrict__ old = row.old;
  const float* __restrict__ above = row.above;
  const float* __restrict__ below = row.below;
  const auto relax_one = [&](int x, float left_tie) {
    const float right_tie = row.right_tie[x];
    const float lower_tie = row.lower_tie[x];
    const float upper_tie = up * row.upper_tie[x];
    const float pull =
        left_tie * old[x - 1] + right_tie * old[x + 1] + upper_tie * above[x] + lower_tie * below[x];
    const float ties = left_tie + right_tie + upper_tie + lower_tie;
    const float total = kLeastEnergy + row.certainty[x] + stiffness * ties;
    disparity[x] = (kLeastEnergy * old[x] + row.target[x] + stiffness * pull) / total;
  };
  if (first == last) return;
  relax_one(first, 0.0F);
  for (int x = first + 1; x < last; ++x) relax_one(x, row.right_tie[x - 1]);
}

// One Gauss-Seidel step from row to row, a Jacobi step within each.
void Refinement::relax(bool downwards) {
  const auto stiffness = static_cast<float>(params_.stiffness);
  const int width = disparity_.width;
  const int height = disparity_.height;
  for (int i = 0; i < height; ++i) {
    const int y = downwards ? i : height - 1 - i;
    float* disparity = disparity_.row(y);
    const float* above = disparity_.row(std::max(y - 1, 0));
    const float* below = disparity_.row(std::min(y + 1, height - 1));
    const float* right_tie = workspace_.right_tie.data() + at(disparity_, y);
    const float* lower_tie = workspace_.lower_tie.data() + at(disparity_, y);
    const float* upper_tie = workspace_.lower_tie.data() + at(disparity_, std::max(y - 1, 0));
    const float* certainty = workspace_.certainty.data() + at(disparity_, y);
    const float* target = workspace_.target.data() + at(disparity_, y);
    float* old = workspace_.row.data() + 1;
    std::memcpy(old, disparity, static_cast<std::size_t>(width) * sizeof(float));
    old[-1] = old[0];
    old[width] = old[width - 1];
    const auto [first, last] = labelled_columns(y);
    const float up = y > 0 ? 1.0F : 0.0F;
    relax_row({disparity, old, above, below, certainty, target, right_tie, lower_tie, upper_tie}, up,
              stiffness, first, last);
  }
}

}  // namespace

void refine_surface(const RefinementPair& pair, ImageView<const std::uint8_t> trusted,
                    const SubpixelRefinementParams& params, SubpixelRefinementWorkspace& workspace,
                    ImageView<float> disparity) {
  Refinement refinement(pair, trusted, params, workspace, disparity);
  for (int iteration = 0; iteration < params.iterations; ++iteration) {
    refinement.tie_neighbours();
    refinement.smooth();
    refinement.collect_evidence();
    for (int i = 0; i < params.relaxations; ++i) refinement.relax(i % 2 == 0);
  }
}

}  // namespace traygauge
