// Noise in space for textures and rough surfaces: no tables, any number of threads.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace traygauge {

std::uint32_t hash_cell(int x, int y, int z, std::uint32_t seed);

// The hash as a number in [0, 1).
float hash_fraction(std::uint32_t hash);

// Gradient noise (Perlin 2002) with features of size 1: about -1 to 1, mean 0.
float gradient_noise(const Eigen::Vector3f& point, std::uint32_t seed);

// `octaves` of gradient noise, each half as large and half as strong as the one before: about -1 to 1.
float fractal_noise(const Eigen::Vector3f& point, std::uint32_t seed, int octaves);

// One random point a unit cell (Worley 1996): the nearest of them.
struct NearestCell {
  float distance = 0.0F;
  std::uint32_t id = 0;  // hash of its cell
};
NearestCell nearest_cell(const Eigen::Vector3f& point, std::uint32_t seed);

}  // namespace traygauge
