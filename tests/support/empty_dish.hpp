// Captures of an empty dish, rendered: a solid of known profile with a patterned glaze on a patterned table,
// a card beside it, two pinhole cameras.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>

#include "core/dish/dish_profile.hpp"
#include "core/geometry/geometry.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge::test {

struct EmptyDishScene {
  DishModel dish;
  Vec2 centre_mm{-8.0, 5.0};
  double azimuth_deg = 25.0;
  double wall_mm = 3.5;         // thickness below the inner surface
  double glaze_contrast = 1.0;  // of the pattern: 1 a decorated plate, 0 plain
  double gloss = 0.0;           // of a lamp's reflection, grey values
  double noise_gray = 1.5;
  std::array<double, 2> tilt_deg{10.0, 28.0};
  double turn_deg = 8.0;  // of the second camera about the vertical
  double distance_mm = 470.0;
  std::uint32_t seed = 1;
};

// A dish of config/dishes.
DishModel read_dish_model(const std::string& style);

// Renders the scene and writes a capture folder without "dish", which lives as long as this object.
class EmptyDishCapture {
 public:
  explicit EmptyDishCapture(const EmptyDishScene& scene);

  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

// Writes into the label picture of a view of such a folder.
void paint_labels(const std::filesystem::path& folder, int view, const cv::Rect& area, std::uint8_t label);

}  // namespace traygauge::test
