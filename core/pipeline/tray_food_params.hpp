// The parameters of food that lies beside the dishes.
#pragma once

namespace traygauge {

struct TrayFoodParams {
  // Of the ground around an item that is looked at for its height; what lies nearer together is one place.
  double around_mm = 20.0;
  double map_margin_mm = 5.0;  // of an item's heights: cells of the ground that it may be seen against
  // Of ground that shows no structure: from a bare tray to 3 mm of folded napkin, uniformly.
  double unknown_ground_sigma_mm = 0.87;
};

}  // namespace traygauge
