#include "firmware/measure/pair_setup.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace traygauge {

static_assert(kMaxProfilePoints <= kMaxDishProfilePoints, "what is read must fit into the measurement");

LensModel lens_of(const CameraDescription& camera) {
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  LensModel lens{camera.size.width,
                 camera.size.height,
                 {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px},
                 k1,
                 k2,
                 p1,
                 p2,
                 k3};
  const auto& [k4, k5, k6, s1, s2, s3, s4, tau_x, tau_y] = camera.further_distortion;
  if (camera.has_further_distortion())
    lens.further = {true, k4, k5, k6, s1, s2, s3, s4, sensor_tilt(tau_x, tau_y)};
  return lens;
}

ReferenceCard card_of(const CardDescription& card, const Picture& pattern) {
  return {{card.width_mm, card.height_mm, card.thickness_mm}, pattern.gray()};
}

DishModel dish_of(const DishDescription& dish) {
  DishModel model{dish.outer_size_mm, dish.rim_height_mm, dish.bottom_height_mm};
  for (const ProfilePoint& point : dish.profile) {
    model.profile_points.at(model.profile_size++) = {point.inset_mm, point.height_mm};
  }
  model.label = static_cast<std::uint8_t>(dish.label);
  return model;
}

FrameLimits limits_for(PictureSize first, PictureSize second) {
  FrameLimits limits;
  limits.max_frame_width = std::max(first.width, second.width);
  limits.max_frame_height = std::max(first.height, second.height);
  return limits;
}

PairSetup set_up_pair(const Capture& capture, std::array<int, 2> pair,
                      const std::vector<DishDescription>& dishes) {
  PairSetup setup;
  for (std::size_t i = 0; i < 2; ++i) {
    setup.lenses[i] = lens_of(capture.views[static_cast<std::size_t>(pair[i])].camera);
  }
  setup.card = capture.card;
  setup.pattern = load_pattern(capture.card);
  for (const DishDescription& dish : dishes) setup.dishes.push_back(dish_of(dish));
  return setup;
}

void describe_tray(const PairSetup& setup, TraySetup& tray) {
  tray.lens = setup.lenses[0];
  tray.card = card_of(setup.card, setup.pattern);
  tray.dishes = setup.dishes;
  tray.limits.max_frame_width = std::max(setup.lenses[0].width, setup.lenses[1].width);
  tray.limits.max_frame_height = std::max(setup.lenses[0].height, setup.lenses[1].height);
}

}  // namespace traygauge
