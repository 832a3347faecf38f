// Foods of the training set alone: smooth and pale ones, and what lies on side plates.
#pragma once

#include <span>

#include "simulator/scenes/food_kinds.hpp"

namespace traygauge {

std::span<const FoodKind> pale_food_kinds();

}  // namespace traygauge
