#include "core/segmentation/tv_segmentation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/lanes.hpp"
#include "core/base/units.hpp"
#include "core/segmentation/colour_sum.hpp"
#include "core/segmentation/geodesic.hpp"
#include "core/stereo/median.hpp"

namespace traygauge {
namespace {

constexpr float kOutside = -1e3F;  // no food beside the dish
constexpr int kLeastPlainCells = 200;
constexpr std::size_t kHues = 24;  // on the circle
constexpr int kLeastHueCells = 20;
constexpr float kStep = 0.35F;  // of both variables; its square is less than one over the 8 of the gradient

struct Field {
  int width = 0;
  int height = 0;

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

class FoodField {
 public:
  FoodField(const DishRaster& raster, ImageView<const HeightSample> relief, const GlazeColour& glaze,
            const TvSegmentationParams& params, TvSegmentationWorkspace& workspace)
      : raster_(raster),
        relief_(relief),
        glaze_(glaze),
        params_(params),
        workspace_(workspace),
        field_{raster.width() / params.fold, raster.height() / params.fold} {}

  void weigh() {
    is_filled_ = stands_high();
    for (int y = 0; y < field_.height; ++y) {
      for (int x = 0; x < field_.width; ++x) fold(x, y);
    }
    filter_median({workspace_.bends.data(), field_.width, field_.height}, params_.texture_reach,
                  {workspace_.median_bends.data(), field_.width, field_.height});
    const std::size_t count = field_.at(0, field_.height);
    learn_hues();
    for (std::size_t at = 0; at < count; ++at) add_colour(at);
    for (int y = 0; y < field_.height; ++y) {
      for (int x = 0; x < field_.width; ++x) limit_flow(x, y);
    }
  }

  void solve() {
    const std::size_t count = field_.at(0, field_.height);
    for (std::size_t i = 0; i < count; ++i) {
      workspace_.share[i] = workspace_.leading[i] = workspace_.evidence[i] > 0.0F ? 1.0F : 0.0F;
      workspace_.right[i] = workspace_.below[i] = 0.0F;
    }
    for (int sweep = 0; sweep < params_.sweeps; ++sweep) {
      for (int y = 0; y < field_.height; ++y) push_row(y);
      for (int y = 0; y < field_.height; ++y) settle_row(y);
    }
  }

  void write(ImageView<std::uint8_t> cells) const {
    for (int y = 0; y < cells.height; ++y) {
      for (int x = 0; x < cells.width; ++x) {
        const std::size_t at = field_.at(std::min(x / params_.fold, field_.width - 1),
                                         std::min(y / params_.fold, field_.height - 1));
        cells.at(x, y) = raster_.zones.at(x, y) == DishZone::outside ? kBarred
                         : workspace_.share[at] > 0.5F               ? kFoodSeed
                                                                     : kGlazeSeed;
      }
    }
  }

 private:
  // Whether what looks like glaze stands above it, all over the dish, and below its edge: what lies at the
  // edge itself may be the match of the edge, continued over a dish where nothing can be matched.
  bool stands_high() const {
    std::array<int, kByteValues> counts{};
    int seen = 0;
    const double most = params_.neutral_deviations * glaze_.share_sigma;
    for (int y = 0; y < raster_.height(); ++y) {
      for (int x = 0; x < raster_.width(); ++x) {
        const HeightSample& sample = relief_.at(x, y);
        if (!sample.is_known || raster_.zones.at(x, y) != DishZone::inside) continue;
        const CellColour& colour = raster_.colours.at(x, y);
        const int red = colour.red - glaze_.median.red;
        const int green = colour.green - glaze_.median.green;
        if (red * red + green * green > most * most) continue;
        ++counts[static_cast<std::size_t>(sample.height + 128)];
        ++seen;
      }
    }
    if (seen < kLeastPlainCells) return false;
    const auto quartile_mm = [&](int quarters) {
      int below = 0;
      std::size_t at = 0;
      while (4 * (below + counts[at]) < quarters * seen) below += counts[at++];
      return kHeightUnitMm * (static_cast<double>(at) - 128.0);
    };
    return quartile_mm(1) > params_.filled_mm && quartile_mm(3) < raster_.depth_mm - params_.free_edge_mm;
  }

