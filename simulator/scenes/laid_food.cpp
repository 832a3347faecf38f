#include "simulator/scenes/laid_food.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

#include "simulator/render/shared_work.hpp"
#include "simulator/scenes/food_material.hpp"
#include "simulator/scenes/height_mesh.hpp"
#include "simulator/scenes/laid_body.hpp"
#include "simulator/scenes/mesh_columns.hpp"
#include "simulator/scenes/mesh_tools.hpp"
#include "simulator/scenes/scanned_food.hpp"
#include "simulator/scenes/scene_poses.hpp"

namespace traygauge {
namespace {

constexpr double kCheckStepFraction = 0.7;  // of the meshed grid's step: of the one that is summed
constexpr double kMlPerMm3 = 1e-3;
constexpr double kColumnStepMm = 0.2;
constexpr double kSharedStepMm = 0.5;
constexpr double kMostApartShare =
    0.002;  // of a volume and of the one found the other way, on grids of 0.3 mm
constexpr double kQuickApartShare = 0.01;  // on coarser ones: a slice of cake has 0.4 % at 0.6 mm
// Or this much, 0.2 % of 5 ml: of crumbs the squares at the edge are a larger share (portions of 2 ml differ
// by up to 0.006 ml, those of the sets, from 28 ml on, by up to 0.06 %).
constexpr double kMostApartMl = 0.01;
constexpr double kMostSharedShare = 0.002;  // of the smaller of two foods: faces that touch
// A liquid's border: how far inside a place is for each mm that the level stands above the dish there.
constexpr double kInsidePerDepth = 1.5;

std::string rounded(double value_ml) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f", value_ml);
  return text.data();
}

// What one food needs to be painted on any grid.
struct Order {
  const LaidFood* food = nullptr;
  const FoodKind* kind = nullptr;
  FoodSize size;
};

// Room between the walls at the level of a liquid, a little less on each side.
FoodSize room_at_level(const DishShell& shell, const LaidFood& food, double height_mm) {
  constexpr double kMarginMm = 4.0;
  double inset_mm = shell.flat_inset_mm();
  while (inset_mm > 0.0 && shell.inner_height_mm(shell.semi_axis_mm(0) - inset_mm, 0.0) < food.level_mm)
    inset_mm -= 0.1;
  if (inset_mm <= 0.0 || food.level_mm <= shell.bottom_height_mm())
    throw std::invalid_argument(food.name + ": the level must lie between the dish's bottom and its rim");
  return {2.0 * (shell.semi_axis_mm(0) - inset_mm - kMarginMm),
          2.0 * (shell.semi_axis_mm(1) - inset_mm - kMarginMm), height_mm};
}

Order order_of(const LaidFood& food, const DishShell& shell) {
  const FoodKind* kind = find_food_kind(food.kind);
  if (kind == nullptr) throw std::invalid_argument("no kind of food is called " + food.kind);
  const FoodSize size = kind->is_filled() ? room_at_level(shell, food, kind->size.height_mm) : food.size;
  return {&food, kind, size};
}

HeightField paint(const Order& order, const DishShell& shell, double step_mm) {
  const LaidFood& food = *order.food;
  HeightField field(frame_around(std::max(shell.semi_axis_mm(0), shell.semi_axis_mm(1)), step_mm));
  if (order.kind->is_filled()) {
    for (int row = 0; row < field.frame.rows; ++row) {
      for (int column = 0; column < field.frame.columns; ++column) {
        const Eigen::Vector2d at = field.frame.node(column, row);
        if (!shell.contains(at.x(), at.y(), 1.0)) continue;
        const double depth_mm = food.level_mm - shell.inner_height_mm(at.x(), at.y());
        field.inside_mm[field.frame.index(column, row)] = static_cast<float>(kInsidePerDepth * depth_mm);
      }
    }
  }
  FoodPainter painter(field, food.centre_mm, food.rotation_deg);
  Draws draws(food.seed, "shape");
  order.kind->shape(painter, draws, order.size);
  return field;
}

// Each food on both grids, that of `step_mm`, which is meshed, and the finer one, which is summed; each gives
// way to earlier ones.
struct PaintedFoods {
  std::vector<HeightField> meshed;
  std::vector<HeightField> summed;
};

PaintedFoods paint_all(const std::vector<Order>& orders, const DishShell& shell, double step_mm,
                       int threads) {
  PaintedFoods painted;
  painted.meshed.resize(orders.size());
  painted.summed.resize(orders.size());
  share_work(2 * static_cast<int>(orders.size()), threads, {}, [&](int number) {
    const auto i = static_cast<std::size_t>(number / 2);
    if (number % 2 == 0)
      painted.summed[i] = paint(orders[i], shell, kCheckStepFraction * step_mm);  // the longer work first
    else
      painted.meshed[i] = paint(orders[i], shell, step_mm);
  });
  for (std::vector<HeightField>* fields : {&painted.meshed, &painted.summed}) {
    for (std::size_t i = 1; i < fields->size(); ++i)
      for (std::size_t k = 0; k < i; ++k) cut_away((*fields)[i], (*fields)[k]);
  }
  return painted;
}

// Volume above the dish by summing columns of a grid that nothing else uses.
double summed_volume_mm3(const Order& order, HeightField field, const DishShell& shell) {
  if (order.kind->is_filled()) {
    for (int row = 0; row < field.frame.rows; ++row) {
      for (int column = 0; column < field.frame.columns; ++column) {
        const Eigen::Vector2d at = field.frame.node(column, row);
        const double depth_mm = order.food->level_mm - shell.inner_height_mm(at.x(), at.y());
        float& height_mm = field.height_mm[field.frame.index(column, row)];
        height_mm = std::max(0.0F, height_mm + static_cast<float>(depth_mm));
      }
    }
  }
  return quadrature_mm3(field);
}

ServedFood serve(const Order& order, HeightField field, const SceneDescription& scene,
                 const DishShell& shell) {
  const LaidFood& food = *order.food;
  const LaidDish& dish = scene.dishes[static_cast<std::size_t>(food.dish)];
  extend_outward(field);
  const GroundHeight inner = [&](double x, double y) { return shell.inner_height_mm(x, y); };
  const GroundHeight level = [&](double, double) { return food.level_mm; };
  FoodSolid solid =
      mesh_of_field(field, order.kind->is_filled() ? level : inner, inner, shell.bottom_height_mm());

  const Eigen::Isometry3d world_of_dish = world_from_dish(dish);
  const double ground_mm = order.kind->is_filled() ? food.level_mm : shell.bottom_height_mm();
  const Eigen::Isometry3d dish_from_food =
      placement({food.centre_mm.x(), food.centre_mm.y(), ground_mm}, food.rotation_deg);
  ServedFood served;
  served.object.mesh = std::move(solid.mesh);
  transform(served.object.mesh, world_of_dish);
  served.object.material =
      make_food_material(*order.kind, food.seed, (world_of_dish * dish_from_food).inverse(),
                         std::make_shared<const HeightField>(std::move(field)), world_of_dish.inverse());
  served.is_filled = order.kind->is_filled();
  served.fill_level_mm = food.level_mm;
  served.volume_ml = kMlPerMm3 * solid.volume_mm3;
  served.above_bottom_plane_ml = kMlPerMm3 * solid.above_plane_mm3;
  served.footprint_cm2 = 0.01 * solid.footprint_mm2;
  served.share_on_wall = solid.footprint_mm2 > 0.0 ? solid.on_wall_mm2 / solid.footprint_mm2 : 0.0;
  served.max_height_mm = solid.max_height_mm;
  served.centre_mm =
      (world_of_dish * Eigen::Vector3d(solid.centre_mm.x(), solid.centre_mm.y(), 0.0)).head<2>();
  return served;
}

ServedFood serve_scan(const LaidFood& food, const SceneDescription& scene, const DishShell& shell) {
  const FoodKind* kind = find_food_kind(food.kind);
  if (kind == nullptr) throw std::invalid_argument("no kind of food is called " + food.kind);
  const Eigen::Isometry3d world_of_dish = world_from_dish(scene.dishes[static_cast<std::size_t>(food.dish)]);
  const Eigen::Isometry3d dish_from_food =
      placement({food.centre_mm.x(), food.centre_mm.y(), 0.0}, food.rotation_deg);
  ServedFood served;
  served.is_scan = true;
  TriangleMesh& mesh = served.object.mesh;
  mesh = load_scan(*food.scan);
  const double volume_mm3 = enclosed_volume_mm3(mesh);
  transform(mesh, dish_from_food);
  set_down(mesh, [&](double x, double y) { return shell.inner_height_mm(x, y); });
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector3d high = -low;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex.cast<double>());
    high = high.cwiseMax(vertex.cast<double>());
  }
  served.max_height_mm = high.z() - shell.bottom_height_mm();
  served.centre_mm = (world_of_dish * (0.5 * (low + high))).head<2>();
  const Columns columns =
      columns_above(mesh, kColumnStepMm, [&](double x, double y) { return shell.inner_height_mm(x, y); });
  served.column_volume_ml = kMlPerMm3 * columns.volume_mm3;
  served.footprint_cm2 = 0.01 * columns.area_mm2;
  served.volume_ml = kMlPerMm3 * volume_mm3;
  served.check_volume_ml = kMlPerMm3 * solid_columns_mm3(mesh, kColumnStepMm);
  served.above_bottom_plane_ml = served.volume_ml;
  transform(mesh, world_of_dish);
  served.object.material = make_food_material(*kind, food.seed, (world_of_dish * dish_from_food).inverse(),
                                              nullptr, world_of_dish.inverse());
  return served;
}

