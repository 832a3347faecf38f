#include "simulator/scenes/scene_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "simulator/bodies/proof_body.hpp"
#include "simulator/capture/dish_toml.hpp"
#include "simulator/capture/toml_file.hpp"
#include "simulator/scenes/food_kinds.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxSceneBytes = std::size_t{1} << 20U;
constexpr std::size_t kMaxFoods = 198;
constexpr std::size_t kMaxDisplacements = 20;
constexpr std::size_t kMaxViews = 100;
constexpr NumberRange kPlaceMm{-1000.0, 1000.0};
constexpr NumberRange kAngleDeg{-360.0, 360.0};
constexpr std::array<std::string_view, 4> kUtensilNames = {"fork", "knife", "spoon", "napkin"};

// A table of the file, its keys checked.
class SceneTable {
 public:
  SceneTable(JsonNode node, std::initializer_list<std::string_view> keys) : node_(std::move(node)) {
    expect_keys(node_, std::span<const std::string_view>(keys.begin(), keys.size()));
  }

  std::optional<JsonNode> find(const char* key) const { return node_.find(key); }

  // Leave the value as it is where the key is absent.
  void read(const char* key, double& value, NumberRange range) const {
    if (const auto found = find(key)) value = found->number(range);
  }
  void read(const char* key, std::uint64_t& value) const {
    if (const auto found = find(key))
      value = static_cast<std::uint64_t>(found->integer(0, std::numeric_limits<int>::max()));
  }
  void read(const char* key, Eigen::Vector2d& value, NumberRange range) const {
    if (const auto found = find(key))
      value = Eigen::Map<const Eigen::Vector2d>(found->numbers(2, range).data());
  }
  void read(const char* key, Eigen::Vector3d& value, NumberRange range) const {
    if (const auto found = find(key))
      value = Eigen::Map<const Eigen::Vector3d>(found->numbers(3, range).data());
  }
  template <std::size_t Count>
  void read(const char* key, std::array<double, Count>& value, NumberRange range) const {
    if (const auto found = find(key)) std::ranges::copy(found->numbers(Count, range), value.begin());
  }
  // "#RRGGBB".
  void read_colour(const char* key, std::uint32_t& srgb) const {
    const auto found = find(key);
    if (!found) return;
    const std::string text = found->text();
    if (text.size() != 7 || text[0] != '#' ||
        text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
      found->fail("a colour as \"#RRGGBB\"", "correct the value");
    srgb = static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16));
  }
  template <class Choice>
  void read_choice(const char* key, Choice& choice, std::span<const std::string_view> names) const {
    const auto found = find(key);
    if (!found) return;
    const auto name = std::ranges::find(names, found->text());
    if (name == names.end()) {
      std::string list;
      for (const std::string_view known : names)
        list += (list.empty() ? "one of " : ", ") + std::string(known);
      found->fail(list, "correct the value");
    }
    choice = static_cast<Choice>(name - names.begin());
  }

 private:
  JsonNode node_;
};

void read_camera(const JsonNode& node, PhotographySettings& photography) {
  const SceneTable table(
      node, {"width", "height", "fx", "fy", "cx", "cy", "distortion", "aperture_mm", "corner_loss",
             "full_well_electrons", "read_noise_electrons", "jpeg_quality"});
  CameraDescription& camera = photography.camera;
  camera.size = {node.member("width").integer(kMinPictureSide, kMaxPictureSide),
                 node.member("height").integer(kMinPictureSide, kMaxPictureSide)};
  constexpr NumberRange kFocalPx{10.0, 1e5};
  camera.fx_px = node.member("fx").number(kFocalPx);
  camera.fy_px = camera.fx_px;
  camera.cx_px = 0.5 * (camera.size.width - 1);
  camera.cy_px = 0.5 * (camera.size.height - 1);
  table.read("fy", camera.fy_px, kFocalPx);
  table.read("cx", camera.cx_px, {0.0, static_cast<double>(camera.size.width)});
  table.read("cy", camera.cy_px, {0.0, static_cast<double>(camera.size.height)});
  table.read("distortion", camera.distortion, {-5.0, 5.0});
  table.read("aperture_mm", photography.aperture_mm, {0.0, 50.0});
  table.read("corner_loss", photography.corner_loss, {0.0, 0.9});
  table.read("full_well_electrons", photography.full_well_electrons, {10.0, 1e7});
  table.read("read_noise_electrons", photography.read_noise_electrons, {0.0, 1e4});
  if (const auto quality = table.find("jpeg_quality")) photography.jpeg_quality = quality->integer(1, 100);
}

