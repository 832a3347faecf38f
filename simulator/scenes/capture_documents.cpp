#include "simulator/scenes/capture_documents.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "simulator/capture/capture_document.hpp"
#include "simulator/scenes/scene_poses.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

// To a thousandth, as a number that prints short.
double thousandths(double value) {
  return std::round(value * 1000.0) / 1000.0;
}

Json compose_dish(const DishDescription& dish) {
  Json json;
  json["style"] = dish.style;
  json["outer_size_mm"] = dish.outer_size_mm;
  json["rim_height_mm"] = dish.rim_height_mm;
  json["bottom_height_mm"] = dish.bottom_height_mm;
  if (dish.profile.empty()) return json;
  Json profile = Json::array();
  for (const ProfilePoint& point : dish.profile) profile.push_back({point.inset_mm, point.height_mm});
  json["profile"] = profile;
  return json;
}

Json compose_pose(const Eigen::Isometry3d& pose) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < 4; ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < 4; ++j) row.push_back(pose.matrix()(i, j));
    rows.push_back(row);
  }
  return rows;
}

Json compose_food(const FoodTruth& food, const LaidScene& laid) {
  const SceneDescription& scene = laid.description();
  Json json;
  json["label"] = food.object.label;
  json["name"] = food.name;
  json["kind"] = food.is_scan ? "scan" : "heightfield";
  json["dish_label"] = scene.dishes[static_cast<std::size_t>(food.dish)].dish.label;
  json["volume_ml"] = thousandths(food.volume_ml);
  json["volume_second_way_ml"] = thousandths(food.check_volume_ml);
  if (food.is_scan) json["column_volume_ml"] = thousandths(food.column_volume_ml);
  json["volume_above_bottom_plane_ml"] = thousandths(food.above_bottom_plane_ml);
  json["max_height_mm"] = thousandths(food.max_height_mm);
  json["footprint_cm2"] = thousandths(food.footprint_cm2);
  json["fraction_of_footprint_on_plate_wall"] = thousandths(food.share_on_wall);
  json["centre_mm"] = {thousandths(food.centre_mm.x()), thousandths(food.centre_mm.y())};
  if (food.is_filled) {
    json["filled"] = true;
    json["fill_level_mm"] = food.fill_level_mm;
  }
  return json;
}

Json compose_place(const LaidDish& dish) {
  Json json;
  json["label"] = dish.dish.label;
  json["style"] = dish.dish.style;
  json["centre_mm"] = {dish.centre_mm.x(), dish.centre_mm.y(), 0.0};
  json["rotation_deg"] = dish.rotation_deg;
  json["semi_axes_mm"] = {0.5 * dish.dish.outer_size_mm[0], 0.5 * dish.dish.outer_size_mm[1]};
  json["bottom_height_mm"] = dish.dish.bottom_height_mm;
  json["rim_height_mm"] = dish.dish.rim_height_mm;
  return json;
}

Json compose_displacements(const Photograph& view) {
  Json displaced = Json::array();
  for (const Displacement& moved : view.displaced) {
    displaced.push_back({{"label", moved.label},
                         {"shift_mm", {thousandths(moved.shift_mm.x()), thousandths(moved.shift_mm.y())}},
                         {"turn_deg", moved.turn_deg}});
  }
  return displaced;
}

void add_angles(Json& json, const LaidScene& laid) {
  const SceneDescription& scene = laid.description();
  const LaidDish& dish = scene.dishes.front();
  const Eigen::Vector3d middle(dish.centre_mm.x(), dish.centre_mm.y(), dish.dish.bottom_height_mm);
  Json angles = Json::object();
  for (const auto& [a, b] : scene.pairs) {
    const double angle_deg =
        relative_angle_deg(view_camera(scene, scene.views[static_cast<std::size_t>(a)]),
                           view_camera(scene, scene.views[static_cast<std::size_t>(b)]), middle);
    angles[std::to_string(a) + "-" + std::to_string(b)] = thousandths(angle_deg);
  }
  json["relative_angle_deg"] = angles;
  for (const Photograph& view : scene.views) {
    json["tilt_from_vertical_deg"].push_back(thousandths(view.tilt_deg));
    json["distance_mm"].push_back(thousandths(view.distance_mm));
  }
}

}  // namespace

