#include "core/geometry/levenberg_marquardt.hpp"
#include "core/pipeline/segmenter.hpp"

namespace traygauge {

// The second camera in the frame of dishes that slid, in which they stand still.
void Segmenter::follow_own_motion() {
  std::array<SightedDish, kMaxPlacedDishes> sighted;
  std::size_t count = 0;
  for (const SegmentedDish& dish : result_.sought()) {
    if (!dish.status.ok() || !dish.sightings[0].is_known || !dish.sightings[1].is_known) continue;
    sighted[count++] = {dish.sightings, mean_size_mm(dish.found.place),
                        is_round_dish(dish.model.outer_size_mm)};
  }
  const TableCameras cameras = {cameras_[0].camera_from_table, cameras_[1].camera_from_table};
  CamerasMatrix covariance = CamerasMatrix::Zero();
  covariance.topLeftCorner<6, 6>() = inverse_information<6>(result_.cards[0].information);
  covariance.bottomRightCorner<6, 6>() = inverse_information<6>(result_.cards[1].information);
  result_.own_motion =
      find_own_motion(std::span(sighted).first(count), cameras, covariance, configuration_.checks);
  if (!result_.own_motion.is_known) return;
  cameras_[1].camera_from_table = cameras_[1].camera_from_table * result_.own_motion.pose();
  result_.status = find_dishes();
}

}  // namespace traygauge
