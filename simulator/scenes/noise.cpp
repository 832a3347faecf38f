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

float hash_fraction(std::uint32_t hash) {
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
  // A layer's nine cells, and its middle again up to whole lanes.
  constexpr std::size_t kCells = 9;
  constexpr std::size_t kLanes = 16;
  constexpr std::array<int, kLanes> kStepX = {0, -1, 1, 0, -1, 1, 0, -1, 1};
  constexpr std::array<int, kLanes> kStepY = {0, 0, 0, -1, -1, -1, 1, 1, 1};
  const Eigen::Vector3f floor = point.array().floor().matrix();
  const Eigen::Vector3i cell = floor.cast<int>();
  const float up = point.z() - floor.z();
  NearestCell nearest{std::numeric_limits<float>::max(), 0};
  for (const int dz : {0, -1, 1}) {
    const float apart = dz == 0 ? 0.0F : dz < 0 ? up : 1.0F - up;
    if (apart * apart >= nearest.distance) continue;
    std::array<std::uint32_t, kLanes> ids{};
    std::array<float, kLanes> squared{};
    for (std::size_t i = 0; i < kLanes; ++i) {
      const int x = cell.x() + kStepX[i];
      const int y = cell.y() + kStepY[i];
      const int z = cell.z() + dz;
      const std::uint32_t id = hash_cell(x, y, z, seed);
      const float off_x = static_cast<float>(x) + hash_fraction(id) - point.x();
      const float off_y = static_cast<float>(y) + hash_fraction(id * 0x9E3779B9U) - point.y();
      const float off_z = static_cast<float>(z) + hash_fraction(id * 0x85EBCA6BU) - point.z();
      ids[i] = id;
      squared[i] = off_x * off_x + off_y * off_y + off_z * off_z;
    }
    for (std::size_t i = 0; i < kCells; ++i) {
      const bool is_nearer = squared[i] < nearest.distance;
      nearest.distance = is_nearer ? squared[i] : nearest.distance;
      nearest.id = is_nearer ? ids[i] : nearest.id;
    }
  }
  nearest.distance = std::sqrt(nearest.distance);
  return nearest;
}

}  // namespace traygauge
