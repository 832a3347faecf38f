#include "simulator/scenes/things.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "simulator/scenes/colour.hpp"
#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/mesh_tools.hpp"
#include "simulator/scenes/scene_poses.hpp"
#include "simulator/scenes/solid_meshes.hpp"
#include "simulator/scenes/surface_material.hpp"
#include "simulator/scenes/tableware.hpp"

namespace traygauge {
namespace {

constexpr double kThingClearanceMm = 0.02;  // what lies on something does not share its surface

// Gathers the parts of one thing, which are built about the origin on z = 0.
class Parts {
 public:
  explicit Parts(TruthKind kind) : kind_(kind) {}

  void add(TriangleMesh mesh, std::shared_ptr<const Material> material) {
    SceneObject object;
    object.mesh = std::move(mesh);
    object.material = std::move(material);
    object.kind = kind_;
    objects_.push_back(std::move(object));
  }

  void add_block(const Eigen::Vector3d& middle_mm, const Eigen::Vector3d& semi_mm, double exponent,
                 std::shared_ptr<const Material> material) {
    TriangleMesh mesh = superquadric_mesh(semi_mm, exponent, exponent);
    transform(mesh, Eigen::Isometry3d(Eigen::Translation3d(middle_mm)));
    add(std::move(mesh), std::move(material));
  }

  std::vector<SceneObject> take() { return std::move(objects_); }

