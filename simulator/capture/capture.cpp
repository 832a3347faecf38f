#include "simulator/capture/capture.hpp"

#include <algorithm>
#include <cstddef>
#include <system_error>

#include "simulator/capture/calibration_file.hpp"
#include "simulator/capture/json_file.hpp"
#include "simulator/capture/json_node.hpp"
#include "simulator/capture/label_specks.hpp"
#include "simulator/capture/picture_file.hpp"
#include "simulator/capture/picture_header.hpp"

namespace traygauge {
namespace {

constexpr int kVersion = 1;
constexpr NumberRange kCentrePx{-1e5, 1e5};  // within the picture, once its size is sure
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

// A camera as it is given, and where.
struct GivenCamera {
  CameraDescription camera;
  InputFile place;
  std::string note;  // what was mended; mostly empty
};

PictureSize read_size(const JsonNode& node) {
  return {node.member("width").integer(kMinPictureSide, kMaxPictureSide),
          node.member("height").integer(kMinPictureSide, kMaxPictureSide)};
}

// "camera": a calibration file, or an object with "file", or one with the values.
GivenCamera read_camera(const JsonNode& node, const std::filesystem::path& folder) {
  GivenCamera given;
  given.place = {node.file(), node.key()};
  const auto file = node.is_object() ? node.find("file") : std::nullopt;
  if (node.is_text() || file) {
    given.place = read_file_name(file ? *file : node, folder);
    const bool has_size = node.is_object() && (node.find("width") || node.find("height"));
    given.camera =
        read_calibration_file(given.place, has_size ? std::optional(read_size(node)) : std::nullopt);
    given.place.key = "";
  } else {
    CameraDescription& camera = given.camera;
    camera.size = read_size(node);
    read_camera_values(node, kCentrePx, kCentrePx, camera);
  }
  mend_camera_scale(given.place, given.camera, given.note);
  check_camera(given.place, given.camera);
  return given;
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

// Pictures of another size that show the same are measured with the values scaled. Those of another aspect
// are refused when they are loaded.
void fit_camera(ViewDescription& view) {
  const std::optional<PictureHeader> header = peek_header(view.image.path);
  const PictureSize size = view.camera.size;
  if (!header || header->size == size || header->size.width < kMinPictureSide ||
      header->size.height < kMinPictureSide || !has_same_aspect(header->size, size)) {
    return;
  }
  view.warnings.push_back(
      {"camera_scaled", printable(view.camera_place.path.string()) + ": " +
                            (view.camera_place.key.empty() ? "" : view.camera_place.key + ": ") +
                            "the camera's values are for pictures of " + size_text(size) + ", " +
                            view.image.path.filename().string() + " has " + size_text(header->size) +
                            ": they are scaled; a camera that shows another part of the scene at that size " +
                            "needs a calibration of its own."});
  view.camera = scaled(view.camera, header->size);
}

// Names the camera first: pictures are seldom cut, calibrations often mixed up.
void require_camera_size(const ViewDescription& view, const std::optional<PictureHeader>& header) {
  if (!header || header->size == view.camera.size) return;
  const PictureSize turned{header->size.height, header->size.width};
  const std::string key = view.camera_place.key.empty() ? "width" : view.camera_place.key + ".width";
  const std::string name = printable(view.image.path.filename().string());
  const bool is_turned = header->is_shown_turned() && has_same_aspect(turned, view.camera.size);
  throw InputError({view.camera_place.path, key},
                   "a camera for pictures of " + size_text(header->size) + ", as " + name + " is stored",
                   size_text(view.camera.size),
                   is_turned ? "EXIF orientation " + std::to_string(header->orientation) +
                                   " has the picture shown turned: calibrate with pictures as they are stored"
                             : "calibrate the camera with pictures of this kind");
}

// Names the picture as well: either may be the one of a wrong size.
void require_label_size(const ViewDescription& view, const std::optional<PictureHeader>& header) {
  const std::optional<PictureHeader> labels = peek_header(view.labels->path);
  if (!header || !labels || labels->size == header->size) return;
  const std::string name = printable(view.image.path.filename().string());
  const bool is_turned =
      header->is_shown_turned() && labels->size == PictureSize{header->size.height, header->size.width};
  const std::string turn = ", as EXIF orientation " + std::to_string(header->orientation) + " has it shown";
  throw InputError(*view.labels, size_text(header->size) + " pixels, as " + name + " is stored",
                   size_text(labels->size) + " pixels" + (is_turned ? turn : ""),
                   is_turned ? "turn the labels back, or store the picture turned and without that tag"
                             : "outline the picture at the size that it has");
}

std::vector<ViewDescription> read_views(const JsonNode& root, const std::filesystem::path& folder) {
  std::vector<ViewDescription> views;
  for (const JsonNode& node : root.member("views").elements(1, kMaxViews)) {
    ViewDescription view;
    view.image = read_file_name(node.member("image"), folder);
    if (const auto labels = node.find("labels")) view.labels = read_file_name(*labels, folder);
    if (const auto angle = node.find("arm_angle_deg")) view.arm_angle_deg = angle->number(kArmAngleDeg);
    const auto own = node.find("camera");
    const GivenCamera camera = read_camera(own ? *own : root.member("camera"), folder);
    view.camera = camera.camera;
    view.camera_place = camera.place;
    if (!camera.note.empty()) view.warnings.push_back({"camera_scaled", camera.note});
    fit_camera(view);
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
  if (const auto camera = root.find("camera")) read_camera(*camera, folder);
  capture.card = read_card(root.member("card"), folder);
  capture.dishes = read_dishes(root);
  capture.views = read_views(root, folder);
  capture.pairs = read_pairs(root, capture.views.size());
  return capture;
}

LoadedView load_view(const ViewDescription& view) {
  LoadedView loaded;
  loaded.warnings = view.warnings;
  const std::optional<PictureHeader> header = peek_header(view.image.path);
  require_camera_size(view, header);
  loaded.picture = read_picture(view.image, view.camera.size, &loaded.warnings);
  if (view.labels) {
    require_label_size(view, header);
    loaded.labels = read_label_picture(*view.labels, view.camera.size);
    ignore_specks(*view.labels, loaded.labels, loaded.warnings);
  }
  return loaded;
}

Picture load_pattern(const CardDescription& card) {
  return to_gray(read_picture(card.pattern));
}

}  // namespace traygauge
