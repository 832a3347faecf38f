// What the renderer makes of a scene and a camera, before the sensor.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "simulator/render/truth_kind.hpp"

namespace traygauge {

// Row by row, width × height each.
struct RenderedView {
  int width = 0;
  int height = 0;
  std::vector<Eigen::Vector3f> radiance;  // linear RGB
  std::vector<std::uint8_t> labels;       // at the pixel's centre, sharp
  std::vector<TruthKind> kinds;           // likewise
  std::vector<float> depth_mm;            // along the optical axis at the pixel's centre; 0: nothing there
};

}  // namespace traygauge
