#include "core/segmentation/part_joining.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/segmentation/colour_classes.hpp"

namespace traygauge {
namespace {

constexpr std::int16_t kNotCounted = -1;

double ramp(double value, double none, double full) {
  return std::clamp((value - none) / (full - none), 0.0, 1.0);
}

class PartJoining {
 public:
  PartJoining(const DishRaster& raster, int side, const PartLikenessParams& params,
              PartJoiningWorkspace& workspace, FoodParts& parts)
      : raster_(raster), side_(side), params_(params), workspace_(workspace), parts_(parts) {}

  double run(int least_blocks) {
    constexpr double kNone = -std::numeric_limits<double>::infinity();
    double most_doubtful = kNone;
    count_colours();
    for (;;) {
      double most = 0.0;
      double most_apart = kNone;
      const PartBorder* best = nullptr;
      for (const PartBorder& border : measure_borders()) {
        if (slot_of(border.first) == kNotCounted || slot_of(border.second) == kNotCounted) continue;
        const double likeness = likeness_of(border);
        if (std::min(parts_.at(border.first).size, parts_.at(border.second).size) >= least_blocks)
          most_apart = std::max(most_apart, likeness);
        if (likeness <= most) continue;
        most = likeness;
        best = &border;
      }
      if (best == nullptr) return std::max(most_apart, most_doubtful);
      if (is_doubtful(parts_.at(best->first), parts_.at(best->second))) most_doubtful = 0.0;
      PartColours& kept = colours_of(best->first);
      const PartColours& joined = colours_of(best->second);
      for (std::size_t i = 0; i < kept.size(); ++i) kept[i] += joined[i];
      parts_.join(best->first, best->second);
    }
  }

 private:
  std::int16_t& slot_of(int part) const { return workspace_.slots[static_cast<std::size_t>(part)]; }
  PartColours& colours_of(int part) const {
    return workspace_.colours[static_cast<std::size_t>(slot_of(part))];
  }

  template <class Take>
  void for_each_cell_of(int block, Take&& take) const {
    const int left = block % parts_.columns() * side_;
    const int top = block / parts_.columns() * side_;
    for (int y = top; y < top + side_; ++y) {
      for (int x = left; x < left + side_; ++x) take(raster_.colours.at(x, y));
    }
  }

  // Classes are the dish's own: of all its food's cells as many in each.
  void count_colours() {
    ColourCounts counts;
    std::int16_t slots = 0;
    parts_.for_each_block([&](int block) {
      if (!parts_.is_food(block)) return;
      slot_of(block) = kNotCounted;
      if (parts_.root(block) == block && static_cast<std::size_t>(slots) < workspace_.colours.size()) {
        workspace_.colours[static_cast<std::size_t>(slots)].fill(0);
        slot_of(block) = slots++;
      }
      for_each_cell_of(block, [&](const CellColour& colour) { counts.add(colour); });
    });
    const ColourClasses classes = counts.equal_classes(kPartColourClasses, kPartColourClasses);
    parts_.for_each_block([&](int block) {
      if (!parts_.is_food(block)) return;
      const int part = parts_.root(block);
      if (slot_of(part) == kNotCounted) return;
      PartColours& colours = colours_of(part);
      for_each_cell_of(block, [&](const CellColour& colour) {
        ++colours[classes.luma[colour.luma]];
        ++colours[std::size_t{kPartColourClasses} + classes.red[colour.red]];
        ++colours[std::size_t{2} * kPartColourClasses + classes.green[colour.green]];
      });
    });
  }

  std::span<const PartBorder> measure_borders() {
    for (FoodBlock& block : parts_.blocks()) block.sides = 0;
    std::size_t count = 0;
    parts_.for_each_side([&](int block, int neighbour) {
      const int own = parts_.is_food(block) ? parts_.root(block) : -1;
      const int other = parts_.is_food(neighbour) ? parts_.root(neighbour) : -1;
      if (own == other) return;
      if (own >= 0) ++parts_.at(own).sides;
      if (other >= 0) ++parts_.at(other).sides;
      if (own < 0 || other < 0) return;
      const int first = std::min(own, other);
      const int second = std::max(own, other);
      const auto known = workspace_.borders.first(count);
      auto border = std::find_if(known.begin(), known.end(),
                                 [&](const PartBorder& b) { return b.first == first && b.second == second; });
      if (border == known.end()) {
        if (count == workspace_.borders.size()) return;
        workspace_.borders[count++] = {first, second, 0, {}};
        border = workspace_.borders.begin() + static_cast<std::ptrdiff_t>(count - 1);
      }
      ++border->sides;
      border->heights_mm[0] += parts_.at(own == first ? block : neighbour).own_height_mm;
      border->heights_mm[1] += parts_.at(own == first ? neighbour : block).own_height_mm;
    });
    return workspace_.borders.first(count);
  }

