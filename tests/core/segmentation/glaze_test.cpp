// What a flange says of its glaze: medians against sorted values, bends against OpenCV's filters.
#include "core/segmentation/glaze.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>
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
  EXPECT_NEAR(glaze.median.luma, 204, 3);
  EXPECT_NEAR(glaze.median.red, 172, 1);
  EXPECT_NEAR(glaze.median.green, 168, 1);
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
    EXPECT_NEAR(glaze.median.red, 130, 2);
    EXPECT_NEAR(glaze.median.green, 120, 2);
  }
}

TEST(Glaze, BendsAsOpenCvsFiltersFindThem) {
  std::mt19937 random(test::random_seed());
  std::uniform_int_distribution<int> value(90, 130);
  GlazedDish dish;
  dish.zone([](int x, int y) {
    return x > 10 && x < 110 && y > 10 && y < 110 ? DishZone::flange : DishZone::outside;
  });
  cv::Mat1f luma(kGlazeSide, kGlazeSide);
  dish.paint([&](int x, int y) {
    luma(y, x) = static_cast<float>(value(random));
    return CellColour{static_cast<std::uint8_t>(luma(y, x)), 170, 170};
  });
  const cv::Mat1f along = (cv::Mat1f(1, 3) << -1.0F, 2.0F, -1.0F);
  cv::Mat1f across;
  cv::Mat1f down;
  cv::filter2D(luma, across, CV_32F, along);
  cv::filter2D(luma, down, CV_32F, along.t());
  cv::Mat1f bends;
  cv::add(cv::abs(across), cv::abs(down), bends);
  for (int y = 1; y + 1 < kGlazeSide; ++y) {
    for (int x = 1; x + 1 < kGlazeSide; ++x)
      ASSERT_EQ(static_cast<float>(bend_at(dish.raster.colours, x, y)), bends(y, x));
  }
  GlazeParams params;
  for (const int radius : {0, 2, 4}) {
    params.texture_radius = radius;
    cv::Mat1f mean;
    cv::blur(bends, mean, {2 * radius + 1, 2 * radius + 1});
    std::vector<double> doubled;
    for (int y = 11; y < 110; ++y) {
      for (int x = 11; x < 110; ++x)
        doubled.push_back(std::min(255.0, 2.0 * static_cast<double>(mean(y, x))));
    }
    std::nth_element(doubled.begin(), doubled.begin() + static_cast<std::ptrdiff_t>(doubled.size() / 2),
                     doubled.end());
    GlazeColour glaze;
    ASSERT_TRUE(measure_glaze(dish.raster, params, glaze));
    EXPECT_NEAR(glaze.texture, doubled[doubled.size() / 2], 1.0) << radius;
  }
}

TEST(Glaze, ASlopeHasNoBends) {
  GlazedDish dish;
  dish.paint([](int x, int y) { return CellColour{static_cast<std::uint8_t>(x + y), 170, 170}; });
  EXPECT_EQ(bend_at(dish.raster.colours, 60, 60), 0);
  EXPECT_EQ(bend_at(dish.raster.colours, 0, 60), 0);
  EXPECT_EQ(bend_at(dish.raster.colours, 60, kGlazeSide - 1), 0);
  GlazeColour glaze;
  ASSERT_TRUE(measure_glaze(dish.raster, {}, glaze));
  EXPECT_EQ(glaze.texture, 1.0);
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