// A scanned food or a proof body does not give way to others as heights on one grid do: what it shares would
// count twice.
void require_apart(const std::vector<ServedFood>& foods) {
  const auto gives_way = [](const ServedFood& food) { return !food.is_scan && !food.is_body; };
  for (std::size_t i = 0; i < foods.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (gives_way(foods[i]) && gives_way(foods[k])) continue;
      const double shared_ml =
          kMlPerMm3 * shared_columns_mm3(foods[i].object.mesh, foods[k].object.mesh, kSharedStepMm);
      if (shared_ml <= kMostSharedShare * std::min(foods[i].volume_ml, foods[k].volume_ml)) continue;
      throw std::invalid_argument(foods[k].name + " and " + foods[i].name + " share " + rounded(shared_ml) +
                                  " ml of one dish, which would count twice; move one of them");
    }
  }
}

}  // namespace

void require_agreement(const ServedFood& food, double step_mm) {
  const bool is_coarse = step_mm > SceneDescription().food_step_mm;
  const double most_share = is_coarse ? kQuickApartShare : kMostApartShare;
  const double apart_ml = std::abs(food.check_volume_ml - food.volume_ml);
  if (apart_ml <= std::max(most_share * food.volume_ml, kMostApartMl)) return;
  throw std::invalid_argument(food.name + ": its volume is " + rounded(food.volume_ml) +
                              " ml as a mesh and " + rounded(food.check_volume_ml) +
                              " ml as columns; they may differ by " + (is_coarse ? "1" : "0.2") +
                              " %, else there is no exact truth");
}

