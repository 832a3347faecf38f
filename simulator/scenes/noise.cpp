#include "simulator/scenes/noise.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace traygauge {
namespace {

float fade(float t) {
  return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
}

float mix(float from, float to, float share) {
  return from + share * (to - from);
}

// The dot product with one of 12 directions to the edges of a cube.
float slope(std::uint32_t hash, float x, float y, float z) {
  const std::uint32_t direction = (hash >> 8U) % 12U;
  const float u = direction < 8U ? x : y;
  const float v = direction < 4U ? y : z;
  return ((hash & 1U) != 0U ? u : -u) + ((hash & 2U) != 0U ? v : -v);
}

}  // namespace

std::uint32_t hash_cell(int x, int y, int z, std::uint32_t seed) {
  std::uint32_t hash = seed ^ (static_cast<std::uint32_t>(x) * 0x8DA6B343U) ^
                       (static_cast<std::uint32_t>(y) * 0xD8163841U) ^
                       (static_cast<std::uint32_t>(z) * 0xCB1AB31FU);
  hash = (hash ^ (hash >> 16U)) * 0x7FEB352DU;
  hash = (hash ^ (hash >> 15U)) * 0x846CA68BU;
  return hash ^ (hash >> 16U);
}

float hash_share(std::uint32_t hash) {
  return static_cast<float>(hash >> 8U) * (1.0F / 16777216.0F);
}

float gradient_noise(const Eigen::Vector3f& point, std::uint32_t seed) {
  const Eigen::Vector3f floor = point.array().floor().matrix();
  const Eigen::Vector3f at = point - floor;
  const Eigen::Vector3i cell = floor.cast<int>();
  std::array<float, 8> corner{};
  for (int i = 0; i < 8; ++i) {
    const int dx = i & 1;
    const int dy = (i >> 1) & 1;
    const int dz = i >> 2;
    corner[static_cast<std::size_t>(i)] =
        slope(hash_cell(cell.x() + dx, cell.y() + dy, cell.z() + dz, seed), at.x() - static_cast<float>(dx),
              at.y() - static_cast<float>(dy), at.z() - static_cast<float>(dz));
  }
  const float u = fade(at.x());
  const float v = fade(at.y());
  const float low = mix(mix(corner[0], corner[1], u), mix(corner[2], corner[3], u), v);
  const float high = mix(mix(corner[4], corner[5], u), mix(corner[6], corner[7], u), v);
  return mix(low, high, fade(at.z()));
}

float fractal_noise(const Eigen::Vector3f& point, std::uint32_t seed, int octaves) {
  float sum = 0.0F;
  float weight = 1.0F;
  float scale = 1.0F;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * gradient_noise(scale * point, seed + static_cast<std::uint32_t>(i) * 977U);
    weight *= 0.5F;
    scale *= 2.03F;
  }
  return sum;
}

NearestCell nearest_cell(const Eigen::Vector3f& point, std::uint32_t seed) {
  const Eigen::Vector3f floor = point.array().floor().matrix();
  const Eigen::Vector3i cell = floor.cast<int>();
  NearestCell nearest{std::numeric_limits<float>::max(), 0};
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Eigen::Vector3i at = cell + Eigen::Vector3i(dx, dy, dz);
        const std::uint32_t id = hash_cell(at.x(), at.y(), at.z(), seed);
        const Eigen::Vector3f offset(hash_share(id), hash_share(id * 0x9E3779B9U),
                                     hash_share(id * 0x85EBCA6BU));
        const float squared = (at.cast<float>() + offset - point).squaredNorm();
        if (squared < nearest.distance) nearest = {squared, id};
      }
    }
  }
  nearest.distance = std::sqrt(nearest.distance);
  return nearest;
}

}  // namespace traygauge