LaidDish read_laid_dish(const JsonNode& node, const std::filesystem::path& folder, std::size_t number) {
  const SceneTable table(node, {"file", "centre_mm", "rotation_deg", "seed", "colour", "roughness",
                                "decoration", "lines", "specks"});
  LaidDish laid;
  laid.dish = read_dish_file(folder / node.member("file").text());
  laid.dish.label = number == 0 ? 1 : kFirstFurtherDishLabel + static_cast<int>(number) - 1;
  table.read("centre_mm", laid.centre_mm, kPlaceMm);
  table.read("rotation_deg", laid.rotation_deg, kAngleDeg);
  table.read("seed", laid.seed);
  table.read_colour("colour", laid.glaze.srgb);
  table.read_colour("decoration", laid.glaze.decoration_srgb);
  auto roughness = static_cast<double>(laid.glaze.roughness);
  table.read("roughness", roughness, {0.02, 1.0});
  laid.glaze.roughness = static_cast<float>(roughness);
  table.read("specks", laid.glaze.speck_fraction, {0.0, 1.0});
  if (const auto lines = table.find("lines")) {
    for (const JsonNode& line : lines->elements(0, 16)) {
      const std::vector<double> pair = line.numbers(2, {0.0, 200.0});
      laid.glaze.lines.push_back({pair[0], pair[1]});
    }
  }
  return laid;
}

// Where a food or a proof body lies.
void read_place(const SceneTable& table, const SceneDescription& scene, LaidFood& food) {
  if (const auto name = table.find("name")) food.name = name->text();
  if (const auto label = table.find("dish")) {
    const int wanted = label->integer(1, kFirstFurtherDishLabel + static_cast<int>(kMaxDishes));
    const auto dish =
        std::ranges::find(scene.dishes, wanted, [](const LaidDish& laid) { return laid.dish.label; });
    if (dish == scene.dishes.end())
      label->fail("the label of a dish: 1 for the first, 201, 202, … for further ones", "correct the value");
    food.dish = static_cast<int>(dish - scene.dishes.begin());
  }
  table.read("centre_mm", food.centre_mm, kPlaceMm);
  table.read("rotation_deg", food.rotation_deg, kAngleDeg);
}

LaidFood read_body(const JsonNode& node, const SceneDescription& scene) {
  const SceneTable table(node, {"body", "name", "dish", "centre_mm", "rotation_deg"});
  LaidFood food;
  food.body = node.member("body").text();
  if (find_proof_body(food.body) == nullptr) {
    std::string list;
    for (const ProofBody& known : proof_bodies())
      list += (list.empty() ? "one of " : ", ") + std::string(known.id);
    node.member("body").fail(list, "correct the value");
  }
  food.name = food.body;
  read_place(table, scene, food);
  return food;
}