std::vector<ServedFood> serve_foods(const SceneDescription& scene, int dish, const DishShell& shell,
                                    int first_label, int threads) {
  std::vector<Order> orders;
  std::vector<int> labels;
  std::vector<ServedFood> served;
  for (std::size_t i = 0; i < scene.foods.size(); ++i) {
    const LaidFood& food = scene.foods[i];
    if (food.dish != dish) continue;
    const int label = first_label + static_cast<int>(i);
    if (!food.scan && food.body.empty()) {
      orders.push_back(order_of(food, shell));
      labels.push_back(label);
      continue;
    }
    ServedFood solid = food.scan ? serve_scan(food, scene, shell) : serve_body(food, scene, shell);
    solid.object.label = static_cast<std::uint8_t>(label);
    served.push_back(std::move(solid));
    served.back().name = food.name;
  }
  PaintedFoods painted = paint_all(orders, shell, scene.food_step_mm, threads);
  const std::size_t solids = served.size();
  served.resize(solids + orders.size());
  share_work(static_cast<int>(orders.size()), threads, {}, [&](int number) {
    const auto i = static_cast<std::size_t>(number);
    ServedFood& food = served[solids + i];
    food = serve(orders[i], std::move(painted.meshed[i]), scene, shell);
    food.check_volume_ml = kMlPerMm3 * summed_volume_mm3(orders[i], std::move(painted.summed[i]), shell);
    food.object.label = static_cast<std::uint8_t>(labels[i]);
    food.name = orders[i].food->name;
  });
  for (ServedFood& food : served) {
    food.dish = dish;
    require_agreement(food, scene.food_step_mm);
  }
  require_apart(served);
  return served;
}

}  // namespace traygauge
