#include "core/enrolment/profile_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace traygauge {
namespace {

using Points = std::array<DishProfilePoint, kMaxDishProfilePoints>;

class ProfileFit {
 public:
  ProfileFit(std::span<const InsetRing> rings, const DishModel& edge, const ProfileFitParams& params,
             ProfileFitWorkspace& workspace, FittedProfile& fitted)
      : rings_(rings),
        params_(params),
        levels_mm_(workspace.levels_mm.first(rings.size())),
        weights_(workspace.weights.first(rings.size())),
        blocks_(workspace.blocks.first(rings.size())),
        fitted_(fitted) {
    fitted_ = {.dish = edge};
    fitted_.dish.profile_size = 0;
  }

  bool is_enough_known() {
    const double ring_mm = rings_.size() > 1 ? rings_[1].inset_mm - rings_[0].inset_mm : 1.0;
    std::size_t known = 0;
    double last_mm = 0.0;  // the edge is known from its outline
    double squares = 0.0;
    for (const InsetRing& ring : rings_) {
      if (!ring.is_known) continue;
      ++known;
      fitted_.widest_gap_mm = std::max(fitted_.widest_gap_mm, ring.inset_mm - last_mm - ring_mm);
      last_mm = ring.inset_mm;
      squares += ring.spread_mm * ring.spread_mm;
    }
    if (known == 0) return false;
    const auto count = static_cast<double>(known);
    fitted_.known_fraction = count / static_cast<double>(rings_.size());
    fitted_.spread_mm = std::sqrt(squares / count);
    const bool is_bottom_known = last_mm >= bottom_begin_mm();
    return is_bottom_known && fitted_.known_fraction >= params_.min_known_fraction &&
           fitted_.widest_gap_mm <= params_.max_gap_mm;
  }

  // Smooths, then lets nothing rise inward of the crest.
  void level() {
    for (std::size_t i = 0; i < rings_.size(); ++i) levels_mm_[i] = smoothed(i);
    crest_ = find_crest();
    fall_inward();
  }

  // Where the wall has come down to the bottom, and the bottom's level.
  void find_bottom() {
    double begin_mm = bottom_begin_mm();
    for (int round = 0; round < kBottomRounds; ++round) {
      bottom_mm_ = mean_height(begin_mm);
      bottom_ring_ = std::min(crest_ + 1, rings_.size() - 1);
      while (bottom_ring_ + 1 < rings_.size() && !is_on_bottom(bottom_ring_)) ++bottom_ring_;
      begin_mm = rings_[bottom_ring_].inset_mm;
    }
  }

  // Points where the profile through the others is furthest off, until it is near enough.
  void choose_points() {
    const double edge_mm = fitted_.dish.rim_height_mm;
    count_ = 0;
    insert({0.0, edge_mm});
    if (levels_mm_[crest_] > edge_mm) insert({rings_[crest_].inset_mm, levels_mm_[crest_]});
    insert({rings_[bottom_ring_].inset_mm, bottom_mm_});
    store();
    while (count_ < std::min(params_.max_points, kMaxDishProfilePoints)) {
      const std::size_t worst = find_worst();
      if (worst == rings_.size()) break;
      insert({rings_[worst].inset_mm, levels_mm_[worst]});
      store();
    }
  }

  bool is_near_enough() {
    double squares = 0.0;
    double weight = 0.0;
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      if (!is_used(i)) continue;
      const double off_mm = rings_[i].height_mm - profile_.height_at_inset_mm(rings_[i].inset_mm);
      squares += weight_of(i) * off_mm * off_mm;
      weight += weight_of(i);
    }
    fitted_.residual_mm = weight > 0.0 ? std::sqrt(squares / weight) : 0.0;
    return fitted_.residual_mm <= params_.max_residual_mm;
  }

 private:
  static constexpr int kBottomRounds = 3;
  static constexpr double kSureSigmas = 2.0;

  double bottom_begin_mm() const { return (1.0 - params_.bottom_fraction) * rings_.back().inset_mm; }
  bool is_used(std::size_t i) const {
    return rings_[i].is_known && rings_[i].inset_mm > params_.edge_margin_mm;
  }
  double weight_of(std::size_t i) const {
    if (!is_used(i)) return 0.0;
    const double sigma_mm = std::hypot(rings_[i].sigma_mm, params_.least_sigma_mm);
    return 1.0 / (sigma_mm * sigma_mm);
  }

  // A straight line through the neighbours, at the ring itself.
  double smoothed(std::size_t i) const {
    double s = 0.0;
    double sx = 0.0;
    double sxx = 0.0;
    double sy = 0.0;
    double sxy = 0.0;
    for (std::size_t j = 0; j < rings_.size(); ++j) {
      const double x = rings_[j].inset_mm - rings_[i].inset_mm;
      if (std::abs(x) > params_.smoothing_mm || !is_used(j)) continue;
      const double near = 1.0 - x * x / (params_.smoothing_mm * params_.smoothing_mm);
      const double w = near * near * weight_of(j);
      s += w;
      sx += w * x;
      sxx += w * x * x;
      sy += w * rings_[j].height_mm;
      sxy += w * x * rings_[j].height_mm;
    }
    const double determinant = s * sxx - sx * sx;
    if (!(determinant > 1e-6 * s * s)) return s > 0.0 ? sy / s : rings_[i].height_mm;
    return (sxx * sy - sx * sxy) / determinant;
  }

