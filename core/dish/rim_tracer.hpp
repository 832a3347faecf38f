// The rim of a dish looked for along its whole length, in one view or in both.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/dish/dish_search.hpp"
#include "core/dish/rim_reader.hpp"

namespace traygauge {

// What a trace along a rim met, of the part that lies within the picture.
struct RimTrace {
  int seen = 0;
  int supported = 0;         // of those, with an edge
  double squares_mm2 = 0.0;  // of their distances from the place
};

// Of several edges across the rim: the strongest, or the one nearest to where the rim is expected. Bands of a
// decoration are often stronger than the rim itself.
enum class RimChoice : std::uint8_t { strongest, nearest };

// `inside_sign`: 1 where the dish is brighter than the table, -1 where it is darker.
class RimTracer {
 public:
  // Takes the workspace's angles, steps and shifts.
  RimTracer(const DishSearchViews& views, const DishSearchParams& params, DishSearchWorkspace& workspace);

  // Moves the place to where most of the rim lies on an edge, in these views together.
  void shift_to_edges(std::span<const std::size_t> views, int inside_sign, DishPose& place);

  // Median magnitude of the steps off the rim in both views: grain of the table, shading of the dish.
  double noise_beside(const DishPose& place, int inside_sign);

  // Collects the rays on which the edge lies in one view.
  RimTrace trace(std::size_t view, const DishPose& place, int inside_sign, double min_step, RimChoice choice,
                 BoundedList<Vec2>& rays);

 private:
  const Vec2& angle_at(int i) const { return workspace_.angles[static_cast<std::size_t>(i)]; }
  std::span<float> steps_of(std::size_t view, int angle, int offsets) const;
  void add_steps(std::size_t view, const DishPose& place, int inside_sign);
  void prepare_shifts(const DishPose& place);
  float sum_steps(const Vec2& shift_mm, double turn_rad, int offsets) const;

  const DishSearchViews& views_;
  const DishSearchParams& params_;
  DishSearchWorkspace& workspace_;
};

}  // namespace traygauge