  // Means over a cell of the field; its evidence by relief alone.
  void fold(int x, int y) {
    const int fold = params_.fold;
    ColourSum colours;
    int bends = 0;
    double lift = 0.0;
    bool is_outside = false;
    for (int j = y * fold; j < (y + 1) * fold; ++j) {
      for (int i = x * fold; i < (x + 1) * fold; ++i) {
        colours.add(raster_.colours.at(i, j));
        bends += bend_at(raster_.colours, i, j);
        const double told = lift_of(relief_.at(i, j), !is_filled_, params_.relief);
        lift += told * (told > 0.0 ? params_.lift_weight : params_.against_weight);
        const DishZone zone = raster_.zones.at(i, j);
        is_outside |= zone == DishZone::outside || zone == DishZone::edge;
      }
    }
    const int count = fold * fold;
    const std::size_t at = field_.at(x, y);
    workspace_.colours[at] = colours.mean(count);
    workspace_.bends[at] = static_cast<std::int16_t>(std::min(255, 2 * bends / count));
    workspace_.evidence[at] = is_outside ? kOutside : static_cast<float>(params_.prior + lift / count);
  }

  // How a cell's colour differs from the glaze's.
  struct Tint {
    double red = 0.0;
    double green = 0.0;
    double deviations = 0.0;

    std::size_t hue() const {
      const double turns = std::atan2(green, red) / (2.0 * std::numbers::pi) + 1.0;
      return static_cast<std::size_t>(turns * kHues) % kHues;
    }
  };

  Tint tint_of(std::size_t at) const {
    const CellColour& colour = workspace_.colours[at];
    const double red = colour.red - glaze_.median.red;
    const double green = colour.green - glaze_.median.green;
    return {red, green, std::sqrt(red * red + green * green) / glaze_.share_sigma};
  }

  // How strongly food that stands above the dish is coloured: the mean for each hue.
  void learn_hues() {
    std::array<int, kHues> counts{};
    std::array<double, kHues> sums{};
    const std::size_t count = field_.at(0, field_.height);
    for (std::size_t at = 0; at < count; ++at) {
      if (!(workspace_.evidence[at] > params_.standing_lift)) continue;
      const Tint tint = tint_of(at);
      if (tint.deviations < params_.neutral_deviations) continue;
      const std::size_t hue = tint.hue();
      ++counts[hue];
      sums[hue] += tint.deviations;
    }
    for (std::size_t hue = 0; hue < kHues; ++hue) {
      food_deviations_[hue] = counts[hue] < kLeastHueCells ? 0.0 : sums[hue] / counts[hue];
    }
  }

  // From 0 to 1: whether a cell lies in shade and shows, more weakly, the hue of food that stands there.
  double second_hand(std::size_t at, const Tint& tint) const {
    if (workspace_.evidence[at] > params_.standing_lift) return 0.0;
    const double luma =
        static_cast<double>(workspace_.colours[at].luma) / std::max<int>(1, glaze_.median.luma);
    if (luma >= params_.lit_luma) return 0.0;
    const std::size_t hue = tint.hue();
    const double strongest = std::max({food_deviations_[(hue + kHues - 1) % kHues], food_deviations_[hue],
                                       food_deviations_[(hue + 1) % kHues]});
    return tint.deviations > params_.tint_fraction * strongest
               ? 0.0
               : std::min((params_.lit_luma - luma) / params_.penumbra_luma, 1.0);
  }

  void add_colour(std::size_t at) {
    if (!(workspace_.evidence[at] > kOutside)) return;
    const Tint tint = tint_of(at);
    const double texture = workspace_.median_bends[at] / glaze_.texture;
    const double rough = std::clamp(
        (texture - params_.neutral_texture) / (params_.full_texture - params_.neutral_texture), 0.0, 1.0);
    const double off = tint.deviations - params_.shade_deviations * (1.0 - rough) * second_hand(at, tint);
    const double told = std::clamp(
        (off - params_.neutral_deviations) / (params_.full_deviations - params_.neutral_deviations),
        params_.least_colour, params_.most_colour);
    if (is_filled_ && told < 0.0) return;
    const double like_glaze = told < 0.0 ? (1.0 - rough) * told / params_.least_colour : 0.0;
    float& evidence = workspace_.evidence[at];
    if (evidence > 0.0F) evidence *= static_cast<float>(1.0 - (1.0 - params_.plain_fraction) * like_glaze);
    evidence += static_cast<float>(params_.colour_weight * (told < 0.0 ? (1.0 - rough) * told : told) +
                                   params_.texture_weight * rough);
  }

