// A dish that slid over the table between the pictures, with its food on it: then the dish is the frame that
// counts, and in it the second camera stands elsewhere than the card says. The same where the card moved.
#pragma once

#include <array>
#include <span>

#include "core/adjustment/card_prior.hpp"
#include "core/dish/dish_consistency.hpp"
#include "core/dish/dish_sighting.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/pipeline/tray_check_params.hpp"

namespace traygauge {

// Of dishes over the table, from the first picture to the second.
struct OwnMotion {
  bool is_known = false;
  bool is_too_far = false;        // one slid further than can be followed
  Vec2 centre_mm = Vec2::Zero();  // what is turned about, in the first picture
  Vec2 shift_mm = Vec2::Zero();   // of it
  double turn_rad = 0.0;
  double shift_sigma_mm = 0.0;  // along each axis
  double turn_sigma_rad = 0.0;

  // Of the table's points.
  Pose pose() const;
  OwnMotion reversed() const;
};

inline double mean_size_mm(const DishPose& place) {
  return 0.5 * (place.size_mm[0] + place.size_mm[1]);
}

// One dish in both views, as its rim alone shows it.
struct SightedDish {
  std::array<DishSighting, 2> sightings;
  double size_mm = 0.0;  // mean of its axes
  bool is_round = false;
};

// What all dishes agree about; unknown where one of them did not slip, or further than can be followed. The
// cameras are those of the cards, with the covariance of a step of both.
OwnMotion find_own_motion(std::span<const SightedDish> dishes, const TableCameras& cameras,
                          const CamerasMatrix& covariance, const TrayCheckParams& params);

// The second view's card as if it had moved with the dishes.
CardPrior card_in_frame_of(const OwnMotion& motion, const CardPrior& second_card);

}  // namespace traygauge