  double likeness_of(const PartBorder& border) const {
    const FoodBlock& a = parts_.at(border.first);
    const FoodBlock& b = parts_.at(border.second);
    const FoodBlock& smaller = a.size < b.size ? a : b;
    const double spread = std::sqrt(0.5 * static_cast<double>(parts_.spread_of(a) + parts_.spread_of(b)));
    const double texture =
        std::abs(static_cast<double>(a.texture) / a.size - static_cast<double>(b.texture) / b.size);
    const double share = static_cast<double>(border.sides) / std::max(1, smaller.sides);
    const double first_mm = static_cast<double>(border.heights_mm[0]) / border.sides;
    const double second_mm = static_cast<double>(border.heights_mm[1]) / border.sides;
    const double lower_mm = std::max(1.0F, std::min(FoodParts::crest_mm(a), FoodParts::crest_mm(b)));
    const double valley = std::clamp(std::min(first_mm, second_mm) / lower_mm, 0.0, params_.most_valley);
    const double step = std::abs(first_mm - second_mm) / std::max({1.0, first_mm, second_mm});
    const double upon = ramp(step, params_.least_step, params_.full_step) *
                        ramp(share, params_.least_enclosed, params_.full_enclosed);
    const double neck = border.sides / std::sqrt(static_cast<double>(smaller.size));
    const double colours = (1.0 - flank_of(a, b, first_mm, second_mm, share)) *
                           distance_between(colours_of(border.first), colours_of(border.second));
    return params_.constant + params_.spread * spread + params_.texture * texture + params_.share * share +
           params_.valley * valley + params_.upon * upon + params_.colours * colours + params_.neck * neck;
  }

  // Whether two parts are rather large to be one food that is so much higher in one place.
  bool is_doubtful(const FoodBlock& a, const FoodBlock& b) const {
    return std::min(a.size, b.size) >= params_.doubtful_blocks &&
           FoodParts::crest_ratio(a, b) > static_cast<float>(params_.doubtful_crest_ratio);
  }

  // How sure it is that the lower part is the side of the higher one, 0 to 1: it is highest where both meet,
  // and the higher one ends there without going down.
  double flank_of(const FoodBlock& a, const FoodBlock& b, double a_border_mm, double b_border_mm,
                  double share) const {
    const double a_mean_mm = FoodParts::mean_mm(a);
    const double b_mean_mm = FoodParts::mean_mm(b);
    const bool is_a_lower = a_mean_mm < b_mean_mm;
    const double lower =
        is_a_lower ? a_border_mm / std::max(1.0, a_mean_mm) : b_border_mm / std::max(1.0, b_mean_mm);
    const double higher = is_a_lower ? b_border_mm / std::max(1.0F, FoodParts::crest_mm(b))
                                     : a_border_mm / std::max(1.0F, FoodParts::crest_mm(a));
    return ramp(lower, params_.least_flank, params_.full_flank) *
           ramp(higher, params_.least_edge, params_.full_edge) *
           ramp(share, params_.least_flank_fraction, params_.full_flank_fraction);
  }

  // Half the chi-square distance of the shares.
  static double distance_between(const PartColours& a, const PartColours& b) {
    double a_total = 0.0;
    double b_total = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      a_total += a[i];
      b_total += b[i];
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double p = a[i] / a_total;
      const double q = b[i] / b_total;
      if (p + q > 0.0) sum += (p - q) * (p - q) / (p + q);
    }
    return 0.5 * sum;
  }

  const DishRaster& raster_;
  int side_;
  const PartLikenessParams& params_;
  PartJoiningWorkspace& workspace_;
  FoodParts& parts_;
};

}  // namespace

double join_like_parts(const DishRaster& raster, int side, const PartLikenessParams& params, int least_blocks,
                       PartJoiningWorkspace& workspace, FoodParts& parts) {
  return PartJoining(raster, side, params, workspace, parts).run(least_blocks);
}

}  // namespace traygauge
