// Did card and dishes stand still between the pictures, and do they agree about scale and height? Each dish
// whose size and height are described is a second ruler beside the card.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/status.hpp"
#include "core/dish/dish_consistency.hpp"
#include "core/pipeline/scene_geometry.hpp"
#include "core/pipeline/segmentation.hpp"
#include "core/quality/check.hpp"
#include "core/quality/warning.hpp"

namespace traygauge {

// Where both views show a dish, and who looked.
struct CheckedTray {
  ViewPair views;
  bool is_reversed = false;             // the pair's second view comes first
  const Segmentation* found = nullptr;  // null: outlines were given
};

// Once the cameras are known well. Adds the checks of each dish and raises warnings; a dish that fails one is
// not measured: its verdict in `geometry` is dish_moved, scale_disagrees, card_lifted, card_not_flat or
// dish_differs.
void check_dishes(const CheckedTray& tray, const SceneGeometryWorkspace& workspace,
                  const Configuration& configuration, SceneGeometry& geometry, CheckList& checks,
                  WarningSet& warnings);

// By its bare bands, each at its own height. The status for the whole dish: ok, card_lifted or dish_differs.
StatusCode check_glaze(std::span<const AgreedHeight> bands, std::uint8_t dish, const AgreedHeight& table,
                       const TrayCheckParams& params, CheckList& checks, WarningSet& warnings);

// Once all dishes were checked. Where one of them lies as described, the card does too, whatever it lies on.
void check_table(const AgreedHeight& table, const TrayCheckParams& params, CheckList& checks,
                 WarningSet& warnings);

}  // namespace traygauge
