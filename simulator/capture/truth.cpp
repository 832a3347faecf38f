#include "simulator/capture/truth.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <system_error>

#include "simulator/capture/dish_description.hpp"
#include "simulator/capture/json_file.hpp"
#include "simulator/capture/json_node.hpp"

namespace traygauge {
namespace {

constexpr NumberRange kVolumeMl{0.0, 1e5};
constexpr NumberRange kPoseEntry{-1e6, 1e6};
constexpr NumberRange kLengthMm{-1e5, 1e5};
constexpr NumberRange kAngleDeg{-360.0, 360.0};
constexpr double kRotationTolerance = 1e-3;
constexpr std::size_t kMaxPoses = 1000;
constexpr std::size_t kMaxItems = 198;

std::optional<double> read_volume(const JsonNode& item, const char* name) {
  const auto node = item.find(name);
  return node ? std::optional(node->number(kVolumeMl)) : std::nullopt;
}

TruthItem read_item(const JsonNode& node) {
  TruthItem item;
  item.label = node.member("label").integer(2, 199);
  item.name = node.member("name").text();
  item.volume_ml = node.member("volume_ml").number(kVolumeMl);
  if (const auto kind = node.find("kind")) {
    item.kind = kind->text();
    if (item.kind != "heightfield" && item.kind != "scan")
      kind->fail(R"("heightfield" or "scan")", "correct it");
  }
  item.volume_above_bottom_plane_ml = read_volume(node, "volume_above_bottom_plane_ml");
  item.column_volume_ml = read_volume(node, "column_volume_ml");
  return item;
}

TruthDish read_dish_place(const JsonNode& node) {
  TruthDish dish;
  dish.label = node.member("label").integer(1, 249);
  const std::vector<double> centre = node.member("centre_mm").numbers(3, kLengthMm);
  dish.centre_mm = {centre[0], centre[1]};
  if (const auto rotation = node.find("rotation_deg")) dish.rotation_deg = rotation->number(kAngleDeg);
  return dish;
}

bool is_rigid(const WorldToCamera& pose) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double dot = 0.0;
      for (std::size_t k = 0; k < 3; ++k) dot += pose[i][k] * pose[j][k];
      if (std::abs(dot - (i == j ? 1.0 : 0.0)) > kRotationTolerance) return false;
    }
  }
  return pose[3] == std::array{0.0, 0.0, 0.0, 1.0};
}

WorldToCamera read_pose(const JsonNode& node) {
  WorldToCamera pose{};
  const std::vector<JsonNode> rows = node.elements(4, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::vector<double> row = rows[i].numbers(4, kPoseEntry);
    std::copy(row.begin(), row.end(), pose[i].begin());
  }
  if (!is_rigid(pose))
    node.fail("a rigid motion (4x4, last row 0 0 0 1)", "store rotation and translation in mm");
  return pose;
}

}  // namespace

std::optional<Truth> read_truth(const std::filesystem::path& capture_folder) {
  const std::filesystem::path file = capture_folder / "truth.json";
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return std::nullopt;
  const JsonDocument document = read_json(file);
  const JsonNode root = document.root();
  Truth truth;
  for (const JsonNode& node : root.member("items").elements(0, kMaxItems))
    truth.items.push_back(read_item(node));
  if (const auto dishes = root.find("dishes")) {
    for (const JsonNode& node : dishes->elements(0, kMaxDishes))
      truth.dishes.push_back(read_dish_place(node));
  }
  for (const JsonNode& node : root.member("poses").elements(0, kMaxPoses))
    truth.poses.push_back(read_pose(node));
  return truth;
}

}  // namespace traygauge
