// A scene as plain data: what stands where, under which light, and how it is photographed.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "simulator/capture/capture.hpp"
#include "simulator/scenes/food_shapes.hpp"
#include "simulator/scenes/surface_material.hpp"

namespace traygauge {

// World: mm, z up; z = 0 is what dishes and card stand on, the tray's floor where there is a tray, else the
// table. Rotations are about z, from x towards y.

struct LaidDish {
  DishDescription dish;
  Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();
  double rotation_deg = 0.0;
  Glaze glaze;
  std::uint64_t seed = 1;
  bool is_ground = false;  // no dish: where food lies on the tray; nothing is drawn or described
};

// A mesh of a scanned food, from a file.
struct ScannedFood {
  std::filesystem::path file;        // OBJ or PLY
  double scale_mm = 1.0;             // length of the file's unit
  std::array<double, 3> turn_deg{};  // about x, then y, then z, before it is set down
};

struct LaidFood {
  std::string name;  // in truth.json
  std::string kind;  // of food_kinds(); of a scanned one: whose textures it has
  int dish = 0;      // index of the dish
  Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();  // in the dish's coordinates
  double rotation_deg = 0.0;
  FoodSize size;  // of filled food: no matter
  std::uint64_t seed = 1;
  double level_mm = 0.0;  // of filled food, above what the dish stands on
  std::optional<ScannedFood> scan;
  std::string body;  // the id of a proof body, which lies there instead of a food; empty: a food
};

struct LaidCard {
  double width_mm = 85.60;  // ISO/IEC 7810 ID-1
  double height_mm = 53.98;
  double thickness_mm = 0.8;
  Eigen::Vector2d centre_mm = Eigen::Vector2d(170.0, 0.0);
  double rotation_deg = 0.0;  // of the print's width
  std::uint64_t design = 1;
  std::filesystem::path print;  // a picture of the printed side, instead of a design; may be empty
  double tilt_deg = 0.0;        // it stands on its lower long edge and leans on something
  double curl_mm = 0.0;         // its right edge is bent up so far, as a parabola
};

struct Table {
  SurfaceKind kind = SurfaceKind::wood;
  double rotation_deg = 0.0;
  std::uint64_t seed = 1;
};

struct Tray {
  std::array<double, 2> size_mm = {460.0, 340.0};
  SurfaceKind kind = SurfaceKind::plastic;
  std::uint64_t seed = 1;
};

enum class UtensilKind : std::uint8_t { fork, knife, spoon, napkin };

struct Utensil {
  UtensilKind kind = UtensilKind::fork;
  Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();
  double rotation_deg = 0.0;  // of its length
  double base_mm = 0.0;       // height of what it lies on
  std::uint32_t srgb = 0xC8C8C8;
};

enum class ThingKind : std::uint8_t { cup, hand, phone, wallet, keys, packet, napkin_with_roll };

// What lies about and is no dish: without a label, known by its TruthKind alone.
struct Thing {
  ThingKind kind = ThingKind::cup;
  Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();
  double rotation_deg = 0.0;
  double base_mm = 0.0;  // height of what it lies on
  std::uint32_t srgb = 0xC8C8C8;
  std::uint32_t second_srgb = 0x404040;  // of its drink, sleeve, screen, print or napkin
  std::uint64_t seed = 1;                // of its measures
};

// A rectangle that shines towards the table; edge_u and edge_v span it.
struct Lamp {
  Eigen::Vector3d centre_mm = Eigen::Vector3d(0.0, 0.0, 1800.0);
  Eigen::Vector3d edge_u_mm = Eigen::Vector3d(600.0, 0.0, 0.0);
  Eigen::Vector3d edge_v_mm = Eigen::Vector3d(0.0, 600.0, 0.0);
  Eigen::Vector3d radiance = Eigen::Vector3d::Constant(10.0);  // linear RGB
};

// What was touched between two pictures: a dish with its food, one food, or the card.
struct Displacement {
  std::uint8_t label = 0;  // the dish's, the food's (2, 3, … in their order) or the card's (255)
  Eigen::Vector2d shift_mm = Eigen::Vector2d::Zero();
  double turn_deg = 0.0;  // about the vertical through its middle
};

struct Photograph {
  Eigen::Vector3d target_mm = Eigen::Vector3d::Zero();  // in the middle of the picture
  double distance_mm = 500.0;                           // of the pupil from the target
  double tilt_deg = 0.0;                                // from the vertical
  double azimuth_deg = 0.0;                             // of the pupil, from x towards y
  double roll_deg = 0.0;                                // about the optical axis
  double exposure = 1.0;                                // beside that of the first view
  std::array<double, 2> white_balance = {1.0, 1.0};     // gains of red and blue
  double focus_error_mm = 0.0;
  // Of the camera while the shutter is open, in its own axes (OpenCV's): how far it goes, and the axis times
  // the angle by which it turns. All that is said of the view holds in the middle of the exposure.
  Eigen::Vector3d motion_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d motion_deg = Eigen::Vector3d::Zero();
  std::optional<double> arm_angle_deg;
  // Where the tray has moved since it was laid; the camera, the table and the lamps stay.
  Eigen::Vector2d tray_shift_mm = Eigen::Vector2d::Zero();
  double tray_turn_deg = 0.0;
  std::vector<Displacement> displaced;  // since the scene was laid, in this view alone
};

struct PhotographySettings {
  CameraDescription camera;
  double aperture_mm = 1.5;  // f/2.6 of a phone's 4 mm lens
  double corner_loss = 0.2;
  double full_well_electrons = 6000.0;
  double read_noise_electrons = 4.0;
  int jpeg_quality = 93;
};

struct SceneDescription {
  std::string name;
  // What the scene was made from, for people: a set and its seed, or the content of a file.
  std::string origin;
  std::uint64_t seed = 1;  // of the renderer's and the sensor's noise
  std::vector<LaidDish> dishes;
  std::vector<LaidFood> foods;
  double food_step_mm = 0.3;  // of the grid that foods are painted on and meshed from
  LaidCard card;
  Table table;
  std::optional<Tray> tray;
  std::vector<Utensil> utensils;
  std::vector<Thing> things;
  std::vector<Lamp> lamps;
  Eigen::Vector3d ambient = Eigen::Vector3d::Constant(0.25);
  PhotographySettings photography;
  std::vector<Photograph> views;
  std::vector<std::array<int, 2>> pairs;
};

}  // namespace traygauge
