// The foods that scenes are laid with: what each looks like and how large a portion is.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "simulator/scenes/food_shapes.hpp"

namespace traygauge {

// Colours are sRGB, 0xRRGGBB.
struct FoodTexture {
  std::uint32_t base = 0x808080;
  std::uint32_t variant = 0x808080;  // in patches, or in layers
  float patch_mm = 8.0F;
  float layer_mm = 0.0F;  // above 0: base and variant alternate with the height, this thick
  float grain = 0.05F;    // spread of brightness over fractions of a mm
  float tone = 0.0F;      // spread of brightness between pieces
  std::uint32_t speck = 0;
  float speck_mm = 0.0F;  // radius; 0: none
  float speck_fraction = 0.0F;
  float coat = 0.02F;  // as Reflectance
  float roughness = 0.6F;
};

// Who serves a food: the sets are laid from different groups.
enum class FoodGroup : std::uint8_t {
  canteen,
  fast_food,
  other,     // in meals-14 alone
  training,  // in training-24 alone
};

enum class FoodServing : std::uint8_t { solid, soup, dessert };

struct FoodKind {
  std::string_view name;
  FoodShape shape = nullptr;
  FoodSize size;  // of a usual portion
  FoodGroup group = FoodGroup::canteen;
  FoodServing serving = FoodServing::solid;
  std::array<FoodTexture, 4> textures{};

  // A liquid with a level.
  bool is_filled() const { return serving != FoodServing::solid; }
};

std::span<const FoodKind> food_kinds();

// Nullptr: no such kind.
const FoodKind* find_food_kind(std::string_view name);

}  // namespace traygauge
