// A rendered capture with its truth as the bundle adjustment sees it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/dish/dish_model.hpp"
#include "core/dish/dish_outline.hpp"
#include "core/dish/rim_residual.hpp"
#include "core/geometry/table_frame.hpp"
#include "tests/support/capture_truth.hpp"

namespace traygauge::test {

struct TrueDish {
  DishModel model;
  DishRegion region;
  DishPose place;  // in the table frame; the drop of the edge is not known
};

struct BundleCapture {
  CaptureTruth truth;
  Pose table_from_world;
  double card_thickness_mm = 0.0;
  Vec3 card_middle_mm = Vec3::Zero();  // in the table frame
  std::vector<TrueDish> dishes;

  Pose camera_from_table(std::size_t view) const {
    return truth.views[view].camera_from_world * table_from_world.inverse();
  }
};

// The frame that the card's corners define, on the true table.
inline Pose table_frame_of(const CaptureTruth& truth, double card_thickness_mm) {
  const Vec3 x = (truth.card_corners_mm[1] - truth.card_corners_mm[0]).normalized();
  const Vec3 z = Vec3::UnitZ();
  Pose world_from_table;
  world_from_table.rotation << x, z.cross(x), z;
  world_from_table.translation = truth.card_corners_mm[0] - card_thickness_mm * z;
  return world_from_table.inverse();
}

inline TrueDish read_dish(const nlohmann::json& description, const nlohmann::json* truth,
                          const nlohmann::json& items, const Pose& table_from_world) {
  TrueDish dish;
  dish.model.outer_size_mm = {description["outer_size_mm"][0], description["outer_size_mm"][1]};
  dish.model.rim_height_mm = description["rim_height_mm"];
  dish.model.bottom_height_mm = description["bottom_height_mm"];
  for (const nlohmann::json& point : description["profile"])
    dish.model.profile_points.at(dish.model.profile_size++) = {point[0], point[1]};
  Vec3 centre = Vec3::Zero();
  double turn_rad = 0.0;
  if (truth != nullptr) {
    centre = vec3_from_json((*truth)["centre_mm"]);
    turn_rad = (*truth)["rotation_deg"].get<double>() * CV_PI / 180.0;
    dish.region = {description["label"].get<std::uint8_t>(), {}};
    dish.region.on_dish.add(dish.region.dish);
    for (const nlohmann::json& item : items) {
      if (item["dish_label"] == description["label"])
        dish.region.on_dish.add(item["label"].get<std::uint8_t>());
    }
  }
  dish.place.centre_mm = (table_from_world * centre).head<2>();
  const Vec3 axis = table_from_world.rotation * Vec3(std::cos(turn_rad), std::sin(turn_rad), 0.0);
  dish.place.azimuth_rad = std::atan2(axis.y(), axis.x());
  dish.place.edge_height_mm = dish.model.profile_points[0].height_mm;
  dish.place.size_mm = dish.model.outer_size_mm;
  return dish;
}

inline BundleCapture read_bundle_capture(const std::string& name) {
  BundleCapture capture;
  capture.truth = read_capture_truth(captures_folder() / name);
  const nlohmann::json& description = capture.truth.description;
  const nlohmann::json& card = description["card"];
  capture.card_thickness_mm = card["thickness_mm"];
  capture.card_middle_mm = {0.5 * card["width_mm"].get<double>(), -0.5 * card["height_mm"].get<double>(),
                            capture.card_thickness_mm};
  capture.table_from_world = table_frame_of(capture.truth, capture.card_thickness_mm);
  const nlohmann::json& items = capture.truth.truth["items"];
  if (description.contains("dish")) {
    capture.dishes = {read_dish(description["dish"], nullptr, items, capture.table_from_world)};
    return capture;
  }
  for (std::size_t i = 0; i < description["dishes"].size(); ++i) {
    capture.dishes.push_back(read_dish(description["dishes"][i], &capture.truth.truth["dishes"][i], items,
                                       capture.table_from_world));
  }
  return capture;
}

}  // namespace traygauge::test
