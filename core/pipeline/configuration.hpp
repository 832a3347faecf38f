// Everything that a measurement depends on beside the pictures.
#pragma once

#include "core/adjustment/bundle_adjustment.hpp"
#include "core/card/card.hpp"
#include "core/card/card_alignment.hpp"
#include "core/dish/dish_outline.hpp"
#include "core/image/specular_suppression.hpp"
#include "core/labels/dish_membership.hpp"
#include "core/network/network.hpp"
#include "core/pipeline/food_agreement_params.hpp"
#include "core/pipeline/lens_doubt.hpp"
#include "core/pipeline/segmenter_params.hpp"
#include "core/pipeline/tray_check_params.hpp"
#include "core/pipeline/tray_food_params.hpp"
#include "core/pipeline/tray_setup.hpp"
#include "core/segmentation/food_evidence.hpp"
#include "core/stereo/dense_stereo.hpp"
#include "core/tracking/point_tracking.hpp"
#include "core/volume/height_map.hpp"
#include "core/volume/height_volume.hpp"
#include "core/volume/level_liquid.hpp"
#include "core/volume/overhang.hpp"
#include "core/volume/round_body.hpp"
#include "core/volume/uncertainty.hpp"

namespace traygauge {

// What ties the stages together.
// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.06 points at most
// (tests/evaluation/numbers.tsv), but for half of min_top_mm, which cuts summits off, half of
// max_height_cells, which refuses large dishes, and twice of min_rim_inlier_fraction, which refuses all.
struct PipelineParams {
  int min_item_px = 64;  // of an item in either view, about 25 mm²
  // Above the tallest sparse point on a dish the surface is searched this much higher: corners sit on edges
  // and texture, not on every summit.
  double summit_margin_mm = 20.0;
  // No search ends below this height over a dish's bottom, however few points there are on the food, and
  // however low its outlines lie.
  double min_top_mm = 40.0;
  // Of a dish's outlines on the rim found, or on the wall below it; fewer: the outlines are of another
  // picture. Right ones reach 0.93 and more, those of a view 5 degrees off 0.63 to 0.80.
  double min_rim_inlier_fraction = 0.88;
  // Of an item's samples; fewer: its volume is doubtful. Food with texture reaches 0.65 and more between
  // 10 and 30 degrees, a banana 0.6.
  double min_matched_fraction = 0.62;
  // Of an item's sigma in its volume; above, its volume is doubtful. One volume in thirty of rendered meals;
  // of the captures, meals-14 and trays-8 of seed 61 that is 0.059 (tests/evaluation/fit/fit_uncertainty.py).
  double max_sigma_fraction = 0.063;
  std::size_t max_contour_sides = 8192;  // of one dish in one view, twice what a round one of 1600 px has
  std::size_t max_outline_points = max_contour_sides / DishOutlineParams{}.block_sides;
  std::size_t max_height_cells = 180'000;  // of a dish's height map: 360 × 360 mm at 0.85 mm
  // Of all height maps of a tray: a plate of 260 mm, three dishes of 160 mm and five places of 150 mm beside
  // them.
  std::size_t max_tray_cells = 360'000;
};

// The parameters of every stage, in the order in which they run.
struct Configuration : TraySetup {
  // Reads the pictures of a pair that comes without labels, and outlives the estimator. Null: no memory is
  // taken for that, and such a pair is refused.
  const Network* network = nullptr;
  FoodObserver* food_observer = nullptr;  // of finding labels; outlives the estimator, too
  CardParams card_search;                 // among corners, where no labels are given
  SegmenterParams segmentation;
  CardAlignmentParams card_alignment;
  PointTrackingParams tracking;
  DishMembershipParams membership;
  DishOutlineParams outline;
  BundleParams bundle;
  TrayCheckParams checks;
  LensDoubtParams lens_doubt;
  SpecularParams specular;
  DenseStereoParams surface;
  RoundBodyParams round_body;
  HeightMapParams height_map;
  LevelLiquidParams liquid;
  HeightVolumeParams volume;
  OverhangParams overhang;
  TrayFoodParams tray_food;
  FoodAgreementParams agreement;
  UncertaintyParams uncertainty;
  PipelineParams pipeline;
};

}  // namespace traygauge
