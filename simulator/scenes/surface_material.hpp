// What tables, trays, dishes and cutlery are made of.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "simulator/render/material.hpp"
#include "simulator/scenes/dish_shell.hpp"

namespace traygauge {

enum class SurfaceKind : std::uint8_t { wood, laminate, cloth, plastic, steel, granite, checked_cloth, cork };

// In the order of SurfaceKind.
std::span<const std::string_view> surface_kind_names();

// A flat surface with the pattern in the coordinates that `local_from_world` leads to; the seed chooses
// colours, too.
std::shared_ptr<const Material> make_surface(SurfaceKind kind, std::uint64_t seed,
                                             const Eigen::Isometry3d& local_from_world);

// One colour all over, sRGB.
std::shared_ptr<const Material> make_plain(std::uint32_t srgb, float coat, float roughness);
std::shared_ptr<const Material> make_metal(std::uint32_t srgb, float roughness);

// A painted line around a dish's inner side.
struct RimLine {
  double inset_mm = 0.0;
  double width_mm = 0.0;
};

enum class GlazePattern : std::uint8_t {
  none,
  dots,
  rays,    // petals about the middle
  clouds,  // glazes that ran into each other
};

enum class GlazeFinish : std::uint8_t { glazed, metal, clear };

struct Glaze {
  std::uint32_t srgb = 0xE6E4DC;
  float roughness = 0.12F;
  std::uint32_t decoration_srgb = 0x2A3C78;
  std::vector<RimLine> lines;
  double speck_fraction = 0.0;  // of cells of stoneware that carry a speck
  GlazePattern pattern = GlazePattern::none;
  GlazeFinish finish = GlazeFinish::glazed;
};

std::shared_ptr<const Material> make_glaze(const Glaze& glaze, const DishShell& shell, std::uint64_t seed,
                                           const Eigen::Isometry3d& dish_from_world);

}  // namespace traygauge
