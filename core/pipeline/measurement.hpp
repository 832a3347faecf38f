// What a measurement yields.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/status.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/image_view/image_view.hpp"
#include "core/paper/surface/food_mesh.hpp"
#include "core/stereo/disparity.hpp"
#include "core/volume/height_map.hpp"

namespace traygauge {

// Stages whose time is reported, in the order in which they run.
enum class Stage : std::uint8_t {
  image,
  features,
  matching,
  pose,
  scale,
  rectification,
  stereo,
  surface,
  volume,
};
inline constexpr std::size_t kStageCount = static_cast<std::size_t>(Stage::volume) + 1;
const char* name(Stage stage);

// Doubts that do not stop a measurement.
enum class Warning : std::uint8_t {
  angle_small,          // relative angle below 10 degrees: depth is noisy
  angle_large,          // above 30 degrees: matching gets hard
  keypoints_capped,     // most were left out
  matches_capped,       // more corresponding points than memory was reserved for
  few_card_points,      // scale rests on few points
  dish_guessed,         // the dish was chosen from several candidates
  arm_angle_disagrees,  // measured and commanded relative angle differ
  pose_from_card,       // the scene's motion was replaced by the card's
  blurred,
  underexposed,
  card_partly_hidden,
  food_clipped,
  little_texture,
  exposure_differs,
  white_balance_differs,
  item_hardly_matched,  // large parts of an item were found in one view only
  dish_not_found,       // labels drawn: one of several dishes; its food is not measured
  item_uncertain,       // an item's sigma is large beside its volume
  items_doubtful,       // labels drawn: whether two items are one food, or their number is not the one given
};
inline constexpr std::size_t kWarningCount = static_cast<std::size_t>(Warning::items_doubtful) + 1;
const char* name(Warning warning);
const char* sentence(Warning warning);

// One food item. Numbers hold only when status is ok; `dish` is the label of the dish that it lies on.
struct ItemResult {
  std::uint8_t label = 0;
  std::uint8_t dish = 1;
  StatusCode status = StatusCode::ok;
  double volume_ml = 0.0;         // overhang of round items included
  double column_volume_ml = 0.0;  // what lies under the upper surface
  double sigma_ml = 0.0;          // standard deviation of volume_ml; 0 where the profile estimates none
  double area_mm2 = 0.0;
  double mean_height_mm = 0.0;
  double max_height_mm = 0.0;
};

inline constexpr std::size_t kMaxItems = 198;  // labels 2…199

// ok when all items are, partial when some are, else the first one's status.
Status summarise(std::span<const ItemResult> items);

// What the pictures are like; see core/quality/view_checks.hpp.
struct PictureReport {
  std::array<double, 2> blur_px{};
  std::array<double, 2> visible_card_share{};
  std::array<int, 2> card_white{};
  double exposure_ratio = 1.0;
  double white_balance_ratio = 1.0;
  double most_clipped_share = 0.0;    // of an item
  double least_textured_share = 1.0;  // of an item
};

// How far the measurement came; the numbers of stages that were not reached are zero.
struct MeasurementReport {
  std::array<int, 2> keypoints_found{};
  std::array<int, 2> keypoints{};  // the strongest of them
  int corners = 0;                 // that were looked for in the other view
  int matches = 0;
  int inliers = 0;
  double inlier_threshold_px = 0.0;
  int pose_iterations = 0;
  int card_tracks = 0;
  double mm_per_baseline = 0.0;
  int rim_points = 0;
  double rim_height_mm = 0.0;  // measured, above the table
  double rim_rms_px = 0.0;     // profile best: of the outlines' points on the rim
  double rim_inlier_share = 0.0;
  int dish_index = -1;  // among the candidates of the configuration
  int rectified_rows = 0;
  int rectified_columns = 0;
  DisparityRange disparity_range;
  double matched_share = 0.0;  // of the dish's pixels that got a depth
  PictureReport pictures;
  double label_agreement = 0.0;  // share of the food whose label the other view confirms
};

// What was measured on one dish, in the table frame.
struct MeasuredSurface {
  std::uint8_t dish = 1;  // its label
  HeightMap heights;
  InnerSurface inner;
};

// Pictures and surfaces of the last measurement, for drawing and for evaluation. Valid until the next one.
struct MeasurementViews {
  std::array<PinholeCamera, 2> cameras;               // of the working pictures
  std::array<ImageView<const std::uint8_t>, 2> gray;  // undistorted, dish resized
  std::array<ImageView<const std::uint8_t>, 2> labels;
  std::array<ImageView<const std::uint8_t>, 2> rectified;
  ImageView<const Disparity> disparity;
  ImageView<const float> depth_mm;  // of the reference view, along its axis; NaN where unknown
  FoodMesh mesh;                    // in the reference camera, mm
  int reference_view = 0;           // 0 or 1: the view that depth and mesh belong to
  Plane dish_bottom;                // in the reference camera, mm
  Plane table;
  TableCameras camera_from_table;             // profile best; frames as in table_frame.hpp
  std::span<const MeasuredSurface> surfaces;  // profile best: one a dish
};

struct Measurement {
  Status status;
  std::span<const ItemResult> items;
  bool has_pose = false;
  Pose second_from_first;           // mm
  double relative_angle_deg = 0.0;  // between the lines of sight, at the dish
  double rotation_angle_deg = 0.0;  // of the camera
  std::array<double, kStageCount> stage_ms{};
  double segmentation_ms = 0.0;  // before the stages, where labels were drawn; part of the total
  double total_ms = 0.0;
  std::array<bool, kWarningCount> warnings{};
  MeasurementReport report;
  MeasurementViews views;

  void warn(Warning warning, bool on) { warnings[static_cast<std::size_t>(warning)] = on; }
};

}  // namespace traygauge