Json compose_capture(const SceneDescription& scene) {
  Json json;
  json["version"] = 1;
  json["camera"] = compose_camera(scene.photography.camera);
  json["card"] = {{"pattern", "card.png"},
                  {"width_mm", scene.card.width_mm},
                  {"height_mm", scene.card.height_mm},
                  {"thickness_mm", scene.card.thickness_mm}};
  const auto is_dish = [](const LaidDish& laid) { return !laid.is_ground; };
  if (std::ranges::count_if(scene.dishes, is_dish) == 1) {
    json["dish"] = compose_dish(std::ranges::find_if(scene.dishes, is_dish)->dish);
  } else {
    for (const LaidDish& dish : scene.dishes) {
      if (dish.is_ground) continue;
      Json entry = {{"label", dish.dish.label}};
      entry.update(compose_dish(dish.dish));
      json["dishes"].push_back(entry);
    }
  }
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    Json view = {{"image", "view_" + std::to_string(i) + ".jpg"},
                 {"labels", "labels_" + std::to_string(i) + ".png"}};
    if (scene.views[i].arm_angle_deg) view["arm_angle_deg"] = *scene.views[i].arm_angle_deg;
    json["views"].push_back(view);
  }
  json["pairs"] = scene.pairs;
  return json;
}

Json compose_truth(const LaidScene& laid, const std::vector<std::vector<std::size_t>>& visible) {
  const SceneDescription& scene = laid.description();
  Json json;
  json["origin"] = scene.origin;
  json["items"] = Json::array();
  for (const FoodTruth& food : laid.foods()) json["items"].push_back(compose_food(food, laid));
  for (const Photograph& view : scene.views) json["poses"].push_back(compose_pose(camera_from_world(view)));
  for (const LaidDish& dish : scene.dishes) {
    if (!dish.is_ground) json["dishes"].push_back(compose_place(dish));
  }
  add_angles(json, laid);
  json["world"] = scene.tray ? "mm; origin on the tray's floor, z up; the table 3 mm below"
                             : "mm; origin on the table, z up";
  const Eigen::Isometry3d card = world_from_card(scene.card);
  const double w = scene.card.width_mm;
  const double h = scene.card.height_mm;
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(w, 0, 0),
                                        Eigen::Vector3d(w, h, 0), Eigen::Vector3d(0, h, 0)}) {
    const Eigen::Vector3d at = card * corner;
    json["card_corners_mm"].push_back({at.x(), at.y(), at.z()});
  }
  json["card_tilt_deg"] = scene.card.tilt_deg;
  json["card_curl_mm"] = scene.card.curl_mm;
  json["card_corner_order"] = "pattern image TL,TR,BR,BL";
  json["table"] = surface_kind_names()[static_cast<std::size_t>(scene.table.kind)];
  for (const Photograph& view : scene.views) {
    json["exposure_gain"].push_back(view.exposure);
    json["wb_gain_rgb"].push_back({view.white_balance[0], 1.0, view.white_balance[1]});
    json["displaced"].push_back(compose_displacements(view));
  }
  json["depth"] = "depth_0.png: view 0, z along the optical axis, uint16, 0.02 mm per unit";
  for (const std::vector<std::size_t>& pixels : visible) {
    Json counts = Json::object();
    for (const FoodTruth& food : laid.foods())
      counts[std::to_string(food.object.label)] = pixels[food.object.label];
    json["visible_px"].push_back(counts);
  }
  return json;
}

}  // namespace traygauge
