#include "simulator/scenes/surface_material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "simulator/scenes/colour.hpp"
#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/noise.hpp"

namespace traygauge {
namespace {

constexpr std::array<std::string_view, 8> kNames = {"wood",  "laminate", "cloth",         "plastic",
                                                    "steel", "granite",  "checked_cloth", "cork"};

class Plain : public Material {
 public:
  explicit Plain(Reflectance reflectance) : reflectance_(std::move(reflectance)) {}
  Reflectance at(const Eigen::Vector3f&, const Eigen::Vector3f&) const override { return reflectance_; }

 private:
  Reflectance reflectance_;
};

// Patterns in the plane; the seed chooses among colours that such surfaces are sold in.
class PatternedSurface : public Material {
 public:
  PatternedSurface(SurfaceKind kind, std::uint64_t seed, const Eigen::Isometry3d& local_from_world)
      : local_from_world_(local_from_world.cast<float>()), kind_(kind) {
    Draws draws(seed, "surface");
    seed_ = draws.seed();
    for (std::size_t i = 0; i < scratch_ways_.size(); ++i) {
      const float angle = 6.28318F * hash_fraction(hash_cell(static_cast<int>(i), 3, 3, seed_));
      scratch_ways_[i] = {std::cos(angle), std::sin(angle)};
    }
    const auto choose = [&](std::span<const std::array<std::uint32_t, 3>> choices) {
      const auto& colours = draws.pick(choices);
      for (std::size_t i = 0; i < 3; ++i) colours_[i] = linear_colour(colours[i]);
    };
    constexpr std::array<std::array<std::uint32_t, 3>, 4> kWood = {{{0x8A5A34, 0x5C3820, 0x3A2314},
                                                                    {0xB98A58, 0x94663A, 0x6E4A28},
                                                                    {0x6A4026, 0x482A18, 0x2C190E},
                                                                    {0xC9A273, 0xA98052, 0x7E5C38}}};
    constexpr std::array<std::array<std::uint32_t, 3>, 4> kLaminate = {{{0xA8A29A, 0x5A544E, 0xD8D4CC},
                                                                        {0xC9C2B4, 0x8A7C68, 0x4E463C},
                                                                        {0x6E7074, 0x3A3C40, 0xB4B6BA},
                                                                        {0xB4BCC0, 0x6A7880, 0xE4E8EA}}};
    constexpr std::array<std::array<std::uint32_t, 3>, 3> kCloth = {
        {{0xCFC8B8, 0xB4AA96, 0x8C8270}, {0x8A9AA8, 0x6E7E8E, 0x586674}, {0xB0A080, 0x94845E, 0x786A4A}}};
    constexpr std::array<std::array<std::uint32_t, 3>, 4> kPlastic = {{{0x7A2A22, 0x6A221C, 0x8C3A30},
                                                                       {0x5A5E62, 0x4C5054, 0x6C7074},
                                                                       {0x8C6A48, 0x7A5A3A, 0x9E7C58},
                                                                       {0x2E5A4A, 0x264C3E, 0x3C6C5A}}};
    constexpr std::array<std::array<std::uint32_t, 3>, 1> kSteel = {{{0xC4C6C8, 0xAEB0B2, 0xD4D6D8}}};
    constexpr std::array<std::array<std::uint32_t, 3>, 2> kGranite = {
        {{0x8C8680, 0x3C3A38, 0xD0C8BC}, {0x50565A, 0x22262A, 0xA0A8AC}}};
    constexpr std::array<std::array<std::uint32_t, 3>, 2> kChecked = {
        {{0xE4DED0, 0xA83228, 0xC88078}, {0xE2E0DA, 0x32508C, 0x8494B4}}};
    constexpr std::array<std::array<std::uint32_t, 3>, 1> kCork = {{{0xB08858, 0x7E5A34, 0x5A3C20}}};
    switch (kind) {
      case SurfaceKind::wood:
        choose(kWood);
        break;
      case SurfaceKind::laminate:
        choose(kLaminate);
        break;
      case SurfaceKind::cloth:
        choose(kCloth);
        break;
      case SurfaceKind::plastic:
        choose(kPlastic);
        break;
      case SurfaceKind::steel:
        choose(kSteel);
        break;
      case SurfaceKind::granite:
        choose(kGranite);
        break;
      case SurfaceKind::checked_cloth:
        choose(kChecked);
        break;
      case SurfaceKind::cork:
        choose(kCork);
        break;
    }
  }

