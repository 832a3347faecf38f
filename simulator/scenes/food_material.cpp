#include "simulator/scenes/food_material.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulator/scenes/colour.hpp"
#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/noise.hpp"

namespace traygauge {
namespace {

constexpr float kGrainMm = 0.8F;
constexpr float kSpeckCells = 3.5F;  // size of a cell that holds one speck, in radii
constexpr double kTint = 0.05;       // spread of a colour's channels between portions

class FoodMaterial : public Material {
 public:
  FoodMaterial(const FoodKind& kind, std::uint64_t seed, const Eigen::Isometry3d& food_from_world,
               std::shared_ptr<const HeightField> field, const Eigen::Isometry3d& dish_from_world)
      : field_(std::move(field)),
        food_from_world_(food_from_world.cast<float>()),
        dish_from_world_(dish_from_world.cast<float>()) {
    Draws draws(seed, "look");
    seed_ = draws.seed();
    const double brightness = draws.between(1.0 - kTint, 1.0 + kTint);
    Eigen::Vector3f tint;
    for (float& channel : tint)
      channel = static_cast<float>(brightness * draws.between(1.0 - kTint, 1.0 + kTint));
    for (std::size_t i = 0; i < textures_.size(); ++i) {
      const FoodTexture& texture = kind.textures[i];
      const auto colour = [&](std::uint32_t srgb) {
        return Eigen::Vector3f(linear_colour(srgb).cwiseProduct(tint));
      };
      textures_[i] = {texture, colour(texture.base), colour(texture.variant), colour(texture.speck)};
    }
  }

  Reflectance at(const Eigen::Vector3f& point_mm, const Eigen::Vector3f&) const override {
    const std::uint16_t part = part_at(dish_from_world_ * point_mm);
    const Eigen::Vector3f at = food_from_world_ * point_mm;
    const Coloured& look = textures_[part & 3U];
    const FoodTexture& texture = look.texture;
    const float patch = fractal_noise(at / texture.patch_mm, seed_, 3);
    float share = smooth_step(-0.6F, 0.6F, patch);
    if (texture.layer_mm > 0.0F) share = layer(at.z() / texture.layer_mm + 0.25F * patch);
    Eigen::Vector3f base = blend(look.base, look.variant, share);
    if (texture.speck_mm > 0.0F) {
      const NearestCell cell = nearest_cell(at / (kSpeckCells * texture.speck_mm), seed_ + 17U);
      if (hash_fraction(cell.id * 0xC2B2AE35U) < texture.speck_fraction && cell.distance < 1.0F / kSpeckCells)
        base = look.speck;
    }
    const float grain = texture.grain * fractal_noise(at / kGrainMm, seed_ + 31U, 2);
    const float tone = texture.tone * (2.0F * hash_fraction(hash_cell(part, 7, 3, seed_)) - 1.0F);
    Reflectance reflectance;
    reflectance.base = ((1.0F + grain) * (1.0F + tone) * base).cwiseMax(0.005F).cwiseMin(0.92F);
    reflectance.coat = texture.coat;
    reflectance.roughness = texture.roughness;
    return reflectance;
  }

 private:
  struct Coloured {
    FoodTexture texture;
    Eigen::Vector3f base = Eigen::Vector3f::Zero();
    Eigen::Vector3f variant = Eigen::Vector3f::Zero();
    Eigen::Vector3f speck = Eigen::Vector3f::Zero();
  };

  // Alternates between 0 and 1 with soft changes.
  static float layer(float height) {
    const float phase = height - 2.0F * std::floor(0.5F * height);
    return smooth_step(0.9F, 1.1F, phase) * (1.0F - smooth_step(1.9F, 2.0F, phase));
  }

  std::uint16_t part_at(const Eigen::Vector3f& on_dish_mm) const {
    if (field_ == nullptr) return 0;
    const GridFrame& frame = field_->frame;
    const auto nearest = [&](float at, double origin, int count) {
      const auto node = static_cast<int>(std::lround((static_cast<double>(at) - origin) / frame.step_mm));
      return std::clamp(node, 0, count - 1);
    };
    const int column = nearest(on_dish_mm.x(), frame.x0_mm, frame.columns);
    return field_->part[frame.index(column, nearest(on_dish_mm.y(), frame.y0_mm, frame.rows))];
  }

  std::shared_ptr<const HeightField> field_;
  Eigen::Isometry3f food_from_world_;
  Eigen::Isometry3f dish_from_world_;
  std::uint32_t seed_ = 0;
  std::array<Coloured, 4> textures_;
};

}  // namespace

std::shared_ptr<const Material> make_food_material(const FoodKind& kind, std::uint64_t seed,
                                                   const Eigen::Isometry3d& food_from_world,
                                                   std::shared_ptr<const HeightField> field,
                                                   const Eigen::Isometry3d& dish_from_world) {
  return std::make_shared<FoodMaterial>(kind, seed, food_from_world, std::move(field), dish_from_world);
}

}  // namespace traygauge
