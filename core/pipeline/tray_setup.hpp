// What an estimator is told of cameras, card and dishes, and when it refuses a pair of pictures.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/status.hpp"
#include "core/card/card_size.hpp"
#include "core/dish/dish_model.hpp"
#include "core/geometry/camera.hpp"
#include "core/image_view/image_view.hpp"
#include "core/quality/exposure.hpp"
#include "core/quality/view_checks.hpp"
#include "core/quality/view_input.hpp"

namespace traygauge {

// The reference card. The pattern is its printed side as a grey picture, filling width × height.
struct ReferenceCard : CardModelSize {
  ImageView<const std::uint8_t> pattern;

  const CardModelSize& size() const { return *this; }
};

struct TraySetup {
  LensModel lens;
  ReferenceCard card;
  // Candidates for the only dish: the nearest by rim size and height; none near: dish_unknown. A tray with
  // several dishes has one for each label.
  std::span<const DishModel> dishes;
  FrameLimits limits;
  ExposureParams exposure;
  ViewCheckParams view_checks;
  ViewGeometryParams geometry;
};

// invalid_configuration when a value is not plausible.
Status validate_apart_from_dishes(const TraySetup& setup);
Status validate_dishes(std::span<const DishModel> dishes);
Status validate(const TraySetup& setup);

}  // namespace traygauge
