// Everything that a measurement depends on beside the pictures.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/status.hpp"
#include "core/features/surf.hpp"
#include "core/image/camera.hpp"
#include "core/image/exposure.hpp"
#include "core/image_view/image_view.hpp"
#include "core/matching/matcher.hpp"
#include "core/pose/relative_pose.hpp"
#include "core/rectification/polar_rectification.hpp"
#include "core/scale/card.hpp"
#include "core/stereo/stereo.hpp"
#include "core/surface/food_mesh.hpp"

namespace traygauge {

// Caps that size the memory. An input that exceeds one keeps its best part, and the result says so.
struct EstimatorLimits {
  int max_frame_width = 1600;
  int max_frame_height = 1200;
  int max_keypoints = 3000;  // per view
  int max_pattern_keypoints = 1500;
};

// The reference card. The pattern is its printed side as a grey picture, filling width × height.
struct CardModel {
  double width_mm = 85.60;  // ISO/IEC 7810 ID-1
  double height_mm = 53.98;
  double thickness_mm = 0.8;  // the print lies that much above the table
  ImageView<const std::uint8_t> pattern;
};

// A dish, heights above the table.
struct DishModel {
  std::array<double, 2> outer_size_mm{};  // of the rim's ellipse; equal when round
  double rim_height_mm = 0.0;
  double bottom_height_mm = 0.0;
};

struct Configuration {
  LensModel lens;
  CardModel card;
  std::span<const DishModel> dishes;  // one: it is that; several: the nearest by rim size and height
  EstimatorLimits limits;
  SurfParams surf;
  MatcherParams matcher;
  RelativePoseParams pose;
  StereoParams stereo;
  FoodMeshParams mesh;
};

// invalid_configuration when a value lies outside its range.
Status validate(const Configuration& configuration);

}  // namespace traygauge
