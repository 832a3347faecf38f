// Bodies of exactly known volume, which anyone folds from paper.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace traygauge {

enum class BodyKind : std::uint8_t {
  cuboid,
  pyramid,  // above a rectangle, its apex over the middle
  ridge,    // a roof: a triangular prism that lies on one of its rectangles
  cone,     // a truncated one, its larger circle below
};

// Length, width and height; of a cone the diameters below and above, and the height. Along the outer surface.
using BodySize = std::array<double, 3>;

struct ProofBody {
  std::string_view id;  // printed on its sheet
  BodyKind kind = BodyKind::cuboid;
  BodySize size_mm{};
};

// Those that `traygauge verify bodies` prints, 50 to 400 ml. A body's id and size never change, because a
// folded one outlives the program.
std::span<const ProofBody> proof_bodies();

// Nullptr: no such body.
const ProofBody* find_proof_body(std::string_view id);

std::string_view name(BodyKind kind);
// What the three lengths are called.
std::array<std::string_view, 3> size_names(BodyKind kind);

// By the closed form.
double body_volume_ml(BodyKind kind, const BodySize& size_mm);
// Its standard deviation where each length has this one, independent of the others.
double body_volume_sigma_ml(BodyKind kind, const BodySize& size_mm, double length_sigma_mm);

}  // namespace traygauge
