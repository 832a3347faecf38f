#include "simulator/scenes/beside_set.hpp"

#include <array>
#include <string>
#include <string_view>

#include "simulator/scenes/food_kinds.hpp"
#include "simulator/scenes/scene_menu.hpp"
#include "simulator/scenes/scene_parts.hpp"
#include "simulator/scenes/scene_series.hpp"
#include "simulator/scenes/tableware.hpp"
#include "simulator/scenes/tray_layout.hpp"

namespace traygauge {
namespace {

// What people lay down without a plate.
constexpr std::array<std::string_view, 7> kPieces = {"bread",   "cake",     "pizza",      "burger_patty",
                                                     "sausage", "omelette", "chicken_leg"};
constexpr double kPlateScale = 0.95;
constexpr double kPieceRoomMm = 155.0;
constexpr double kNapkinRoomMm = 185.0;

// Food on the ground of that index, a usual portion or up to a quarter less or a tenth more.
void lay_piece(SceneDescription& scene, Draws& draws, int ground, std::string_view kind) {
  const FoodKind& laid = *find_food_kind(kind);
  LaidFood food;
  food.kind = laid.name;
  food.name = food.kind;
  food.dish = ground;
  food.rotation_deg = draws.between(0.0, 360.0);
  const double portion = draws.between(0.75, 1.1);
  food.size = {portion * laid.size.length_mm, portion * laid.size.width_mm,
               draws.between(0.9, 1.2) * laid.size.height_mm};
  food.seed = draws.seed();
  scene.foods.push_back(food);
}

void lay_napkin(SceneDescription& scene, Draws& draws, const LaidDish& ground) {
  scene.utensils.push_back({UtensilKind::napkin, ground.centre_mm, draws.between(0.0, 90.0), 0.0,
                            draws.pick(std::span<const std::uint32_t>(kNapkinPapers))});
}

}  // namespace

std::vector<SceneDescription> make_beside(std::uint64_t seed) {
  Draws menu_draws(seed, "beside-8 menu");
  Menu menu(menu_draws, {FoodGroup::canteen}, FoodServing::solid);
  return make_each(8, "b", "beside-8", seed, [&](std::size_t i, const std::string& name, Draws& draws) {
    const bool has_napkin = i % 3 == 0;
    const std::size_t pieces = has_napkin ? 1 : 1 + i % 2;
    const auto meal = menu.deal(2);
    SceneDescription scene = empty_scene(name, draws);
    draw_camera(scene, draws, kWideFocalPx);
    draw_tray(scene, draws);
    const DishStyle plate = draws.chance(0.5) ? DishStyle::oval : DishStyle::dinner;
    scene.dishes = {draw_dish(draws, plate, kPlateScale, kDishLabel)};
    for (std::size_t k = 0; k < pieces; ++k) {
      scene.dishes.push_back(ground_under_food(has_napkin ? kNapkinRoomMm : kPieceRoomMm,
                                               has_napkin ? kNapkinMm : 0.0,
                                               kFirstTrayPlace + static_cast<int>(k)));
    }
    scene.card.thickness_mm = draws.chance(0.5) ? 0.8 : 0.2;
    scene.card.design = draws.seed();
    lay_out_tray(scene, draws);
    if (has_napkin) lay_napkin(scene, draws, scene.dishes[1]);
    draw_foods(scene, draws, 0, plate, kPlateScale, meal);
    for (std::size_t k = 0; k < pieces; ++k)
      lay_piece(scene, draws, 1 + static_cast<int>(k),
                draws.pick(std::span<const std::string_view>(kPieces)));
    draw_views(scene, draws, 3, kTrayViews);
    return scene;
  });
}

}  // namespace traygauge
