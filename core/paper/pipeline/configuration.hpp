// Everything that a measurement of profile `paper` depends on beside the pictures.
#pragma once

#include <cstdint>

#include "core/dish/rim_ellipse.hpp"
#include "core/paper/card/card_scale.hpp"
#include "core/paper/features/surf.hpp"
#include "core/paper/matching/matcher.hpp"
#include "core/paper/pipeline/label_agreement.hpp"
#include "core/paper/pose/relative_pose.hpp"
#include "core/paper/rectification/polar_rectification.hpp"
#include "core/paper/stereo/disparity_range.hpp"
#include "core/paper/stereo/stereo.hpp"
#include "core/paper/surface/dish_surface.hpp"
#include "core/paper/surface/food_mesh.hpp"
#include "core/paper/surface/rim.hpp"
#include "core/paper/volume/mesh_volume.hpp"
#include "core/pipeline/tray_setup.hpp"

namespace traygauge::paper {

// Caps that size the memory. An input that exceeds one keeps its best part, and the result says so.
struct Caps {
  int max_keypoints = 3000;      // per view
  int max_card_keypoints = 800;  // of those, kept for the card where it is labelled
  int max_pattern_keypoints = 1500;
  int max_feature_px = 1200 * 1000;  // area of the picture in which salient points are looked for
  int max_working_px =
      300 * 1000;  // of the picture for dense matching: 2^17 dish pixels, their box at any angle
  int max_working_side_px = 1024;  // its longer side
};

// The pictures that the stages work on.
struct ViewParams {
  double matching_dish_px = 131072.0;  // 2^17: area of the dish for dense matching (paper V-B)
  // Dense matching leaves the background out (paper V-B, region of interest); else the whole picture is
  // matched and needs memory for itself: max_working_px, max_working_side_px, the rectification's caps.
  bool match_dish_only = true;
  double working_margin_px = 6.0;  // around the dish: half of census and window
  double feature_dish_px =
      524288.0;  // 2^19: area of the dish where salient points are looked for; the card needs it
  // Scale at which the card and its pattern are searched for salient points. Views show the card with 2 to 4
  // px per mm, where the box filters find few; enlarging as in [14], 3.3 gives four times as many.
  double card_px_per_mm = 6.0;
  double max_card_enlargement = 3.0;  // of a view's picture of the card; more only blurs
  double max_card_rotation_deg =
      5.0;  // between the scene's motion and the card's own, which is sure to 1 or 2 degrees
  double min_card_pose_fitness = 0.8;  // eq. (1) of the card's motion over that of the scene's, to replace it
  double min_kept_keypoint_fraction = 1.0 / 3.0;  // of the salient points found; fewer: warning
  int min_keypoints = 50;                         // fewer: too_few_features
  double min_matched_fraction = 0.5;              // of the dish with a depth; less: too_little_depth
};

// When an item counts as measured.
struct VolumeExtractionParams {
  int min_item_px = 64;               // of the working picture, about 25 mm²: some 2 mesh points
  double min_covered_fraction = 0.5;  // of the item's pixels under triangles; the rest has no depth
};

// Outlines of the wrong view give a rim that no dish on a table has.
struct RimCheckParams {
  // Between rim and table. Right outlines stay below 0.9 degrees (5 degrees between the views) and 0.7 (10
  // and more); exchanged ones give 4 to 45.
  double max_tilt_deg = 3.0;
  // Outlines and dense depth, each giving a rim: right ones differ by up to 2.5 mm, since depth is read
  // inside the edge. Names the cause when the dish is not a known one: beyond, it is the outlines.
  double max_depth_deviation_mm = 4.0;
};

// A tray with one dish.
struct Configuration : TraySetup {
  Caps caps;
  ViewParams view;
  SurfParams surf;
  MatcherParams matcher;
  RelativePoseParams pose;
  CardScaleParams card_search;
  RectificationParams rectification;
  DisparityRangeParams disparity_range;
  StereoParams stereo;
  FoodMeshParams mesh;
  RimParams rim;
  RimCheckParams rim_check;
  DishParams dish;
  DishChoiceParams dish_choice;
  VolumeParams volume;
  VolumeExtractionParams extraction;
  LabelAgreementParams label_agreement;
};

// invalid_configuration when a value lies outside its range (core/paper/pipeline/parameters.hpp).
Status validate(const Configuration& configuration);

}  // namespace traygauge::paper
