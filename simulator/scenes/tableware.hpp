// Shapes of what stands around the dishes.
#pragma once

#include "simulator/render/mesh.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// How far below the tray's floor the table is.
inline constexpr double kTrayFloorMm = 3.0;
inline constexpr double kNapkinMm = 1.2;  // of a folded one

// A tray with rounded corners and a raised lip; its floor at z = 0.
TriangleMesh tray_mesh(const Tray& tray);

// Lies along x about the origin, on z = 0.
TriangleMesh utensil_mesh(UtensilKind kind);

}  // namespace traygauge
