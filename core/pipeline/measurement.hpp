// What a measurement yields.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/status.hpp"
#include "core/dish/dish_model.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/labels/label_regions.hpp"
#include "core/quality/check.hpp"
#include "core/quality/view_checks.hpp"
#include "core/quality/warning.hpp"
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

// One food item. Numbers hold only when status is ok; `dish` is the label of the dish that it lies on, or of
// a place of the tray.
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

struct Measurement;

inline constexpr std::size_t kMaxItems = kLastItemLabel - kFirstItemLabel + 1;

// True when at least one item was measured.
bool is_measured(Status status);
bool is_measured(const Measurement& measurement);

// ok when all items are, partial when some are, else the first one's status.
Status summarise(std::span<const ItemResult> items);

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
  double rim_rms_px = 0.0;     // of the outlines' points on the rim
  double rim_inlier_fraction = 0.0;
  int dish_index = -1;  // among the candidates of the configuration
  int rectified_rows = 0;
  int rectified_columns = 0;
  DisparityRange disparity_range;
  double matched_fraction = 0.0;  // of the dish's pixels that got a depth
  PictureReport pictures;
  double label_agreement = 0.0;  // share of the food whose label the other view confirms
};

inline constexpr std::size_t kMaxMeasuredSurfaces = kMaxPlacedDishes + kMaxTrayPlaces;

// What was measured on one dish or place of the tray, in the table frame.
struct MeasuredSurface {
  std::uint8_t dish = 1;  // its label
  HeightMap heights;
  InnerSurface inner;
};

// Surfaces of the last measurement, for drawing and for evaluation. Valid until the next one.
struct MeasurementViews {
  int reference_view = 0;  // 0 or 1: the view whose camera the planes are given in
  Plane dish_bottom;       // mm
  Plane table;
  TableCameras camera_from_table;  // frames as in table_frame.hpp
  std::span<const MeasuredSurface> surfaces;
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
  WarningSet warnings;
  CheckList checks;
  MeasurementReport report;
  MeasurementViews views;
};

}  // namespace traygauge
