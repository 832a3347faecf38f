// A description turned into what the renderer takes, and the truth about it.
#pragma once

#include <memory>
#include <vector>

#include "simulator/capture/picture.hpp"
#include "simulator/render/scene.hpp"
#include "simulator/scenes/laid_food.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// The truth about a food, without its mesh.
using FoodTruth = ServedFood;

class LaidScene {
 public:
  // Throws InputError for a mesh that cannot be read, std::invalid_argument for foods that cannot be.
  // `threads`, 0 for one a core, change nothing but the time.
  explicit LaidScene(SceneDescription description, int threads = 0);

  const SceneDescription& description() const { return description_; }
  // In the order of their labels; their meshes are in the scene.
  const std::vector<FoodTruth>& foods() const { return foods_; }
  const std::vector<DishShell>& shells() const { return shells_; }
  const Picture& card_print() const { return *print_; }

  // What the camera saw when this view was taken. The scene stays until the next call.
  const Scene& scene_of(const Photograph& view);

 private:
  void add_dishes(int threads);
  void add_card();
  void add_tray();
  void add_utensils();
  void add_things();
  void add_room(const Eigen::Isometry3d& world_of_room);
  Eigen::Vector2d middle_of(std::uint8_t label) const;
  void displace(const Displacement& displacement);

  SceneDescription description_;
  std::vector<DishShell> shells_;
  std::vector<FoodTruth> foods_;
  std::shared_ptr<const Picture> print_;
  std::vector<SceneObject> on_tray_;  // as they were laid
  Scene scene_;
};

}  // namespace traygauge
