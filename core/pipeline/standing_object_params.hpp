// The parameters of what else stands on the tray.
#pragma once

#include "core/stereo/level_patch.hpp"

namespace traygauge {

struct StandingObjectParams {
  LevelPatchParams patch;
  double around_mm = 100.0;  // the card and the dishes: a tray ends about there
  // Off a dish, whose outer wall is its own: half a patch, and what its outline is unsure by.
  double from_dish_mm = 12.0;
  double step_mm = 12.0;
  // Cutlery, napkins and folds lie below the first height, a tray's own rim below the last.
  double low_mm = 10.0;
  double sought_from_mm = 18.0;
  double least_height_mm = 26.0;
  double most_height_mm = 64.0;
  double height_step_mm = 2.0;
  double min_correlation = 0.8;
  double min_lead_over_table = 0.4;
  // Over heights 12 mm away and more: an edge along the line between the cameras fits everywhere.
  double min_lead = 0.2;
  double apart_mm = 12.0;
  // An object: so many patches at one height, no further apart. Limits were chosen on the captures, seed 61
  // and slips-10 of seed 81 (tests/evaluation/experiments.md).
  double same_height_mm = 2.5;
  double same_place_mm = 75.0;
  int min_patches = 8;
};

}  // namespace traygauge