 private:
  TruthKind kind_;
  std::vector<SceneObject> objects_;
};

// A mug or a paper cup with a drink, some with a handle.
std::vector<SceneObject> cup(const Thing& thing, Draws& draws) {
  Parts parts(TruthKind::cup);
  const bool has_handle = draws.chance(0.6);
  const double rim_mm = draws.between(36.0, 42.0);
  const double foot_mm = rim_mm * draws.between(0.65, 0.95);
  const double height_mm = draws.between(75.0, 105.0);
  const double wall_mm = has_handle ? 3.5 : 0.8;
  const double level_mm = height_mm * draws.between(0.35, 0.9);
  const auto radius_at = [&](double z) { return foot_mm + (rim_mm - foot_mm) * z / height_mm; };
  const std::vector<std::pair<double, double>> section = {
      {0.5, 4.0},
      {foot_mm - wall_mm - 1.0, 4.0},
      {radius_at(6.0) - wall_mm, 6.0},
      {radius_at(0.5 * height_mm) - wall_mm, 0.5 * height_mm},
      {rim_mm - wall_mm, height_mm - 0.4},
      {rim_mm - 0.5 * wall_mm, height_mm},
      {rim_mm, height_mm - 0.4},
      {radius_at(0.5 * height_mm), 0.5 * height_mm},
      {foot_mm, 1.0},
      {foot_mm - 1.0, 0.0},
      {0.5, 0.0}};
  const auto wall = make_plain(thing.srgb, has_handle ? 0.04F : 0.0F, has_handle ? 0.12F : 0.7F);
  parts.add(turned_mesh(section), wall);
  const double drink_mm = radius_at(level_mm) - wall_mm + 0.3;
  const std::vector<std::pair<double, double>> drink = {
      {0.5, level_mm}, {drink_mm, level_mm}, {drink_mm, level_mm - 1.0}, {0.5, level_mm - 1.0}};
  parts.add(turned_mesh(drink), make_plain(thing.second_srgb, 0.03F, 0.06F));
  if (has_handle) {
    constexpr int kPieces = 10;
    const auto at = [&](int i) {
      const double angle = std::numbers::pi * (static_cast<double>(i) / kPieces - 0.5);
      const double z = 0.52 * height_mm + 0.3 * height_mm * std::sin(angle);
      return Eigen::Vector3d(radius_at(z) - 1.0 + 24.0 * std::cos(angle), 0.0, z);
    };
    for (int i = 0; i < kPieces; ++i) parts.add(limb_mesh(at(i), at(i + 1), 4.0, 4.0), wall);
  }
  return parts.take();
}

// Palm down, the arm towards -x, rising so that it clears a tray's lip.
std::vector<SceneObject> hand(const Thing& thing, Draws& draws) {
  Parts parts(TruthKind::hand);
  const auto skin = make_plain(thing.srgb, 0.02F, 0.5F);
  const double size = draws.between(0.85, 1.1);
  const double side = draws.chance(0.5) ? 1.0 : -1.0;  // of the thumb
  const double curl = draws.between(0.0, 0.5);
  const auto limb = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, double a, double b,
                        const std::shared_ptr<const Material>& material) {
    parts.add(limb_mesh(size * from, size * to, size * a, size * b), material);
  };
  parts.add_block(size * Eigen::Vector3d(-12.0, 0.0, 19.0), size * Eigen::Vector3d(47.0, 40.0, 15.0), 2.6,
                  skin);
  for (int finger = 0; finger < 4; ++finger) {
    const double across = 19.0 * (finger - 1.5) * side;
    const double spread = draws.between(0.8, 1.3);
    const double length = (finger == 3 ? 58.0 : finger == 0 ? 68.0 : 76.0) * (1.0 - 0.35 * curl);
    const Eigen::Vector3d knuckle(27.0, across, 20.0);
    const Eigen::Vector3d joint(27.0 + 0.55 * length, spread * across, 20.0 + 8.0 * curl);
    const Eigen::Vector3d tip(27.0 + length, spread * across, 8.5);
    limb(knuckle, joint, 10.0, 9.0, skin);
    limb(joint, tip, 9.0, 7.5, skin);
  }
  const Eigen::Vector3d base(-30.0, -32.0 * side, 18.0);
  const Eigen::Vector3d bend(2.0, -58.0 * side, 16.0);
  limb(base, bend, 13.0, 10.5, skin);
  limb(bend, {32.0, -66.0 * side, 11.0}, 10.5, 8.5, skin);
  const Eigen::Vector3d wrist(-50.0, 0.0, 26.0);
  const Eigen::Vector3d elbow(-330.0, 60.0 * draws.between(-1.0, 1.0), 75.0);
  limb(elbow, wrist, 42.0, 25.0, skin);
  if (draws.chance(0.6)) {
    const Eigen::Vector3d cuff = wrist + draws.between(0.25, 0.7) * (elbow - wrist);
    limb(elbow, cuff, 50.0, 34.0, make_plain(thing.second_srgb, 0.0F, 0.9F));
  }
  return parts.take();
}

std::vector<SceneObject> phone(const Thing& thing, Draws& draws) {
  Parts parts(TruthKind::other);
  const double half_mm = draws.between(68.0, 80.0);
  parts.add_block({0.0, 0.0, 4.2}, {half_mm, 0.49 * half_mm, 4.2}, 9.0, make_plain(thing.srgb, 0.04F, 0.1F));
  if (draws.chance(0.7)) {
    const double x = half_mm - 3.0;
    const double y = 0.49 * half_mm - 3.0;
    parts.add(box_mesh({-x, -y, 8.35}, {2.0 * x, 2.0 * y, 0.15}),
              make_plain(thing.second_srgb, 0.04F, 0.04F));
  } else {  // face down: the lenses
    for (const double x : {-0.8, -0.62})
      parts.add_block({x * half_mm, 0.28 * half_mm, 8.4}, {7.0, 7.0, 1.4}, 2.5,
                      make_plain(0x101012, 0.04F, 0.05F));
  }
  return parts.take();
}

std::vector<SceneObject> wallet(const Thing& thing, Draws& draws) {
  Parts parts(TruthKind::other);
  const double thick_mm = draws.between(6.0, 10.0);
  const auto leather = make_plain(thing.srgb, 0.03F, 0.45F);
  parts.add_block({0.0, 0.0, 0.55 * thick_mm}, {56.0, 46.0, 0.55 * thick_mm}, 6.0, leather);
  parts.add_block({0.0, -2.0, 1.55 * thick_mm}, {55.0, 43.0, 0.5 * thick_mm}, 6.0, leather);
  return parts.take();
}

std::vector<SceneObject> keys(const Thing& thing, Draws& draws) {
  Parts parts(TruthKind::other);
  const auto metal = make_metal(0xC8C4B8, 0.25F);
  constexpr int kPieces = 14;
  const auto at = [](int i) {
    const double angle = 2.0 * std::numbers::pi * i / kPieces;
    return Eigen::Vector3d(14.0 * std::cos(angle), 14.0 * std::sin(angle), 2.0);
  };
  for (int i = 0; i < kPieces; ++i) parts.add(limb_mesh(at(i), at(i + 1), 1.2, 1.2), metal);
  const int count = draws.whole(2, 4);
  for (int i = 0; i < count; ++i) {
    const double angle_deg = 42.0 * (i - 0.5 * count) + draws.between(-12.0, 12.0);
    const double z = 1.6 + 2.2 * i;
    TriangleMesh key = superquadric_mesh({12.0, 11.0, 1.2}, 3.0, 6.0);
    transform(key, Eigen::Isometry3d(Eigen::Translation3d(24.0, 0.0, z)));
    TriangleMesh blade = superquadric_mesh({17.0, 3.8, 1.1}, 6.0, 6.0);
    transform(blade, Eigen::Isometry3d(Eigen::Translation3d(50.0, 0.0, z)));
    append(key, blade);
    transform(key, placement(Eigen::Vector3d::Zero(), angle_deg));
    parts.add(std::move(key), i % 3 == 2 ? make_plain(thing.srgb, 0.04F, 0.3F) : metal);
  }
  return parts.take();
}

// Of butter, sugar, sauce, crisps: a printed box, pillow or tub.
std::vector<SceneObject> packet(const Thing& thing, Draws& draws) {
  Parts parts(TruthKind::other);
  const double x = draws.between(18.0, 42.0);
  const double y = x * draws.between(0.5, 0.95);
  const double z = draws.between(2.5, 11.0);
  const auto foil = draws.chance(0.3) ? make_metal(thing.srgb, 0.3F) : make_plain(thing.srgb, 0.04F, 0.3F);
  const double exponent = draws.chance(0.5) ? 8.0 : 3.0;
  parts.add_block({0.0, 0.0, z}, {x, y, z}, exponent, foil);
  const double stripe = draws.between(0.25, 0.6);
  parts.add_block({draws.between(-0.2, 0.2) * x, 0.0, 2.0 * z - 0.3}, {stripe * x, 0.62 * y, 0.5}, exponent,
                  make_plain(thing.second_srgb, 0.04F, 0.3F));
  return parts.take();
}

// A roll by the colour of its crust, darker on top.
class Crust : public Material {
 public:
  Crust(std::uint32_t srgb, const Eigen::Isometry3d& local_from_world)
      : base_(linear_colour(srgb)), local_from_world_(local_from_world.cast<float>()) {}
  Reflectance at(const Eigen::Vector3f& point_mm, const Eigen::Vector3f&) const override {
    const float top = smooth_step(5.0F, 42.0F, (local_from_world_ * point_mm).z());
    Reflectance reflectance;
    reflectance.base = (1.1F - 0.45F * top) * base_;
    reflectance.coat = 0.02F;
    reflectance.roughness = 0.5F;
    return reflectance;
  }

