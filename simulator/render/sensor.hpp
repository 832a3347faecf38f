// What a camera's sensor and processing make of the light.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "simulator/capture/picture.hpp"
#include "simulator/render/rendered_view.hpp"

namespace traygauge {

// Defaults: a phone in a lit room.
struct SensorSettings {
  double exposure = 1.0;                                    // share of the full well that radiance 1 fills
  Eigen::Vector3d white_balance = Eigen::Vector3d::Ones();  // gains of red, green, blue, after the sensor
  double corner_loss = 0.3;  // share of the light that is missing in the picture's corners; from 0 to below 1
  double full_well_electrons = 6000.0;  // more is cut off
  double read_noise_electrons = 4.0;    // standard deviation

  // Throws std::invalid_argument for a value out of range.
  void check() const;
};

// 8-bit RGB with the tone curve of sRGB. Shot and read noise are drawn from `seed`, for each pixel and colour
// alone; the same for any number of threads (0: as many as there are cores).
Picture develop(const RenderedView& view, const SensorSettings& settings, std::uint64_t seed,
                int threads = 0);

}  // namespace traygauge