LaidFood read_food(const JsonNode& node, const SceneDescription& scene, const std::filesystem::path& folder) {
  if (node.find("body")) return read_body(node, scene);
  const SceneTable table(node, {"kind", "name", "dish", "centre_mm", "rotation_deg", "size_mm", "seed",
                                "level_mm", "mesh", "scale_mm", "turn_deg"});
  LaidFood food;
  food.kind = node.member("kind").text();
  const FoodKind* kind = find_food_kind(food.kind);
  if (kind == nullptr) {
    std::string list;
    for (const FoodKind& known : food_kinds())
      list += (list.empty() ? "one of " : ", ") + std::string(known.name);
    node.member("kind").fail(list, "correct the value");
  }
  food.name = food.kind;
  read_place(table, scene, food);
  table.read("seed", food.seed);
  std::array<double, 3> size_mm = {kind->size.length_mm, kind->size.width_mm, kind->size.height_mm};
  table.read("size_mm", size_mm, {1.0, 400.0});
  food.size = {size_mm[0], size_mm[1], size_mm[2]};
  if (const auto mesh = table.find("mesh")) {
    ScannedFood scan;
    scan.file = folder / mesh->text();
    table.read("scale_mm", scan.scale_mm, {1e-6, 1e6});
    table.read("turn_deg", scan.turn_deg, kAngleDeg);
    food.scan = scan;
  } else if (kind->is_filled()) {
    const DishDescription& dish = scene.dishes[static_cast<std::size_t>(food.dish)].dish;
    food.level_mm = node.member("level_mm").number({dish.bottom_height_mm + 0.5, dish.rim_height_mm - 0.5});
  }
  return food;
}

void read_card(const JsonNode& node, const std::filesystem::path& folder, LaidCard& card) {
  const SceneTable table(node, {"width_mm", "height_mm", "thickness_mm", "centre_mm", "rotation_deg",
                                "design", "print", "tilt_deg", "curl_mm"});
  table.read("width_mm", card.width_mm, {20.0, 300.0});
  table.read("height_mm", card.height_mm, {20.0, 300.0});
  table.read("thickness_mm", card.thickness_mm, {0.05, 10.0});
  table.read("centre_mm", card.centre_mm, kPlaceMm);
  table.read("rotation_deg", card.rotation_deg, kAngleDeg);
  table.read("design", card.design);
  table.read("tilt_deg", card.tilt_deg, {0.0, 30.0});
  table.read("curl_mm", card.curl_mm, {0.0, 30.0});
  if (const auto print = table.find("print")) card.print = folder / print->text();
}

Displacement read_displacement(const JsonNode& node) {
  const SceneTable table(node, {"label", "shift_mm", "turn_deg"});
  Displacement displacement;
  displacement.label = static_cast<std::uint8_t>(node.member("label").integer(1, 255));
  table.read("shift_mm", displacement.shift_mm, kPlaceMm);
  table.read("turn_deg", displacement.turn_deg, kAngleDeg);
  return displacement;
}

Photograph read_view(const JsonNode& node) {
  const SceneTable table(node, {"target_mm", "distance_mm", "tilt_deg", "azimuth_deg", "roll_deg", "exposure",
                                "white_balance", "focus_error_mm", "motion_mm", "motion_deg", "arm_angle_deg",
                                "tray_shift_mm", "tray_turn_deg", "displaced"});
  Photograph view;
  table.read("target_mm", view.target_mm, kPlaceMm);
  table.read("distance_mm", view.distance_mm, {50.0, 5000.0});
  table.read("tilt_deg", view.tilt_deg, {0.0, 89.0});
  table.read("azimuth_deg", view.azimuth_deg, kAngleDeg);
  table.read("roll_deg", view.roll_deg, kAngleDeg);
  table.read("exposure", view.exposure, {0.01, 100.0});
  table.read("white_balance", view.white_balance, {0.1, 10.0});
  table.read("focus_error_mm", view.focus_error_mm, {-300.0, 300.0});
  table.read("motion_mm", view.motion_mm, {-100.0, 100.0});
  table.read("motion_deg", view.motion_deg, {-20.0, 20.0});
  table.read("tray_shift_mm", view.tray_shift_mm, kPlaceMm);
  table.read("tray_turn_deg", view.tray_turn_deg, kAngleDeg);
  if (const auto nodes = table.find("displaced")) {
    for (const JsonNode& entry : nodes->elements(1, kMaxDisplacements))
      view.displaced.push_back(read_displacement(entry));
  }
  if (const auto angle = table.find("arm_angle_deg")) view.arm_angle_deg = angle->number(kAngleDeg);
  return view;
}

