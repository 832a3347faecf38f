// A measurement of a scene in closed form, for drawing: an inclined dish with two flat items.
#pragma once

#include <cstdint>
#include <vector>

#include "core/paper/pipeline/working_pictures.hpp"
#include "core/pipeline/measurement.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge {

// Labels as draw_labels() puts them; item 2 is 30 mm high, item 3 is 12 mm high, the dish 0.
class SyntheticScene {
 public:
  static constexpr double kHeight2Mm = 30.0;
  static constexpr double kHeight3Mm = 12.0;
  static constexpr double kFocalPx = 300.0;
  static constexpr double kCameraHeightMm = 380.0;  // over the bottom of the dish

  SyntheticScene(int width, int height);

  // All stages reached; points into the scene.
  Measurement measurement() const;
  // Of the same measurement by profile paper.
  paper::WorkingPictures pictures() const;
  Vec3 point(int x, int y) const;  // of the surface, in the camera
  double height_mm(int x, int y) const;

 private:
  void build_mesh();

  int width_;
  int height_;
  PinholeCamera camera_;
  Plane bottom_;
  std::vector<std::uint8_t> labels_;
  std::vector<float> depth_mm_;
  std::vector<Disparity> disparity_;
  std::vector<paper::MeshPoint> points_;
  std::vector<paper::MeshTriangle> triangles_;
  std::vector<ItemResult> items_;
};

}  // namespace traygauge
