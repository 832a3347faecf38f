// Where bare table and bare glaze lie by the pictures themselves, against where card and description put
// them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/dish/dish_profile.hpp"
#include "core/pipeline/bare_check_params.hpp"
#include "core/pipeline/scene_geometry.hpp"
#include "core/stereo/surface_agreement.hpp"
#include "core/stereo/surface_grid.hpp"

namespace traygauge {

// Height of the table around the card over where the card puts it: less than zero under a card that lies on
// something.
AgreedHeight find_table(const ViewPair& views, const TableCameras& cameras, const CardModelSize& card,
                        const BareCheckParams& params);

// Bands of a dish, each at its own height: edge, wall and bottom.
inline constexpr std::size_t kGlazeBands = 3;

// Height of a dish's bare bands over where its description puts them; `grid` is the first view's, its bare
// points on `inner`.
std::array<AgreedHeight, kGlazeBands> find_glaze(const ViewPair& views, const TableCameras& cameras,
                                                 const SurfaceGrid& grid, const InnerSurface& inner,
                                                 std::uint8_t dish, const BareCheckParams& params);

}  // namespace traygauge