  Reflectance at(const Eigen::Vector3f& point_mm, const Eigen::Vector3f&) const override {
    const Eigen::Vector3f at = local_from_world_ * point_mm;
    switch (kind_) {
      case SurfaceKind::wood:
        return wood(at);
      case SurfaceKind::laminate:
        return laminate(at);
      case SurfaceKind::cloth:
        return cloth(at, 0.0F);
      case SurfaceKind::plastic:
        return plastic(at);
      case SurfaceKind::steel:
        return steel(at);
      case SurfaceKind::granite:
        return granite(at);
      case SurfaceKind::checked_cloth:
        return cloth(at, 24.0F);
      case SurfaceKind::cork:
        return cork(at);
    }
    return {};
  }

 private:
  static Reflectance coated(const Eigen::Vector3f& base, float coat, float roughness) {
    Reflectance reflectance;
    reflectance.base = base.cwiseMax(0.005F).cwiseMin(0.9F);
    reflectance.coat = coat;
    reflectance.roughness = roughness;
    return reflectance;
  }

  // Boards along x with growth rings and pores stretched along the grain.
  Reflectance wood(const Eigen::Vector3f& at) const {
    constexpr float kBoardMm = 92.0F;
    const float board = std::floor(at.y() / kBoardMm);
    const float across = at.y() - board * kBoardMm;
    const float shift = 400.0F * hash_fraction(hash_cell(static_cast<int>(board), 5, 9, seed_));
    const Eigen::Vector3f stretched(at.x() / 260.0F + shift, at.y() / 24.0F, 0.3F * board);
    const float rings = std::sin(6.0F * fractal_noise(stretched, seed_, 3));
    const float fibre = fractal_noise({at.x() / 22.0F + shift, at.y() / 1.1F, board}, seed_ + 3U, 3);
    Eigen::Vector3f base =
        blend(colours_[0], colours_[1], 0.15F + 0.6F * smooth_step(-1.4F, 1.4F, 0.8F * rings + 0.9F * fibre));
    const float pore = gradient_noise({at.x() / 9.0F + shift, at.y() / 0.7F, 0.5F}, seed_ + 7U);
    base = blend(base, colours_[2], 0.8F * smooth_step(0.35F, 0.6F, pore));
    base *= 0.88F + 0.24F * hash_fraction(hash_cell(static_cast<int>(board), 1, 1, seed_));
    if (across < 0.7F) base *= 0.35F;
    return coated(base, 0.03F, 0.35F);
  }

  Reflectance laminate(const Eigen::Vector3f& at) const {
    Eigen::Vector3f base = colours_[0] * (1.0F + 0.07F * fractal_noise(at / 30.0F, seed_, 3));
    for (std::uint32_t layer = 0; layer < 3; ++layer) {
      const float cell_mm = layer == 0 ? 4.5F : layer == 1 ? 2.4F : 1.3F;
      const NearestCell cell = nearest_cell({at.x() / cell_mm, at.y() / cell_mm, 0.5F}, seed_ + layer * 101U);
      const float edge = 0.10F + 0.28F * hash_fraction(cell.id * 0x27D4EB2FU);
      if (cell.distance < edge) base = hash_fraction(cell.id) < 0.6F ? colours_[1] : colours_[2];
    }
    return coated(base, 0.04F, 0.3F);
  }

