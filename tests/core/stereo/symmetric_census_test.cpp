// The centre-symmetric census against its definition, bit by bit.
#include "core/stereo/symmetric_census.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>
#include <vector>

#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

struct Picture {
  Picture(int width, int height, unsigned seed, int levels)
      : pixels(static_cast<std::size_t>(width * height)), view(pixels.data(), width, height) {
    std::mt19937 random(seed);
    for (std::uint8_t& p : pixels) p = static_cast<std::uint8_t>(random() % static_cast<unsigned>(levels));
  }
  int clamped(int x, int y) const {
    return view.at(std::clamp(x, 0, view.width - 1), std::clamp(y, 0, view.height - 1));
  }
  std::vector<std::uint8_t> pixels;
  ImageView<std::uint8_t> view;
};

// Number of bits by which two windows differ, from the definition.
int differing(const Picture& picture, int x0, int y0, int x1, int y1) {
  int count = 0;
  for (int dy = 0; dy <= kSymmetricCensusRows; ++dy) {
    for (int dx = dy == 0 ? 1 : -kSymmetricCensusColumns; dx <= kSymmetricCensusColumns; ++dx) {
      const bool first = picture.clamped(x0 + dx, y0 + dy) > picture.clamped(x0 - dx, y0 - dy);
      const bool second = picture.clamped(x1 + dx, y1 + dy) > picture.clamped(x1 - dx, y1 - dy);
      count += first != second ? 1 : 0;
    }
  }
  return count;
}

TEST(SymmetricCensus, EqualsItsDefinition) {
  const unsigned seed = test::random_seed();
  for (const int width : {1, 3, 8, 9, 31, 64}) {
    const Picture picture(width, 13, seed, 256);
    std::vector<std::uint32_t> codes(picture.pixels.size());
    const ImageView<std::uint32_t> out(codes.data(), width, 13);
    transform_symmetric_census(picture.view, out);
    for (int y = 0; y < 13; ++y) {
      for (int x = 0; x < width; ++x) {
        ASSERT_EQ(std::popcount(out.at(x, y) ^ out.at(0, 0)), differing(picture, x, y, 0, 0));
        ASSERT_LT(out.at(x, y), std::uint32_t{1} << kSymmetricCensusBits);
      }
    }
  }
}

TEST(SymmetricCensus, MaskKeepsPairsOfTheCentresLabel) {
  const Picture labels(24, 12, 5, 3);
  std::vector<std::uint32_t> masks(labels.pixels.size());
  const ImageView<std::uint32_t> out(masks.data(), 24, 12);
  mask_symmetric_census(labels.view, out);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 24; ++x) {
      int kept = 0;
      for (int dy = 0; dy <= kSymmetricCensusRows; ++dy) {
        for (int dx = dy == 0 ? 1 : -kSymmetricCensusColumns; dx <= kSymmetricCensusColumns; ++dx) {
          const int centre = labels.clamped(x, y);
          kept += labels.clamped(x + dx, y + dy) == centre && labels.clamped(x - dx, y - dy) == centre;
        }
      }
      ASSERT_EQ(std::popcount(out.at(x, y)), kept);
    }
  }
}

}  // namespace
}  // namespace traygauge
