// Where things and cameras of a scene are.
#pragma once

#include <Eigen/Geometry>

#include "simulator/render/view_camera.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

double radians(double angle_deg);

// Turned about z, then moved.
Eigen::Isometry3d placement(const Eigen::Vector3d& centre_mm, double rotation_deg);

Eigen::Isometry3d world_from_dish(const LaidDish& dish);

// From the card's print (origin top left, x along its width, y downwards, z into the card).
Eigen::Isometry3d world_from_card(const LaidCard& card);

// How far a bent card lies over a flat one, so far along its width.
double card_lift_mm(const LaidCard& card, double along_mm);

// The tray's frame is the world's: where the room (camera, table, lamps) is in it when a view is taken.
Eigen::Isometry3d world_from_room(const Photograph& view);

// In the middle of the exposure.
Eigen::Isometry3d camera_from_world(const Photograph& view);

// With the poses of the view in the world.
ViewCamera view_camera(const SceneDescription& scene, const Photograph& view);

// Between the directions from which two views see a point, in the middle of their exposures.
double relative_angle_deg(const ViewCamera& first, const ViewCamera& second, const Eigen::Vector3d& point_mm);

}  // namespace traygauge
