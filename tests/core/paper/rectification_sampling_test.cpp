// The sampling loops against interpolation in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/paper/rectification/line_sampling.hpp"
#include "tests/core/paper/rectification_fixture.hpp"

namespace traygauge::paper {
namespace {

constexpr int kWidth = 61;
constexpr int kHeight = 47;
constexpr int kColumns = 150;

Picture random_picture(Random& random) {
  Picture picture(kWidth, kHeight);
  for (auto& pixel : picture.pixels) pixel = static_cast<std::uint8_t>(1 + random.below(255));
  return picture;
}

RectifiedLine random_line(Random& random) {
  const double around = uniform(random, -3.2, 3.2);
  const double length = uniform(random, 0.5, 2.0);
  const Vec2 through(uniform(random, -5.0, kWidth + 5.0), uniform(random, -5.0, kHeight + 5.0));
  const Vec2 step = length * Vec2(std::cos(around), std::sin(around));
  return {through - uniform(random, 0.0, kColumns) * step, step};
}

bool is_inside(const Vec2& p, double slack) {
  return p.minCoeff() >= -slack && p.x() <= kWidth - 1 + slack && p.y() <= kHeight - 1 + slack;
}

double interpolate(const Picture& picture, const Vec2& p) {
  const int x = std::clamp(static_cast<int>(std::floor(p.x())), 0, kWidth - 2);
  const int y = std::clamp(static_cast<int>(std::floor(p.y())), 0, kHeight - 2);
  const double fx = p.x() - x;
  const double fy = p.y() - y;
  const auto view = picture.view();
  return (1 - fy) * ((1 - fx) * view.at(x, y) + fx * view.at(x + 1, y)) +
         fy * ((1 - fx) * view.at(x, y + 1) + fx * view.at(x + 1, y + 1));
}

TEST(SampleLine, BilinearIsInterpolationInsideAndZeroOutside) {
  Random random(21);
  const Picture picture = random_picture(random);
  std::vector<std::uint8_t> row(kColumns);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const RectifiedLine line = random_line(random);
    std::ranges::fill(row, std::uint8_t{77});
    sample_line_bilinear(picture.view(), line, row);
    for (int column = 0; column < kColumns; ++column) {
      const Vec2 p = line.pixel(column);
      const int value = row[static_cast<std::size_t>(column)];
      if (is_inside(p, -0.01)) {
        // 1/512 px of rounding in x and y on steps of up to 254, and half a grey value.
        ASSERT_NEAR(value, interpolate(picture, p), 1.5) << "line " << i << " column " << column;
        ++inside;
      } else if (!is_inside(p, 0.01)) {
        ASSERT_EQ(value, 0) << "line " << i << " column " << column;
      }
    }
  }
  EXPECT_GT(inside, 50000);
}

TEST(SampleLine, NearestTakesThePixelAroundThePoint) {
  Random random(22);
  const Picture picture = random_picture(random);
  std::vector<std::uint8_t> row(kColumns);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const RectifiedLine line = random_line(random);
    std::ranges::fill(row, std::uint8_t{77});
    sample_line_nearest(picture.view(), line, row);
    for (int column = 0; column < kColumns; ++column) {
      const Vec2 p = line.pixel(column);
      const Vec2 rounded(std::floor(p.x() + 0.5), std::floor(p.y() + 0.5));
      const double to_edge = 0.5 - (p - rounded).cwiseAbs().maxCoeff();
      if (to_edge < 1e-6) continue;
      const bool expected_inside = is_inside(rounded, 0.0);
      const int expected =
          expected_inside ? picture.view().at(static_cast<int>(rounded.x()), static_cast<int>(rounded.y()))
                          : 0;
      ASSERT_EQ(row[static_cast<std::size_t>(column)], expected) << "line " << i << " column " << column;
      inside += expected_inside ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 50000);
}

TEST(SampleLine, PixelCentresAreCopiedUpToTheLastRowAndColumn) {
  Random random(23);
  const Picture picture = random_picture(random);
  std::vector<std::uint8_t> row(kWidth);
  std::vector<std::uint8_t> column(kHeight);
  for (int y = 0; y < kHeight; ++y) {
    sample_line_bilinear(picture.view(), {Vec2(0, y), Vec2::UnitX()}, row);
    EXPECT_TRUE(std::equal(row.begin(), row.end(), picture.view().row(y)));
  }
  for (int x = 0; x < kWidth; ++x) {
    sample_line_bilinear(picture.view(), {Vec2(x, kHeight - 1), -Vec2::UnitY()}, column);
    for (int y = 0; y < kHeight; ++y) {
      EXPECT_EQ(column[static_cast<std::size_t>(y)], picture.view().at(x, kHeight - 1 - y));
    }
  }
}

TEST(SampleLine, LinesBesideThePictureAreBlack) {
  Random random(24);
  const Picture picture = random_picture(random);
  std::vector<std::uint8_t> row(kColumns);
  const std::array lines = {
      RectifiedLine{Vec2(0, -2.0), Vec2::UnitX()}, RectifiedLine{Vec2(0, kHeight + 1.0), Vec2::UnitX()},
      RectifiedLine{Vec2(-1e6, 3.0), Vec2::UnitX()}, RectifiedLine{Vec2(5.0, 1e7), Vec2(0.6, 0.8)}};
  for (const RectifiedLine& line : lines) {
    std::ranges::fill(row, std::uint8_t{77});
    sample_line_bilinear(picture.view(), line, row);
    EXPECT_TRUE(std::ranges::all_of(row, [](std::uint8_t v) { return v == 0; }));
    std::ranges::fill(row, std::uint8_t{77});
    sample_line_nearest(picture.view(), line, row);
    EXPECT_TRUE(std::ranges::all_of(row, [](std::uint8_t v) { return v == 0; }));
  }
}

}  // namespace
}  // namespace traygauge::paper
