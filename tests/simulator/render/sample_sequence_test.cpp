// Points that fill a square evenly, for a pixel and over a block of pixels.
#include "simulator/render/sample_sequence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "simulator/render/block_sequence.hpp"

namespace traygauge {
namespace {

// Whether each of the parts of the unit square, columns × rows, holds one of the points.
bool is_net(const std::vector<Eigen::Vector2f>& points) {
  for (std::size_t columns = 1; columns <= points.size(); columns *= 2) {
    const std::size_t rows = points.size() / columns;
    std::set<std::size_t> parts;
    for (const Eigen::Vector2f& point : points) {
      const auto column = static_cast<std::size_t>(point.x() * static_cast<float>(columns));
      const auto row = static_cast<std::size_t>(point.y() * static_cast<float>(rows));
      parts.insert(row * columns + column);
    }
    if (parts.size() != points.size()) return false;
  }
  return true;
}

TEST(SampleSequence, EveryPowerOfTwoInARowIsANet) {
  for (std::uint32_t seed = 1; seed < 20; ++seed) {
    for (std::uint32_t count = 1; count <= 64; count *= 2) {
      for (std::uint32_t chunk = 0; chunk < 5; ++chunk) {
        std::vector<Eigen::Vector2f> points;
        for (std::uint32_t i = 0; i < count; ++i)
          points.push_back(SampleSequence(seed).point(3, chunk * count + i));
        EXPECT_TRUE(is_net(points)) << seed << " " << count << " " << chunk;
      }
    }
  }
}

TEST(BlockSequence, NeighboursAndBlocksOfPixelsAreNets) {
  for (const int side : {2, 4, 8}) {
    for (std::uint32_t number = 0; number < 3; ++number) {
      std::vector<Eigen::Vector2f> points;
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const BlockSequence block(7, 16 + x, 40 + y);
          points.push_back(block.sequence().point(0, block.index(number)));
        }
      }
      EXPECT_TRUE(is_net(points)) << side << " " << number;
    }
  }
}

}  // namespace
}  // namespace traygauge