void read_surroundings(const SceneTable& root, SceneDescription& scene) {
  if (const auto node = root.find("table")) {
    const SceneTable table(*node, {"surface", "rotation_deg", "seed"});
    table.read_choice("surface", scene.table.kind, surface_kind_names());
    table.read("rotation_deg", scene.table.rotation_deg, kAngleDeg);
    table.read("seed", scene.table.seed);
  }
  if (const auto node = root.find("tray")) {
    const SceneTable table(*node, {"size_mm", "surface", "seed"});
    scene.tray.emplace();
    table.read("size_mm", scene.tray->size_mm, {120.0, 1000.0});
    table.read_choice("surface", scene.tray->kind, surface_kind_names());
    table.read("seed", scene.tray->seed);
  }
  if (const auto nodes = root.find("utensils")) {
    for (const JsonNode& node : nodes->elements(0, 50)) {
      const SceneTable table(node, {"kind", "centre_mm", "rotation_deg", "base_mm", "colour"});
      Utensil utensil;
      node.member("kind");
      table.read_choice("kind", utensil.kind, kUtensilNames);
      table.read("centre_mm", utensil.centre_mm, kPlaceMm);
      table.read("rotation_deg", utensil.rotation_deg, kAngleDeg);
      table.read("base_mm", utensil.base_mm, {0.0, 100.0});
      table.read_colour("colour", utensil.srgb);
      scene.utensils.push_back(utensil);
    }
  }
  constexpr NumberRange kLampMm{-20000.0, 20000.0};
  if (const auto nodes = root.find("lamps")) {
    for (const JsonNode& node : nodes->elements(1, 50)) {
      const SceneTable table(node, {"centre_mm", "edge_u_mm", "edge_v_mm", "radiance"});
      Lamp lamp;
      table.read("centre_mm", lamp.centre_mm, kLampMm);
      table.read("edge_u_mm", lamp.edge_u_mm, kLampMm);
      table.read("edge_v_mm", lamp.edge_v_mm, kLampMm);
      table.read("radiance", lamp.radiance, {0.0, 1e4});
      scene.lamps.push_back(lamp);
    }
  } else {
    scene.lamps.emplace_back();
  }
  root.read("ambient", scene.ambient, {0.0, 1e4});
}

void read_pairs(const SceneTable& root, SceneDescription& scene) {
  const int last = static_cast<int>(scene.views.size()) - 1;
  const auto nodes = root.find("pairs");
  if (!nodes) {
    if (last > 0) scene.pairs = {{0, 1}};
    return;
  }
  for (const JsonNode& pair : nodes->elements(1, 1000)) {
    const std::vector<JsonNode> views = pair.elements(2, 2);
    scene.pairs.push_back({views[0].integer(0, last), views[1].integer(0, last)});
  }
}

}  // namespace

SceneDescription read_scene_file(const std::filesystem::path& file) {
  const JsonDocument document = read_toml(file, kMaxSceneBytes, "a scene in TOML");
  const std::filesystem::path folder = file.parent_path();
  const JsonNode node = document.root();
  const SceneTable root(node, {"name", "seed", "camera", "dishes", "foods", "card", "table", "tray",
                               "utensils", "lamps", "ambient", "views", "pairs"});
  SceneDescription scene;
  scene.origin = "file " + document.dump();
  scene.name = file.stem().string();
  if (const auto name = root.find("name")) scene.name = name->text();
  if (scene.name.find('/') != std::string::npos || scene.name.starts_with('.'))
    node.member("name").fail("a name that can be a folder's", "leave out slashes");
  root.read("seed", scene.seed);
  read_camera(node.member("camera"), scene.photography);
  for (const JsonNode& dish : node.member("dishes").elements(1, kMaxDishes))
    scene.dishes.push_back(read_laid_dish(dish, folder, scene.dishes.size()));
  if (const auto foods = root.find("foods")) {
    for (const JsonNode& food : foods->elements(0, kMaxFoods))
      scene.foods.push_back(read_food(food, scene, folder));
  }
  if (const auto card = root.find("card")) read_card(*card, folder, scene.card);
  read_surroundings(root, scene);
  for (const JsonNode& view : node.member("views").elements(1, kMaxViews))
    scene.views.push_back(read_view(view));
  read_pairs(root, scene);
  return scene;
}

}  // namespace traygauge
