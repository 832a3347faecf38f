#include "simulator/scenes/scene_digest.hpp"

#include <concepts>
#include <sstream>
#include <type_traits>

#include "simulator/capture/content_hash.hpp"
#include "simulator/capture/picture_file.hpp"
#include "simulator/scenes/mesh_reader.hpp"

namespace traygauge {
namespace {

// Raised when the same description comes to give other pictures or another truth.
constexpr int kGeneratorVersion = 5;

// One description as text. Each structure is taken apart whole, so that a new member does not compile until
// it is written here.
class Digest {
 public:
  // Less than a double holds: another machine's sine may differ in its last digit.
  Digest() { text_.precision(12); }
  std::string hash() const { return content_hash(text_.str()); }

  template <class... Values>
  void add(const Values&... values) {
    (write(values), ...);
    text_ << '\n';
  }

 private:
  template <class Value>
  requires std::is_arithmetic_v<Value>
  void write(Value value) { text_ << +value << ' '; }
  template <class Value>
  requires std::is_enum_v<Value>
  void write(Value value) { write(static_cast<std::underlying_type_t<Value>>(value)); }
  void write(const std::string& value) { text_ << value.size() << ':' << value << ' '; }
  template <class Value, std::size_t kCount>
  void write(const std::array<Value, kCount>& values) {
    for (const Value& value : values) write(value);
  }
  template <int kRows>
  void write(const Eigen::Matrix<double, kRows, 1>& values) {
    for (const double value : values) write(value);
  }
  template <class Value>
  void write(const std::vector<Value>& values) {
    write(values.size());
    for (const Value& value : values) write(value);
  }
  template <class Value>
  void write(const std::optional<Value>& value) {
    write(value.has_value());
    if (value) write(*value);
  }

  void write(const ProfilePoint& point) {
    const auto& [inset_mm, height_mm] = point;
    add(inset_mm, height_mm);
  }
  void write(const DishDescription& dish) {
    const auto& [label, style, outer_size_mm, rim_height_mm, bottom_height_mm, profile] = dish;
    add(label, style, outer_size_mm, rim_height_mm, bottom_height_mm, profile);
  }
  void write(const RimLine& line) {
    const auto& [inset_mm, width_mm] = line;
    add(inset_mm, width_mm);
  }
  void write(const Glaze& glaze) {
    const auto& [srgb, roughness, decoration_srgb, lines, speck_fraction, pattern, finish] = glaze;
    add(srgb, roughness, decoration_srgb, lines, speck_fraction);
    // Captures of plain glaze keep the digest that they have.
    if (pattern != GlazePattern::none || finish != GlazeFinish::glazed) add(pattern, finish);
  }
  void write(const LaidDish& laid) {
    const auto& [dish, centre_mm, rotation_deg, glaze, seed, is_ground] = laid;
    add(dish, centre_mm, rotation_deg, glaze, seed);
    // Captures whose foods all lie on dishes keep the digest that they have.
    if (is_ground) add(is_ground);
  }
  void write(const ScannedFood& scan) {
    const auto& [file, scale_mm, turn_deg] = scan;
    add(content_hash(read_mesh_bytes({file, ""})), scale_mm, turn_deg);
  }
  void write(const FoodSize& size) {
    const auto& [length_mm, width_mm, height_mm] = size;
    add(length_mm, width_mm, height_mm);
  }
  void write(const LaidFood& food) {
    const auto& [name, kind, dish, centre_mm, rotation_deg, size, seed, level_mm, scan, body] = food;
    add(name, kind, dish, centre_mm, rotation_deg, size, seed, level_mm, scan);
    // Captures without a proof body keep the digest that they have.
    if (!body.empty()) add(body);
  }
  void write(const LaidCard& card) {
    const auto& [width_mm, height_mm, thickness_mm, centre_mm, rotation_deg, design, print, tilt_deg,
                 curl_mm] = card;
    add(width_mm, height_mm, thickness_mm, centre_mm, rotation_deg, design);
    // Captures whose card has a design and lies flat keep the digest that they have.
    if (!print.empty()) add(content_hash(to_gray(read_picture({print, ""})).pixels));
    if (tilt_deg != 0.0 || curl_mm != 0.0) add(tilt_deg, curl_mm);
  }
  void write(const Table& table) {
    const auto& [kind, rotation_deg, seed] = table;
    add(kind, rotation_deg, seed);
  }
  void write(const Tray& tray) {
    const auto& [size_mm, kind, seed] = tray;
    add(size_mm, kind, seed);
  }
  void write(const Utensil& utensil) {
    const auto& [kind, centre_mm, rotation_deg, base_mm, srgb] = utensil;
    add(kind, centre_mm, rotation_deg, base_mm, srgb);
  }
  void write(const Thing& thing) {
    const auto& [kind, centre_mm, rotation_deg, base_mm, srgb, second_srgb, seed] = thing;
    add(kind, centre_mm, rotation_deg, base_mm, srgb, second_srgb, seed);
  }
  void write(const Lamp& lamp) {
    const auto& [centre_mm, edge_u_mm, edge_v_mm, radiance] = lamp;
    add(centre_mm, edge_u_mm, edge_v_mm, radiance);
  }
  void write(const Photograph& view) {
    const auto& [target_mm, distance_mm, tilt_deg, azimuth_deg, roll_deg, exposure, white_balance,
                 focus_error_mm, motion_mm, motion_deg, arm_angle_deg, tray_shift_mm, tray_turn_deg,
                 displaced] = view;
    add(target_mm, distance_mm, tilt_deg, azimuth_deg, roll_deg, exposure, white_balance, focus_error_mm,
        motion_mm, motion_deg, tray_shift_mm, tray_turn_deg);
    // Captures in which nothing moved keep the digest that they have.
    if (!displaced.empty()) add(displaced);
  }
  void write(const Displacement& displacement) {
    const auto& [label, shift_mm, turn_deg] = displacement;
    add(label, shift_mm, turn_deg);
  }
  void write(const PictureSize& size) {
    const auto& [width, height] = size;
    add(width, height);
  }
  void write(const CameraDescription& camera) {
    const auto& [size, fx_px, fy_px, cx_px, cy_px, distortion, further_distortion] = camera;
    add(size, fx_px, fy_px, cx_px, cy_px, distortion);  // the renderer draws no further one
  }
  void write(const PhotographySettings& settings) {
    const auto& [camera, aperture_mm, corner_loss, full_well_electrons, read_noise_electrons, jpeg_quality] =
        settings;
    add(camera, aperture_mm, corner_loss, full_well_electrons, read_noise_electrons, jpeg_quality);
  }

  std::ostringstream text_;
};

}  // namespace

std::string digest_of(const SceneDescription& scene, const RenderSettings& settings) {
  Digest digest;
  const auto& [name, origin, seed, dishes, foods, food_step_mm, card, table, tray, utensils, things, lamps,
               ambient, photography, views, pairs] = scene;
  digest.add(seed, dishes, foods, card, table, tray, utensils, lamps, ambient, photography, views, pairs);
  // Captures without things and on the usual grid keep the digest that they have.
  if (!things.empty()) digest.add(things);
  if (food_step_mm != SceneDescription().food_step_mm) digest.add(food_step_mm);
  const auto& [samples, edge_samples, calm_spread, indirect_samples, penumbra_samples, bounces,
               indirect_filter_px, threads, settings_seed, view] = settings;
  digest.add(samples, edge_samples, calm_spread, indirect_samples, penumbra_samples, bounces,
             indirect_filter_px);
  return "generator " + std::to_string(kGeneratorVersion) + ", description " + digest.hash();
}

}  // namespace traygauge
