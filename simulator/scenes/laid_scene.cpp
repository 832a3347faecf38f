#include "simulator/scenes/laid_scene.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "simulator/scenes/card_print.hpp"
#include "simulator/scenes/mesh_tools.hpp"
#include "simulator/scenes/scene_poses.hpp"
#include "simulator/scenes/tableware.hpp"
#include "simulator/scenes/things.hpp"

namespace traygauge {
namespace {

constexpr double kTableHalfMm = 1500.0;
constexpr double kRimMm = 5.0;         // of a dish's edge, from outside: as far as its outline is seen as rim
constexpr double kClearanceMm = 0.01;  // what lies on something does not share its surface

// A pattern that goes with what it is on.
class DisplacedMaterial : public Material {
 public:
  DisplacedMaterial(std::shared_ptr<const Material> still, const Eigen::Isometry3d& still_from_world)
      : still_(std::move(still)), still_from_world_(still_from_world.cast<float>()) {}

  Reflectance at(const Eigen::Vector3f& point_mm, const Eigen::Vector3f& normal) const override {
    return still_->at(still_from_world_ * point_mm, still_from_world_.linear() * normal);
  }

 private:
  std::shared_ptr<const Material> still_;
  Eigen::Isometry3f still_from_world_;
};

// Of a dish whose coordinates are `dish_from_world`.
TruthKind kind_of_dish(const DishShell& shell, const Eigen::Isometry3f& dish_from_world,
                       const Eigen::Vector3f& point_mm) {
  const Eigen::Vector3d point = (dish_from_world * point_mm).cast<double>();
  return shell.inset_mm(point.x(), point.y()) < kRimMm ? TruthKind::rim : TruthKind::glaze;
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, double x, double y, double z) {
  return pose * Eigen::Translation3d(x, y, z);
}

// In the card's coordinates.
TriangleMesh card_mesh(const LaidCard& card) {
  const double depth_mm = card.thickness_mm - kClearanceMm;
  if (card.curl_mm == 0.0) return box_mesh({0.0, 0.0, 0.0}, {card.width_mm, card.height_mm, depth_mm});
  constexpr int kStrips = 64;
  std::vector<std::vector<Eigen::Vector3f>> loops;
  for (int strip = 0; strip <= kStrips; ++strip) {
    const double x = card.width_mm * strip / kStrips;
    const double top = -card_lift_mm(card, x);
    std::vector<Eigen::Vector3f>& loop = loops.emplace_back();
    for (const Eigen::Vector3d& corner :
         {Eigen::Vector3d(x, 0.0, top), Eigen::Vector3d(x, 0.0, top + depth_mm),
          Eigen::Vector3d(x, card.height_mm, top + depth_mm), Eigen::Vector3d(x, card.height_mm, top)})
      loop.emplace_back(corner.cast<float>());
  }
  return skin_of_loops(loops);
}

}  // namespace

LaidScene::LaidScene(SceneDescription description, int threads) : description_(std::move(description)) {
  for (const LaidDish& dish : description_.dishes) shells_.emplace_back(dish.dish);
  add_dishes(threads);
  add_card();
  add_tray();
  add_utensils();
  add_things();
  on_tray_ = std::move(scene_.objects);
  scene_.ambient = description_.ambient.cast<float>();
}

void LaidScene::add_dishes(int threads) {
  for (std::size_t i = 0; i < description_.dishes.size(); ++i) {
    const LaidDish& dish = description_.dishes[i];
    const Eigen::Isometry3d pose = world_from_dish(dish);
    SceneObject object{shells_[i].mesh(), make_glaze(dish.glaze, shells_[i], dish.seed, pose.inverse()),
                       static_cast<std::uint8_t>(dish.dish.label), TruthKind::glaze};
    object.kind_at = [shell = shells_[i], inverse = Eigen::Isometry3f(pose.inverse().cast<float>())](
                         const Eigen::Vector3f& point_mm) { return kind_of_dish(shell, inverse, point_mm); };
    object.is_clear = dish.glaze.finish == GlazeFinish::clear;
    transform(object.mesh, moved(pose, 0.0, 0.0, kClearanceMm));
    if (!dish.is_ground) scene_.objects.push_back(std::move(object));
    for (ServedFood& food :
         serve_foods(description_, static_cast<int>(i), shells_[i], kFirstItemLabel, threads)) {
      transform(food.object.mesh, moved(Eigen::Isometry3d::Identity(), 0.0, 0.0, kClearanceMm));
      food.object.kind = TruthKind::food;
      scene_.objects.push_back(std::move(food.object));
      food.object = SceneObject{{}, nullptr, scene_.objects.back().label};
      foods_.push_back(std::move(food));
    }
  }
  std::sort(foods_.begin(), foods_.end(),
            [](const FoodTruth& a, const FoodTruth& b) { return a.object.label < b.object.label; });
}

void LaidScene::add_card() {
  const LaidCard& card = description_.card;
  print_ = std::make_shared<const Picture>(
      card.print.empty() ? print_card(card.width_mm, card.height_mm, card.design) : read_print(card.print));
  const Eigen::Vector2d px_per_mm =
      card.print.empty()
          ? Eigen::Vector2d::Constant(kCardPrintPxPerMm)
          : Eigen::Vector2d(print_->size.width / card.width_mm, print_->size.height / card.height_mm);
  const Eigen::Isometry3d pose = world_from_card(card);
  SceneObject object{card_mesh(card), make_card_material(print_, px_per_mm, card, pose.inverse()), kCardLabel,
                     TruthKind::card};
  transform(object.mesh, pose);
  scene_.objects.push_back(std::move(object));
}

void LaidScene::add_tray() {
  if (!description_.tray) return;
  const Tray& tray = *description_.tray;
  scene_.objects.push_back(
      {tray_mesh(tray), make_surface(tray.kind, tray.seed, Eigen::Isometry3d::Identity()), 0});
}

void LaidScene::add_utensils() {
  for (const Utensil& utensil : description_.utensils) {
    const bool is_paper = utensil.kind == UtensilKind::napkin;
    SceneObject object{utensil_mesh(utensil.kind),
                       is_paper ? make_plain(utensil.srgb, 0.0F, 0.9F) : make_metal(utensil.srgb, 0.22F), 0,
                       is_paper ? TruthKind::napkin : TruthKind::cutlery};
    const Eigen::Vector3d at(utensil.centre_mm.x(), utensil.centre_mm.y(), utensil.base_mm + kClearanceMm);
    transform(object.mesh, placement(at, utensil.rotation_deg));
    scene_.objects.push_back(std::move(object));
  }
}

void LaidScene::add_things() {
  for (const Thing& thing : description_.things) {
    for (SceneObject& object : objects_of(thing)) scene_.objects.push_back(std::move(object));
  }
}

void LaidScene::add_room(const Eigen::Isometry3d& world_of_room) {
  const double table_mm = description_.tray ? -kTrayFloorMm - kClearanceMm : 0.0;
  SceneObject table{box_mesh({-kTableHalfMm, -kTableHalfMm, table_mm - 25.0},
                             {2.0 * kTableHalfMm, 2.0 * kTableHalfMm, 25.0}),
                    nullptr, 0};
  transform(table.mesh, world_of_room);
  const Eigen::Isometry3d pattern =
      world_of_room * placement(Eigen::Vector3d::Zero(), description_.table.rotation_deg);
  table.material = make_surface(description_.table.kind, description_.table.seed, pattern.inverse());
  scene_.objects.push_back(std::move(table));
  for (const Lamp& lamp : description_.lamps) {
    const Eigen::Matrix3d turn = world_of_room.linear();
    const Eigen::Vector3d corner =
        world_of_room * Eigen::Vector3d(lamp.centre_mm - 0.5 * (lamp.edge_u_mm + lamp.edge_v_mm));
    Eigen::Vector3d u = lamp.edge_u_mm;
    Eigen::Vector3d v = lamp.edge_v_mm;
    if (u.cross(v).dot(lamp.centre_mm) > 0.0) std::swap(u, v);  // to the table's middle
    scene_.lights.push_back({corner.cast<float>(), (turn * u).cast<float>(), (turn * v).cast<float>(),
                             lamp.radiance.cast<float>()});
  }
}

// Of a dish, a food or the card, in the world.
Eigen::Vector2d LaidScene::middle_of(std::uint8_t label) const {
  if (label == kCardLabel) return description_.card.centre_mm;
  for (const LaidDish& dish : description_.dishes) {
    if (dish.dish.label == label) return dish.centre_mm;
  }
  for (const FoodTruth& food : foods_) {
    if (food.object.label == label) return food.centre_mm;
  }
  throw std::invalid_argument("nothing in the scene has label " + std::to_string(label));
}

void LaidScene::displace(const Displacement& displacement) {
  const Eigen::Vector2d middle_mm = middle_of(displacement.label);
  const Eigen::Vector2d to_mm = middle_mm + displacement.shift_mm;
  const Eigen::Isometry3d motion = placement({to_mm.x(), to_mm.y(), 0.0}, displacement.turn_deg) *
                                   Eigen::Translation3d(-middle_mm.x(), -middle_mm.y(), 0.0);
  const auto lies_on_it = [&](std::uint8_t label) {
    return std::any_of(foods_.begin(), foods_.end(), [&](const FoodTruth& food) {
      const LaidDish& dish = description_.dishes[static_cast<std::size_t>(food.dish)];
      return food.object.label == label && dish.dish.label == displacement.label;
    });
  };
  for (SceneObject& object : scene_.objects) {
    if (object.label != displacement.label && !lies_on_it(object.label)) continue;
    transform(object.mesh, motion);
    object.material = std::make_shared<DisplacedMaterial>(object.material, motion.inverse());
    if (object.kind_at) {
      object.kind_at = [still = object.kind_at,
                        still_from_world = Eigen::Isometry3f(motion.inverse().cast<float>())](
                           const Eigen::Vector3f& point_mm) { return still(still_from_world * point_mm); };
    }
  }
}

const Scene& LaidScene::scene_of(const Photograph& view) {
  scene_.objects = on_tray_;
  for (const Displacement& displacement : view.displaced) displace(displacement);
  scene_.lights.clear();
  add_room(world_from_room(view));
  return scene_;
}

}  // namespace traygauge
