// Whether two views show one dish that stands still, is as large as described and stands on the table at the
// card's scale; and if not, which single fault explains it best.
#pragma once

#include <array>

#include "core/dish/dish_sighting.hpp"

namespace traygauge {

struct DishConsistencyParams {
  // What a dish of a known kind may differ by (see DishPoseParams): glaze, firing, feet, an uneven table.
  double size_sigma_mm = 0.5;
  double height_sigma_mm = 0.5;
  // Height of its edge on each side beside a level edge: warped, or on uneven feet. Chosen on one station and
  // on cards that lean (tests/evaluation/experiments.md, "A card that is bent or leans").
  double edge_sigma_mm = 0.3;
};

// What may be wrong with a dish beside the card, each by itself.
enum class DishFault : std::uint8_t { slip, scale, height };
inline constexpr std::size_t kDishFaults = 3;

struct DishConsistency {
  // Squared deviation of both sightings from one still dish as described; four degrees of freedom.
  double squared_deviation = 0.0;
  // What of it is left once one fault is allowed for: two degrees of freedom with a slip, else three.
  std::array<double, kDishFaults> left{};
  Vec2 slip_mm = Vec2::Zero();  // over the table, from the first view to the second
  double slip_sigma_mm = 0.0;   // along the slip
  double turn_rad = 0.0;        // 0 for a round dish
  double scale = 0.0;           // by which share the card makes everything too large
  double scale_sigma = 0.0;
  double height_mm = 0.0;  // of dish and table over where the card puts them
  double height_sigma_mm = 0.0;
  // Between the planes of the dish's edge and of the card. Of an oval dish hardly known: seen from above, a
  // turn about the vertical looks much like it.
  double lean_rad = 0.0;
  double lean_sigma_rad = 0.0;  // along the lean
  double lean_deviation = 0.0;  // squared, in its sigmas; two degrees of freedom

  double explained_by(DishFault fault) const {
    return squared_deviation - left[static_cast<std::size_t>(fault)];
  }
  // Those that leave less unexplained come first. A slip has one degree of freedom more than the others.
  std::array<DishFault, kDishFaults> best_first() const;
  DishFault best_fault() const { return best_first().front(); }
};

// `size_mm`: mean of the dish's axes. The cameras differ from those of the sightings by little; `covariance`
// is that of a step of both, the first camera first. Both sightings are known.
DishConsistency compare_sightings(const std::array<DishSighting, 2>& sightings, const TableCameras& cameras,
                                  const CamerasMatrix& covariance, double size_mm,
                                  const DishConsistencyParams& params);

}  // namespace traygauge
