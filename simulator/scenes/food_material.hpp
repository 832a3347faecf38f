// How a food looks: its kind's textures, varied by a seed.
#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "simulator/render/material.hpp"
#include "simulator/scenes/food_kinds.hpp"
#include "simulator/scenes/height_field.hpp"

namespace traygauge {

// `food_from_world`: to the coordinates that the food was painted in. `field`: whose parts are where, in the
// coordinates of `dish_from_world`; null: the food has texture 0 all over.
std::shared_ptr<const Material> make_food_material(const FoodKind& kind, std::uint64_t seed,
                                                   const Eigen::Isometry3d& food_from_world,
                                                   std::shared_ptr<const HeightField> field,
                                                   const Eigen::Isometry3d& dish_from_world);

}  // namespace traygauge
