// What a flange says of its glaze: medians and spread.
#include "core/segmentation/glaze.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <opencv2/core/saturate.hpp>
#include <random>
#include <vector>

#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr int kGlazeSide = 120;

struct GlazedDish {
  std::vector<CellColour> colours{std::size_t{kGlazeSide} * kGlazeSide};
  std::vector<DishZone> zones{std::size_t{kGlazeSide} * kGlazeSide, DishZone::flange};
  DishRaster raster;

  GlazedDish() {
    raster.colours = {colours.data(), kGlazeSide, kGlazeSide};
    raster.zones = {zones.data(), kGlazeSide, kGlazeSide};
  }
  template <class ColourOf>
  void paint(ColourOf&& colour_of) {
    for (int y = 0; y < kGlazeSide; ++y) {
      for (int x = 0; x < kGlazeSide; ++x) raster.colours.at(x, y) = colour_of(x, y);
    }
  }
  template <class ZoneOf>
  void zone(ZoneOf&& zone_of) {
    for (int y = 0; y < kGlazeSide; ++y) {
      for (int x = 0; x < kGlazeSide; ++x) raster.zones.at(x, y) = zone_of(x, y);
    }
  }
};

std::uint8_t glaze_byte(double value) {
  return cv::saturate_cast<std::uint8_t>(value);
}

// A third of the flange has sauce on it, and of what is not flange nothing counts.
TEST(Glaze, IsThatOfMostOfTheFlange) {
  std::mt19937 random(test::random_seed());
  std::normal_distribution<double> noise;
  GlazedDish dish;
  dish.zone([](int x, int y) {
    return y < 60 ? DishZone::flange : x < 60 ? DishZone::inside : DishZone::edge;
  });
  dish.paint([&](int x, int y) {
    if (y >= 60) return CellColour{20, 250, 10};
    if (x < 40) return CellColour{90, 230, 150};
    return CellColour{glaze_byte(205.0 + 3.0 * noise(random)), glaze_byte(172.0 + 0.4 * noise(random)),
                      glaze_byte(168.0 + 0.4 * noise(random))};
  });
  GlazeColour glaze;
  ASSERT_TRUE(measure_glaze(dish.raster, {}, glaze));
  EXPECT_NEAR(glaze.red, 172, 1);
  EXPECT_NEAR(glaze.green, 168, 1);
  EXPECT_EQ(glaze.share_sigma, GlazeParams{}.min_share_sigma);
}

TEST(Glaze, KnowsTheSpreadOfItsShares) {
  std::mt19937 random(test::random_seed());
  std::normal_distribution<double> noise;
  for (const double sigma : {8.0, 15.0, 25.0}) {
    GlazedDish dish;
    dish.paint([&](int, int) {
      return CellColour{200, glaze_byte(130.0 + sigma * noise(random)),
                        glaze_byte(120.0 + sigma * noise(random))};
    });
    GlazeColour glaze;
    ASSERT_TRUE(measure_glaze(dish.raster, {}, glaze));
    EXPECT_NEAR(glaze.share_sigma, sigma, 1.5 + 0.03 * sigma);
    EXPECT_NEAR(glaze.red, 130, 2);
    EXPECT_NEAR(glaze.green, 120, 2);
  }
}

TEST(Glaze, IsUnknownWithoutAFlange) {
  GlazedDish dish;
  GlazeColour glaze;
  const auto flange_of = [&](int cells) {
    dish.zone([&](int x, int y) { return y * kGlazeSide + x < cells ? DishZone::flange : DishZone::inside; });
    return measure_glaze(dish.raster, {}, glaze);
  };
  EXPECT_FALSE(flange_of(0));
  EXPECT_FALSE(flange_of(GlazeParams{}.min_flange_cells - 1));
  EXPECT_TRUE(flange_of(GlazeParams{}.min_flange_cells));
}

}  // namespace
}  // namespace traygauge
