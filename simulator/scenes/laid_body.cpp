#include "simulator/scenes/laid_body.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>

#include "simulator/bodies/body_surface.hpp"
#include "simulator/scenes/colour.hpp"
#include "simulator/scenes/mesh_tools.hpp"
#include "simulator/scenes/scene_poses.hpp"

namespace traygauge {
namespace {

constexpr double kBodyMlPerMm3 = 1e-3;
constexpr double kMaxGapMm = 0.01;  // between a corner and the bottom that it stands on

class PrintedPaper : public Material {
 public:
  PrintedPaper(const ProofBody& body, Eigen::Isometry3d body_from_world)
      : surface_(body), body_from_world_(std::move(body_from_world)) {
    for (std::uint32_t gray = 0; gray < linear_.size(); ++gray)
      linear_[gray] = linear_colour(gray << 16U | gray << 8U | gray);
  }

  Reflectance at(const Eigen::Vector3f& point_mm, const Eigen::Vector3f& normal) const override {
    Reflectance reflectance;
    const Eigen::Vector3d at = body_from_world_ * point_mm.cast<double>();
    const Eigen::Vector3d outward = body_from_world_.linear() * normal.cast<double>();
    reflectance.base = linear_[surface_.gray_at(at, outward)];
    reflectance.coat = 0.0F;
    reflectance.roughness = 0.9F;
    return reflectance;
  }

 private:
  BodySurface surface_;
  Eigen::Isometry3d body_from_world_;
  std::array<Eigen::Vector3f, 256> linear_;
};

}  // namespace

ServedFood serve_body(const LaidFood& food, const SceneDescription& scene, const DishShell& shell) {
  const ProofBody* const body = find_proof_body(food.body);
  if (body == nullptr) throw std::invalid_argument("no proof body is called " + food.body);
  const Eigen::Isometry3d dish_from_body =
      placement({food.centre_mm.x(), food.centre_mm.y(), shell.bottom_height_mm()}, food.rotation_deg);
  const Eigen::Isometry3d world_from_body =
      world_from_dish(scene.dishes[static_cast<std::size_t>(food.dish)]) * dish_from_body;
  ServedFood served;
  served.is_body = true;
  TriangleMesh& mesh = served.object.mesh;
  mesh = BodySurface(*body).mesh();
  served.volume_ml = body_volume_ml(body->kind, body->size_mm);
  served.check_volume_ml = kBodyMlPerMm3 * enclosed_volume_mm3(mesh);
  served.above_bottom_plane_ml = served.volume_ml;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    if (vertex.z() > 0.0F) continue;
    const Eigen::Vector3d at = dish_from_body * vertex.cast<double>();
    const double height_mm = shell.inner_height_mm(at.x(), at.y());
    if (std::abs(height_mm - shell.bottom_height_mm()) <= kMaxGapMm && shell.contains(at.x(), at.y(), 0.0))
      continue;
    throw std::invalid_argument(food.body + ": it has to stand on the flat bottom of its dish; move it");
  }
  served.max_height_mm = body->size_mm[2];
  const bool is_round = body->kind == BodyKind::cone;
  const double across_mm = is_round ? body->size_mm[0] : body->size_mm[1];
  constexpr double kQuarterPi = 0.78539816339744831;
  served.footprint_cm2 = 0.01 * body->size_mm[0] * across_mm * (is_round ? kQuarterPi : 1.0);
  served.centre_mm = world_from_body.translation().head<2>();
  transform(mesh, world_from_body);
  served.object.material = std::make_shared<PrintedPaper>(*body, world_from_body.inverse());
  return served;
}

}  // namespace traygauge