  std::size_t find_crest() const {
    std::size_t crest = 0;
    bool any = false;
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      if (!is_used(i)) continue;
      if (any && rings_[i].inset_mm > params_.crest_reach_mm) break;
      if (!any || levels_mm_[i] > levels_mm_[crest]) crest = i;
      any = true;
    }
    return crest;
  }

  // Pools neighbours that rise (R. E. Barlow et al., Statistical Inference under Order Restrictions, 1972):
  // the nearest sequence that never does.
  void fall_inward() {
    std::size_t blocks = 0;
    for (std::size_t i = crest_; i < rings_.size(); ++i) {
      if (!is_used(i)) continue;
      double level_mm = levels_mm_[i];
      double weight = weight_of(i);
      while (blocks > 0 && levels_mm_[blocks_[blocks - 1]] < level_mm) {
        const std::size_t before = blocks_[--blocks];
        level_mm = (level_mm * weight + levels_mm_[before] * weights_[before]) / (weight + weights_[before]);
        weight += weights_[before];
      }
      // A block's level and weight are kept with its last ring, which no later block has.
      blocks_[blocks++] = static_cast<std::uint32_t>(i);
      levels_mm_[i] = level_mm;
      weights_[i] = weight;
    }
    std::size_t block = 0;
    for (std::size_t i = crest_; i < rings_.size() && block < blocks; ++i) {
      levels_mm_[i] = levels_mm_[blocks_[block]];
      if (i == blocks_[block]) ++block;
    }
  }

  bool is_on_bottom(std::size_t i) const {
    return is_used(i) &&
           levels_mm_[i] <= bottom_mm_ + std::max(params_.flat_mm, kSureSigmas * rings_[i].sigma_mm);
  }

  // Of all rings from there inward; of the last known one where there are none.
  double mean_height(double begin_mm) const {
    double sum = 0.0;
    double weight = 0.0;
    double last_mm = 0.0;
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      if (!is_used(i)) continue;
      last_mm = levels_mm_[i];
      if (rings_[i].inset_mm < begin_mm) continue;
      sum += weight_of(i) * rings_[i].height_mm;
      weight += weight_of(i);
    }
    return weight > 0.0 ? sum / weight : last_mm;
  }

  void insert(const DishProfilePoint& point) {
    std::size_t at = count_++;
    for (; at > 0 && points_[at - 1].inset_mm > point.inset_mm; --at) points_[at] = points_[at - 1];
    points_[at] = point;
  }

  void store() {
    DishModel& dish = fitted_.dish;
    std::copy_n(points_.begin(), count_, dish.profile_points.begin());
    dish.profile_size = count_;
    dish.bottom_height_mm = points_[count_ - 1].height_mm;
    dish.rim_height_mm = 0.0;
    for (std::size_t i = 0; i < count_; ++i)
      dish.rim_height_mm = std::max(dish.rim_height_mm, points_[i].height_mm);
    static_cast<void>(profile_.set(dish));
  }

  // The ring furthest off the profile; their number when none is off by more than the tolerance.
  std::size_t find_worst() const {
    std::size_t worst = rings_.size();
    double most_mm = params_.tolerance_mm;
    for (std::size_t i = crest_; i < bottom_ring_; ++i) {
      if (!is_used(i) || !is_apart(rings_[i].inset_mm)) continue;
      const double off_mm = std::abs(levels_mm_[i] - profile_.height_at_inset_mm(rings_[i].inset_mm));
      if (off_mm <= most_mm) continue;
      most_mm = off_mm;
      worst = i;
    }
    return worst;
  }
  bool is_apart(double inset_mm) const {
    return std::all_of(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(count_),
                       [&](const DishProfilePoint& point) {
                         return std::abs(point.inset_mm - inset_mm) >= params_.min_spacing_mm;
                       });
  }

  std::span<const InsetRing> rings_;
  const ProfileFitParams& params_;
  std::span<double> levels_mm_;
  std::span<double> weights_;
  std::span<std::uint32_t> blocks_;
  FittedProfile& fitted_;
  DishProfile profile_;
  Points points_{};
  std::size_t count_ = 0;
  std::size_t crest_ = 0;
  std::size_t bottom_ring_ = 0;
  double bottom_mm_ = 0.0;
};

}  // namespace

Status fit_dish_profile(std::span<const InsetRing> rings, const DishModel& edge,
                        const ProfileFitParams& params, ProfileFitWorkspace& workspace,
                        FittedProfile& fitted) {
  fitted = {.dish = edge};
  if (rings.size() < 2 || rings.size() > workspace.levels_mm.size()) return StatusCode::too_little_depth;
  ProfileFit fit(rings, edge, params, workspace, fitted);
  if (!fit.is_enough_known()) return StatusCode::too_little_depth;
  fit.level();
  fit.find_bottom();
  fit.choose_points();
  return fit.is_near_enough() ? StatusCode::ok : StatusCode::too_little_depth;
}

}  // namespace traygauge