  // Threads over and under; with `check_mm` above 0 in two colours.
  Reflectance cloth(const Eigen::Vector3f& at, float check_mm) const {
    constexpr float kThreadMm = 0.9F;
    const float u = at.x() / kThreadMm;
    const float v = at.y() / kThreadMm;
    const float iu = std::floor(u);
    const float iv = std::floor(v);
    const bool is_warp = (static_cast<int>(iu) + static_cast<int>(iv)) % 2 == 0;
    const float across = is_warp ? u - iu : v - iv;
    const float thread =
        hash_fraction(hash_cell(static_cast<int>(is_warp ? iu : iv), is_warp ? 1 : 2, 0, seed_));
    const float slub =
        fractal_noise({at.x() / (is_warp ? 1.5F : 18.0F), at.y() / (is_warp ? 18.0F : 1.5F), 0.0F}, seed_, 2);
    Eigen::Vector3f base =
        blend(colours_[0], colours_[1], std::clamp(0.6F * thread + 0.6F * slub, 0.0F, 1.0F));
    if (check_mm > 0.0F) {
      const int bands =
          static_cast<int>(std::floor(at.x() / check_mm) - 2.0F * std::floor(0.5F * at.x() / check_mm)) +
          static_cast<int>(std::floor(at.y() / check_mm) - 2.0F * std::floor(0.5F * at.y() / check_mm));
      base = colours_[bands == 0 ? 0U : bands == 1 ? 2U : 1U] * (0.85F + 0.2F * thread + 0.15F * slub);
    }
    base *= 0.55F + 0.45F * std::sin(3.14159F * across);
    base *= 1.0F + 0.10F * fractal_noise(at / 60.0F, seed_ + 5U, 2);
    return coated(base, 0.0F, 0.9F);
  }

  // Scratched and stained as trays of a canteen are.
  Reflectance plastic(const Eigen::Vector3f& at) const {
    Eigen::Vector3f base =
        blend(colours_[0], colours_[1], smooth_step(-0.7F, 0.7F, fractal_noise(at / 45.0F, seed_, 4)));
    base *= 1.0F + 0.10F * fractal_noise(at / 1.2F, seed_ + 2U, 2);
    for (std::size_t i = 0; i < scratch_ways_.size(); ++i) {
      const Eigen::Vector2f& way = scratch_ways_[i];
      const float along = at.x() * way.x() + at.y() * way.y();
      const float across = at.y() * way.x() - at.x() * way.y();
      const float scratch = gradient_noise({along / 38.0F, across / 1.0F, static_cast<float>(i)}, seed_ + 9U);
      base = blend(base, colours_[2] * 1.3F, 0.6F * smooth_step(0.5F, 0.62F, scratch));
    }
    return coated(base, 0.04F, 0.28F);
  }

  Reflectance steel(const Eigen::Vector3f& at) const {
    const float brush = fractal_noise({at.x() / 60.0F, at.y() / 0.8F, 0.0F}, seed_, 3);
    const float stain = fractal_noise(at / 35.0F, seed_ + 4U, 4);
    Reflectance reflectance;
    reflectance.is_metal = true;
    reflectance.base = (colours_[0] * (0.85F + 0.18F * brush + 0.10F * stain)).cwiseMax(0.1F).cwiseMin(0.95F);
    reflectance.roughness = 0.38F + 0.06F * stain;
    return reflectance;
  }

  Reflectance granite(const Eigen::Vector3f& at) const {
    const NearestCell large = nearest_cell({at.x() / 6.0F, at.y() / 6.0F, 0.5F}, seed_);
    const NearestCell small = nearest_cell({at.x() / 2.2F, at.y() / 2.2F, 0.5F}, seed_ + 40U);
    const float choice = 0.6F * hash_fraction(large.id) + 0.4F * hash_fraction(small.id);
    Eigen::Vector3f base = choice < 0.38F ? colours_[1] : choice < 0.68F ? colours_[0] : colours_[2];
    base *= 1.0F + 0.15F * fractal_noise(at / 1.5F, seed_ + 6U, 2);
    return coated(base, 0.04F, 0.15F);
  }

  Reflectance cork(const Eigen::Vector3f& at) const {
    const NearestCell cell = nearest_cell({at.x() / 3.2F, at.y() / 3.2F, 0.5F}, seed_);
    Eigen::Vector3f base = blend(colours_[0], colours_[1], hash_fraction(cell.id));
    base = blend(base, colours_[2], 0.8F * smooth_step(0.55F, 0.75F, cell.distance));
    base *= 1.0F + 0.12F * fractal_noise(at / 0.9F, seed_ + 8U, 2);
    return coated(base, 0.0F, 0.9F);
  }