  float limit_between(std::size_t a, std::size_t b) const {
    const CellColour& p = workspace_.colours[a];
    const CellColour& q = workspace_.colours[b];
    const int luma = p.luma - q.luma;
    const int red = 2 * (p.red - q.red);
    const int green = 2 * (p.green - q.green);
    const double contrast = luma * luma + red * red + green * green;
    const double kept = 1.0 / (1.0 + contrast / (params_.edge_contrast * params_.edge_contrast));
    return static_cast<float>(params_.outline *
                              (params_.least_outline + (1.0 - params_.least_outline) * kept));
  }

  void limit_flow(int x, int y) {
    const std::size_t at = field_.at(x, y);
    workspace_.right_limit[at] = x + 1 < field_.width ? limit_between(at, field_.at(x + 1, y)) : 0.0F;
    workspace_.below_limit[at] = y + 1 < field_.height ? limit_between(at, field_.at(x, y + 1)) : 0.0F;
  }

  void push_row(int y) {
    const std::size_t row = field_.at(0, y);
    const auto width = static_cast<std::size_t>(field_.width);
    const float* leading = &workspace_.leading[row];
    const float* next = y + 1 < field_.height ? leading + width : leading;
    float* right = &workspace_.right[row];
    float* below = &workspace_.below[row];
    const float* right_limit = &workspace_.right_limit[row];
    const float* below_limit = &workspace_.below_limit[row];
    for (std::size_t x = 0; x + 1 < width; ++x)
      right[x] =
          std::clamp(right[x] + kStep * (leading[x + 1] - leading[x]), -right_limit[x], right_limit[x]);
    for (std::size_t x = 0; x < width; ++x)
      below[x] = std::clamp(below[x] + kStep * (next[x] - leading[x]), -below_limit[x], below_limit[x]);
  }

  void settle_row(int y) {
    const std::size_t row = field_.at(0, y);
    const auto width = static_cast<std::size_t>(field_.width);
    float* share = &workspace_.share[row];
    float* leading = &workspace_.leading[row];
    const float* right = &workspace_.right[row];
    const float* below = &workspace_.below[row];
    const float* above = y > 0 ? below - width : nullptr;
    const float* evidence = &workspace_.evidence[row];
    const auto flow = [&](std::size_t x) {
      return right[x] - (x > 0 ? right[x - 1] : 0.0F) + below[x] - (above != nullptr ? above[x] : 0.0F);
    };
    const auto settle = [&](std::size_t x) {
      const float before = share[x];
      share[x] = std::clamp(before + kStep * (flow(x) + evidence[x]), 0.0F, 1.0F);
      leading[x] = 2.0F * share[x] - before;
    };
    settle(0);
    std::size_t x = 1;
    constexpr FloatLanes kNone{};
    constexpr FloatLanes kAll = {1.0F, 1.0F, 1.0F, 1.0F};
    for (; x + kFloatLanes <= width; x += kFloatLanes) {
      const FloatLanes before = load_floats(share + x);
      const FloatLanes from_above = above != nullptr ? load_floats(above + x) : kNone;
      const FloatLanes inflow =
          load_floats(right + x) - load_floats(right + x - 1) + load_floats(below + x) - from_above;
      FloatLanes settled = before + kStep * (inflow + load_floats(evidence + x));
      settled = settled < kNone ? kNone : settled;
      settled = settled > kAll ? kAll : settled;
      store_floats(share + x, settled);
      store_floats(leading + x, 2.0F * settled - before);
    }
    for (; x < width; ++x) settle(x);
  }

  const DishRaster& raster_;
  ImageView<const HeightSample> relief_;
  const GlazeColour& glaze_;
  const TvSegmentationParams& params_;
  TvSegmentationWorkspace& workspace_;
  Field field_;
  bool is_filled_ = false;
  std::array<double, kHues> food_deviations_{};  // 0: no food of this hue
};

}  // namespace

void segment_food(const DishRaster& raster, ImageView<const HeightSample> relief, const GlazeColour& glaze,
                  const TvSegmentationParams& params, TvSegmentationWorkspace& workspace,
                  ImageView<std::uint8_t> cells) {
  FoodField field(raster, relief, glaze, params, workspace);
  field.weigh();
  field.solve();
  field.write(cells);
}

}  // namespace traygauge
