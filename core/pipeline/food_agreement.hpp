// Do the food's outlines of both views belong to the same scene?
#pragma once

#include <array>

#include "core/geometry/table_frame.hpp"
#include "core/pipeline/food_agreement_params.hpp"
#include "core/pipeline/tray_view.hpp"
#include "core/stereo/surface_grid.hpp"

namespace traygauge {

// 1 where no food was matched.
double measure_food_agreement(const std::array<SurfaceGrid, 2>& grids, const ViewPair& views,
                              const TableCameras& camera_from_table, const FoodAgreementParams& params);

}  // namespace traygauge