  std::array<Eigen::Vector2f, 3> scratch_ways_;
  Eigen::Isometry3f local_from_world_;
  SurfaceKind kind_;
  std::uint32_t seed_ = 0;
  std::array<Eigen::Vector3f, 3> colours_;
};

class GlazeMaterial : public Material {
 public:
  GlazeMaterial(Glaze glaze, DishShell shell, std::uint64_t seed, const Eigen::Isometry3d& dish_from_world)
      : glaze_(std::move(glaze)),
        shell_(std::move(shell)),
        dish_from_world_(dish_from_world.cast<float>()),
        base_(linear_colour(glaze_.srgb)),
        decoration_(linear_colour(glaze_.decoration_srgb)) {
    seed_ = Draws(seed, "glaze").seed();
  }

  Reflectance at(const Eigen::Vector3f& point_mm, const Eigen::Vector3f&) const override {
    const Eigen::Vector3f at = dish_from_world_ * point_mm;
    Reflectance reflectance;
    reflectance.roughness = glaze_.roughness;
    reflectance.base = base_ * (1.0F + 0.02F * fractal_noise(at / 25.0F, seed_, 3));
    reflectance.is_metal = glaze_.finish == GlazeFinish::metal;
    if (glaze_.finish != GlazeFinish::glazed) return reflectance;
    if (glaze_.pattern != GlazePattern::none)
      reflectance.base = blend(reflectance.base, decoration_, decoration_share(at));
    if (glaze_.speck_fraction > 0.0) {
      const NearestCell cell = nearest_cell(at / 2.6F, seed_ + 11U);
      const float radius = 0.06F + 0.12F * hash_fraction(cell.id * 0x27D4EB2FU);
      if (cell.distance < radius && static_cast<double>(hash_fraction(cell.id)) < glaze_.speck_fraction)
        reflectance.base = decoration_;
    }
    if (!glaze_.lines.empty()) {
      const double inset_mm = shell_.inset_mm(static_cast<double>(at.x()), static_cast<double>(at.y()));
      const auto covers = [&](const RimLine& line) {
        return std::abs(inset_mm - line.inset_mm) < 0.5 * line.width_mm;
      };
      if (std::any_of(glaze_.lines.begin(), glaze_.lines.end(), covers)) reflectance.base = decoration_;
    }
    return reflectance;
  }

 private:
  float decoration_share(const Eigen::Vector3f& at) const {
    const float far_mm = at.head<2>().norm();
    switch (glaze_.pattern) {
      case GlazePattern::dots: {
        constexpr float kPitchMm = 11.0F;
        const auto off = [](float mm) { return mm - kPitchMm * std::round(mm / kPitchMm); };
        return std::hypot(off(at.x()), off(at.y())) < 2.4F ? 1.0F : 0.0F;
      }
      case GlazePattern::rays: {
        const float petal = std::cos(12.0F * std::atan2(at.y(), at.x()));
        return smooth_step(-0.1F, 0.1F, petal - 0.3F) * smooth_step(30.0F, 34.0F, far_mm);
      }
      case GlazePattern::clouds:
        return smooth_step(-0.35F, 0.45F, fractal_noise(at / 38.0F, seed_ + 5U, 4));
      case GlazePattern::none:
        break;
    }
    return 0.0F;
  }

  Glaze glaze_;
  DishShell shell_;
  Eigen::Isometry3f dish_from_world_;
  Eigen::Vector3f base_;
  Eigen::Vector3f decoration_;
  std::uint32_t seed_ = 0;
};

}  // namespace

std::span<const std::string_view> surface_kind_names() {
  return kNames;
}

std::shared_ptr<const Material> make_surface(SurfaceKind kind, std::uint64_t seed,
                                             const Eigen::Isometry3d& local_from_world) {
  return std::make_shared<PatternedSurface>(kind, seed, local_from_world);
}

std::shared_ptr<const Material> make_plain(std::uint32_t srgb, float coat, float roughness) {
  return std::make_shared<Plain>(Reflectance{linear_colour(srgb), coat, roughness, false});
}

std::shared_ptr<const Material> make_metal(std::uint32_t srgb, float roughness) {
  return std::make_shared<Plain>(Reflectance{linear_colour(srgb), 0.0F, roughness, true});
}

std::shared_ptr<const Material> make_glaze(const Glaze& glaze, const DishShell& shell, std::uint64_t seed,
                                           const Eigen::Isometry3d& dish_from_world) {
  return std::make_shared<GlazeMaterial>(glaze, shell, seed, dish_from_world);
}

}  // namespace traygauge
