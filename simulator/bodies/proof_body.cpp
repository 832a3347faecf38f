#include "simulator/bodies/proof_body.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace traygauge {
namespace {

constexpr double kMlPerMm3 = 1e-3;

// Every shell fits a page of A4 and of Letter in one piece. Faces lean by 42 to 58 degrees, or stand upright.
constexpr auto kBodies = std::to_array<ProofBody>({
    {"C50", BodyKind::cuboid, {50.0, 40.0, 25.0}},
    {"C400", BodyKind::cuboid, {100.0, 80.0, 50.0}},
    {"P108", BodyKind::pyramid, {90.0, 90.0, 40.0}},
    {"R180", BodyKind::ridge, {100.0, 80.0, 45.0}},
    {"T169", BodyKind::cone, {96.0, 40.0, 44.0}},
});

constexpr std::array<std::string_view, 4> kNames = {"cuboid", "pyramid", "ridge", "truncated cone"};

// Of the product of the three lengths; the cone's volume is another function of them.
double share_of_box(BodyKind kind) {
  if (kind == BodyKind::pyramid) return 1.0 / 3.0;
  return kind == BodyKind::ridge ? 0.5 : 1.0;
}

}  // namespace

std::span<const ProofBody> proof_bodies() {
  return kBodies;
}

const ProofBody* find_proof_body(std::string_view id) {
  const auto* const body = std::ranges::find(kBodies, id, &ProofBody::id);
  return body == kBodies.end() ? nullptr : body;
}

std::string_view name(BodyKind kind) {
  return kNames.at(static_cast<std::size_t>(kind));
}

std::array<std::string_view, 3> size_names(BodyKind kind) {
  if (kind == BodyKind::cone) return {"diameter below", "diameter above", "height"};
  return {"length", "width", "height"};
}

double body_volume_ml(BodyKind kind, const BodySize& size_mm) {
  const auto& [a, b, height] = size_mm;
  if (kind == BodyKind::cone) return kMlPerMm3 * std::numbers::pi / 12.0 * height * (a * a + a * b + b * b);
  return kMlPerMm3 * share_of_box(kind) * a * b * height;
}

double body_volume_sigma_ml(BodyKind kind, const BodySize& size_mm, double length_sigma_mm) {
  const auto& [a, b, height] = size_mm;
  const double volume_ml = body_volume_ml(kind, size_mm);
  double by_a = volume_ml / a;
  double by_b = volume_ml / b;
  if (kind == BodyKind::cone) {
    by_a = kMlPerMm3 * std::numbers::pi / 12.0 * height * (2.0 * a + b);
    by_b = kMlPerMm3 * std::numbers::pi / 12.0 * height * (a + 2.0 * b);
  }
  return length_sigma_mm * std::hypot(by_a, by_b, volume_ml / height);
}

}  // namespace traygauge
