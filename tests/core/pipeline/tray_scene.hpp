// A whole measurement's input without files: a textured solid on a flat dish, a card with a random print
// beside it, two cameras. Volume and motion follow from closed forms.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/pipeline/tray_setup.hpp"
#include "core/pipeline/view_input.hpp"
#include "tests/support/synthetic_scene.hpp"

namespace traygauge {

inline constexpr int kTrayWidthPx = 960;
inline constexpr int kTrayHeightPx = 720;
inline constexpr double kTrayDishRadius_mm = 80.0;
// Of the card's top left corner, beside the dish.
inline constexpr double kCardLeft_mm = -182.0;
inline constexpr double kCardTop_mm = 27.0;

struct TrayOptions {
  std::array<double, 2> tilt_deg = {6.0, 24.0};  // of the cameras from the vertical, towards −y
  double distance_mm = 450.0;
  std::uint32_t texture_seed = 1;
  std::uint32_t pattern_seed = 1;
  bool with_card = true;
  double solid_radius_mm = 40.0;
  Vec2 solid_centre_mm = Vec2::Zero();  // beyond kTrayDishRadius_mm it lies beside the dish
};

struct TrayPattern {
  static constexpr int kWidth = 514;  // 6 px per mm
  static constexpr int kHeight = 324;
  std::vector<std::uint8_t> pixels;

  explicit TrayPattern(std::uint32_t seed);
  ImageView<const std::uint8_t> view() const { return {pixels.data(), kWidth, kHeight}; }
};

struct TrayScene {
  explicit TrayScene(const TrayOptions& options = {});

  // Views and pattern stay the scene's.
  TraySetup setup() const;
  // The same as the configuration of an estimator, everything else at its default.
  template <class Config>
  Config configuration() const {
    Config configuration;
    static_cast<TraySetup&>(configuration) = setup();
    return configuration;
  }
  ViewInput view(int i) const;
  ViewInput view(int i, ImageView<const std::uint8_t> labels) const;
  double volume_ml() const { return solid.volume_ml(); }
  Pose second_from_first() const { return traygauge::second_from_first(cameras[0], cameras[1]); }

  SyntheticScene solid;
  TrayPattern pattern;
  std::array<SyntheticCamera, 2> cameras;
  std::array<RenderedView, 2> views;
  std::array<DishModel, 1> dish;
};

// The default scene, rendered once a program.
const TrayScene& default_tray();
// Another dish with other textures; the same card.
const TrayScene& other_tray();

}  // namespace traygauge