 private:
  Eigen::Vector3f base_;
  Eigen::Isometry3f local_from_world_;
};

std::vector<SceneObject> napkin_with_roll(const Thing& thing, Draws& draws, const Eigen::Isometry3d& pose) {
  Parts napkin(TruthKind::napkin);
  napkin.add(utensil_mesh(UtensilKind::napkin), make_plain(thing.second_srgb, 0.0F, 0.9F));
  std::vector<SceneObject> objects = napkin.take();
  Parts roll(TruthKind::food);
  const double height_mm = draws.between(19.0, 25.0);
  const Eigen::Vector3d centre_mm{draws.between(-15.0, 15.0), draws.between(-15.0, 15.0), 1.3 + height_mm};
  const Eigen::Vector3d half_mm{draws.between(40.0, 52.0), draws.between(30.0, 38.0), height_mm};
  roll.add_block(centre_mm, half_mm, 2.25, std::make_shared<Crust>(thing.srgb, pose.inverse()));
  objects.push_back(std::move(roll.take().front()));
  return objects;
}

}  // namespace

Eigen::Vector2d half_size_mm(ThingKind kind) {
  switch (kind) {
    case ThingKind::cup:
      return {72.0, 46.0};
    case ThingKind::hand:
      return {118.0, 82.0};
    case ThingKind::phone:
      return {82.0, 41.0};
    case ThingKind::wallet:
      return {58.0, 48.0};
    case ThingKind::keys:
      return {72.0, 72.0};
    case ThingKind::packet:
      return {44.0, 42.0};
    case ThingKind::napkin_with_roll:
      return {84.0, 82.0};
  }
  return {0.0, 0.0};
}

std::vector<SceneObject> objects_of(const Thing& thing) {
  Draws draws(thing.seed, "thing");
  const Eigen::Isometry3d pose = placement(
      {thing.centre_mm.x(), thing.centre_mm.y(), thing.base_mm + kThingClearanceMm}, thing.rotation_deg);
  std::vector<SceneObject> objects;
  switch (thing.kind) {
    case ThingKind::cup:
      objects = cup(thing, draws);
      break;
    case ThingKind::hand:
      objects = hand(thing, draws);
      break;
    case ThingKind::phone:
      objects = phone(thing, draws);
      break;
    case ThingKind::wallet:
      objects = wallet(thing, draws);
      break;
    case ThingKind::keys:
      objects = keys(thing, draws);
      break;
    case ThingKind::packet:
      objects = packet(thing, draws);
      break;
    case ThingKind::napkin_with_roll:
      objects = napkin_with_roll(thing, draws, pose);
      break;
  }
  for (SceneObject& object : objects) transform(object.mesh, pose);
  return objects;
}

}  // namespace traygauge
