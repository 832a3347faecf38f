// One dish as both views show it: what dense matching over it takes.
#pragma once

#include <array>

#include "core/dish/dish_profile.hpp"
#include "core/dish/rim_residual.hpp"
#include "core/image/specular_suppression.hpp"
#include "core/pipeline/scene_geometry.hpp"
#include "core/pipeline/tray_view.hpp"
#include "core/stereo/plane_rectification.hpp"

namespace traygauge {

// The picture's edge cuts off something that has one of `labels`.
bool is_cut_off(const TrayView& view, const LabelSet& labels);

// Makes both views matte, for all dishes.
void suppress_speculars(const ViewPair& views, const SpecularParams& params);
std::array<StoredView, 2> diffuse_views(const ViewPair& views, const TableCameras& camera_from_table,
                                        const LabelSet& labels);

DishFrame frame_of(const DishPose& place);

// The point over the middle of the dish at this height, in the table frame.
Vec3 middle_of(const DishPose& place, double height_mm);

// Height by which a point rises for each sample of disparity, `step_mm` wide at its own height.
double height_per_sample_mm(const TableCameras& camera_from_table, const Vec3& point_mm, double step_mm);

}  // namespace traygauge
