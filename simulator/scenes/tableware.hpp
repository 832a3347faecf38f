// Shapes of what stands around the dishes.
#pragma once

#include <array>
#include <cstdint>

#include "simulator/render/mesh.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// How far below the tray's floor the table is.
inline constexpr double kTrayFloorMm = 3.0;
inline constexpr double kNapkinMm = 1.2;  // of a folded one
// Colours of napkins, sRGB.
inline constexpr std::array<std::uint32_t, 4> kNapkinPapers = {0xD8D4CC, 0x6A8A4A, 0x9A3428, 0x3C5A8A};

// A tray with rounded corners and a raised lip; its floor at z = 0.
TriangleMesh tray_mesh(const Tray& tray);

// Lies along x about the origin, on z = 0.
TriangleMesh utensil_mesh(UtensilKind kind);

}  // namespace traygauge
