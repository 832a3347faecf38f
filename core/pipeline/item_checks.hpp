// Did each item stay where it was on its dish between the pictures?
#pragma once

#include <array>
#include <cstdint>

#include "core/base/status.hpp"
#include "core/dish/dish_profile.hpp"
#include "core/pipeline/configuration.hpp"
#include "core/pipeline/scene_geometry.hpp"
#include "core/quality/check.hpp"
#include "core/quality/warning.hpp"
#include "core/stereo/surface_grid.hpp"

namespace traygauge {

struct CheckedItem {
  std::uint8_t label = 0;
  bool is_liquid = false;  // its edge is where its level meets the dish's wall
  double focal_px = 0.0;   // of the second view
};

// Adds the checks of one item and raises its warning; item_moved where it cannot be measured, else ok.
StatusCode check_item(const CheckedItem& item, const SceneGeometry& geometry,
                      const std::array<SurfaceGrid, 2>& grids, const InnerSurface& inner,
                      const TrayCheckParams& params, CheckList& checks, WarningSet& warnings);

// By the share of it that looks different in the two pictures.
void check_likeness(std::uint8_t item, double unlike_share, const TrayCheckParams& params, CheckList& checks,
                    WarningSet& warnings);

}  // namespace traygauge
