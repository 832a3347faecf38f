// What stands and lies about on tables and is no food: cups, hands, phones and the like; and a roll on a
// napkin, which is food in no dish.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/render/scene.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// Half of what it covers along its own x and y. Of a hand: without the arm, which lies along -x.
Eigen::Vector2d half_size_mm(ThingKind kind);

// The parts of a thing, in the world, without labels.
std::vector<SceneObject> objects_of(const Thing& thing);

}  // namespace traygauge
