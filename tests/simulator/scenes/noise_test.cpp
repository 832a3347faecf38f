#include "simulator/scenes/noise.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

TEST(Noise, TheNearestCellIsTheNearestOfTheCellsAround) {
  std::mt19937_64 random(test::random_seed());
  std::uniform_real_distribution<float> at(-40.0F, 40.0F);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3f point(at(random), at(random), i % 2 == 0 ? 0.5F : at(random));
    const auto seed = static_cast<std::uint32_t>(random());
    const NearestCell found = nearest_cell(point, seed);
    bool is_a_cell = false;
    float least = 10.0F;
    for (int cell = 0; cell < 27; ++cell) {
      const Eigen::Vector3i place = point.array().floor().cast<int>().matrix() +
                                    Eigen::Vector3i(cell % 3 - 1, cell / 3 % 3 - 1, cell / 9 - 1);
      const std::uint32_t id = hash_cell(place.x(), place.y(), place.z(), seed);
      const Eigen::Vector3f offset(hash_fraction(id), hash_fraction(id * 0x9E3779B9U),
                                   hash_fraction(id * 0x85EBCA6BU));
      const float distance = (place.cast<float>() + offset - point).norm();
      least = std::min(least, distance);
      is_a_cell |= id == found.id && std::abs(distance - found.distance) < 1e-5F;
    }
    ASSERT_TRUE(is_a_cell) << "point " << point.transpose() << ", seed " << seed;
    ASSERT_NEAR(found.distance, least, 1e-5F) << "point " << point.transpose() << ", seed " << seed;
  }
}

}  // namespace
}  // namespace traygauge
