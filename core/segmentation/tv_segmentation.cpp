#include "core/segmentation/tv_segmentation.hpp"

#include <algorithm>

#include "core/base/lanes.hpp"
#include "core/segmentation/colour_sum.hpp"
#include "core/segmentation/geodesic.hpp"

namespace traygauge {
namespace {

constexpr float kOutside = -1e3F;  // no food beside the dish
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
  FoodField(const DishInView& dish, const GlazeColour& glaze, const FoodWeights& weights,
            const TvSegmentationParams& params, TvSegmentationWorkspace& workspace)
      : dish_(dish),
        glaze_(glaze),
        weights_(weights),
        params_(params),
        workspace_(workspace),
        field_{dish.raster.width() / params.fold, dish.raster.height() / params.fold} {}

  void weigh() {
    for (int y = 0; y < field_.height; ++y) {
      for (int x = 0; x < field_.width; ++x) weigh(x, y);
    }
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
        cells.at(x, y) = dish_.raster.zones.at(x, y) == DishZone::outside ? kBarred
                         : workspace_.share[at] > 0.5F                    ? kFoodSeed
                                                                          : kGlazeSeed;
      }
    }
  }

 private:
  void weigh(int x, int y) {
    const int fold = params_.fold;
    const std::size_t at = field_.at(x, y);
    workspace_.colours[at] = mean_colour(x, y);
    workspace_.evidence[at] = kOutside;
    if (!is_on_dish(x, y)) return;
    const FoodSigns signs =
        food_signs(dish_, glaze_, params_.evidence, x * fold, y * fold, fold, workspace_.colours[at]);
    const double log_odds = signs.log_odds(weights_);
    workspace_.evidence[at] = static_cast<float>(log_odds);
    if (dish_.observer == nullptr) return;
    const double middle = 0.5 * (fold - 1);
    dish_.observer->on_place(dish_.raster.pixel_of(x * fold + middle, y * fold + middle),
                             fold * dish_.raster.step_px, signs, log_odds);
  }

  CellColour mean_colour(int x, int y) const {
    const int fold = params_.fold;
    ColourSum colours;
    for (int j = y * fold; j < (y + 1) * fold; ++j) {
      for (int i = x * fold; i < (x + 1) * fold; ++i) colours.add(dish_.raster.colours.at(i, j));
    }
    return colours.mean(fold * fold);
  }

  // All of a cell lies within the dish's edge.
  bool is_on_dish(int x, int y) const {
    const int fold = params_.fold;
    for (int j = y * fold; j < (y + 1) * fold; ++j) {
      for (int i = x * fold; i < (x + 1) * fold; ++i) {
        const DishZone zone = dish_.raster.zones.at(i, j);
        if (zone == DishZone::outside || zone == DishZone::edge) return false;
      }
    }
    return true;
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

  const DishInView& dish_;
  const GlazeColour& glaze_;
  const FoodWeights& weights_;
  const TvSegmentationParams& params_;
  TvSegmentationWorkspace& workspace_;
  Field field_;
};

}  // namespace

void segment_food(const DishInView& dish, const GlazeColour& glaze, const FoodWeights& weights,
                  const TvSegmentationParams& params, TvSegmentationWorkspace& workspace,
                  ImageView<std::uint8_t> cells) {
  FoodField field(dish, glaze, weights, params, workspace);
  field.weigh();
  field.solve();
  field.write(cells);
}

}  // namespace traygauge
