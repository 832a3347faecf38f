#include "simulator/capture/capture.hpp"

#include <algorithm>
#include <cstddef>
#include <system_error>

#include "simulator/capture/json_file.hpp"
#include "simulator/capture/json_node.hpp"
#include "simulator/capture/label_specks.hpp"
#include "simulator/capture/picture_file.hpp"

namespace traygauge {
namespace {

constexpr int kVersion = 1;
constexpr double kMaxFocalPx = 1e6;
constexpr NumberRange kDistortion{-1e3, 1e3};
constexpr NumberRange kCardSizeMm{10.0, 500.0};
constexpr NumberRange kCardThicknessMm{0.0, 10.0};
constexpr NumberRange kArmAngleDeg{-360.0, 360.0};
constexpr std::size_t kMaxViews = 1000;
constexpr std::size_t kMaxPairs = 100000;

// A file that the capture names. It must lie inside the folder; a link there is its owner's decision.
InputFile read_file_name(const JsonNode& node, const std::filesystem::path& folder) {
  const std::filesystem::path name = node.text();
  const bool climbs = std::find(name.begin(), name.end(), "..") != name.end();
  if (name.is_absolute() || climbs || name.native().find('\0') != std::string::npos) {
    node.fail("a file inside the capture's folder", "name it relative to that folder, without '..'");
  }
  return {folder / name, node.key()};
}

CameraDescription read_camera(const JsonNode& node) {
  CameraDescription camera;
  camera.size.width = node.member("width").integer(kMinPictureSide, kMaxPictureSide);
  camera.size.height = node.member("height").integer(kMinPictureSide, kMaxPictureSide);
  camera.fx_px = node.member("fx").positive_number(kMaxFocalPx);
  camera.fy_px = node.member("fy").positive_number(kMaxFocalPx);
  camera.cx_px = node.member("cx").number({0.0, camera.size.width - 1.0});
  camera.cy_px = node.member("cy").number({0.0, camera.size.height - 1.0});
  const std::vector<double> distortion = node.member("distortion").numbers(5, kDistortion);
  std::copy(distortion.begin(), distortion.end(), camera.distortion.begin());
  return camera;
}

CardDescription read_card(const JsonNode& node, const std::filesystem::path& folder) {
  CardDescription card;
  card.pattern = read_file_name(node.member("pattern"), folder);
  card.width_mm = node.member("width_mm").number(kCardSizeMm);
  card.height_mm = node.member("height_mm").number(kCardSizeMm);
  card.thickness_mm = node.member("thickness_mm").number(kCardThicknessMm);
  return card;
}

void require_new_label(const std::vector<DishDescription>& dishes, const JsonNode& node, int label) {
  for (const DishDescription& dish : dishes) {
    if (dish.label == label) node.fail("a label that no other dish has", "give every dish its own");
  }
}

std::vector<DishDescription> read_dishes(const JsonNode& root) {
  const auto one = root.find("dish");
  const auto several = root.find("dishes");
  if (one && several) several->fail("either dish or dishes", "remove one of the two");
  std::vector<DishDescription> dishes;
  if (one) dishes.push_back(read_dish(*one));
  if (!several) return dishes;
  for (const JsonNode& node : several->elements(1, kMaxDishes)) {
    DishDescription dish = read_dish(node);
    const JsonNode label = node.member("label");
    dish.label = label.integer(1, 249);
    if (dish.label > 1 && dish.label < 201) label.fail("1 or 201 to 249", "2 to 199 are food");
    require_new_label(dishes, label, dish.label);
    dishes.push_back(std::move(dish));
  }
  return dishes;
}

std::vector<ViewDescription> read_views(const JsonNode& root, const std::filesystem::path& folder) {
  std::vector<ViewDescription> views;
  for (const JsonNode& node : root.member("views").elements(1, kMaxViews)) {
    ViewDescription view;
    view.image = read_file_name(node.member("image"), folder);
    if (const auto labels = node.find("labels")) view.labels = read_file_name(*labels, folder);
    if (const auto angle = node.find("arm_angle_deg")) view.arm_angle_deg = angle->number(kArmAngleDeg);
    const auto own = node.find("camera");
    const JsonNode camera = own ? *own : root.member("camera");
    view.camera = read_camera(camera);
    view.camera_key = camera.key();
    views.push_back(std::move(view));
  }
  return views;
}

std::vector<std::array<int, 2>> read_pairs(const JsonNode& root, std::size_t views) {
  std::vector<std::array<int, 2>> pairs;
  const auto list = root.find("pairs");
  if (!list) return pairs;
  const int last = static_cast<int>(views) - 1;
  for (const JsonNode& node : list->elements(0, kMaxPairs)) {
    const std::vector<JsonNode> pair = node.elements(2, 2);
    pairs.push_back({pair[0].integer(0, last), pair[1].integer(0, last)});
  }
  return pairs;
}

}  // namespace

Capture read_capture(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    throw InputError({folder, ""}, "the folder of a capture", error ? error.message() : "no folder",
                     "name a folder that holds capture.json");
  }
  Capture capture;
  capture.file = folder / "capture.json";
  const JsonDocument document = read_json(capture.file);
  const JsonNode root = document.root();
  root.member("version").integer(kVersion, kVersion);
  if (const auto camera = root.find("camera")) read_camera(*camera);
  capture.card = read_card(root.member("card"), folder);
  capture.dishes = read_dishes(root);
  capture.views = read_views(root, folder);
  capture.pairs = read_pairs(root, capture.views.size());
  return capture;
}

LoadedView load_view(const ViewDescription& view) {
  LoadedView loaded;
  loaded.picture = read_picture(view.image, view.camera.size);
  if (view.labels) {
    loaded.labels = read_label_picture(*view.labels, view.camera.size);
    ignore_specks(*view.labels, loaded.labels, loaded.warnings);
  }
  return loaded;
}

Picture load_pattern(const CardDescription& card) {
  return to_gray(read_picture(card.pattern));
}

}  // namespace traygauge
