// A dish in cells: colours against OpenCV's, zones against its filled polygons.
#include "core/segmentation/dish_raster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/allocated.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

// Blots of colours, and noise.
cv::Mat3b coloured_picture(int width, int height, std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat3b picture(height, width, cv::Vec3b(90, 120, 160));
  for (int i = 0; i < 60; ++i) {
    const cv::Scalar colour(random.uniform(0, 255), random.uniform(0, 255), random.uniform(0, 255));
    cv::circle(picture, {random.uniform(0, width), random.uniform(0, height)}, random.uniform(4, 40), colour,
               cv::FILLED);
  }
  return picture;
}

const std::array<Vec2, 4> kRasterBox = {Vec2(20.0, 30.0), Vec2(259.0, 30.0), Vec2(259.0, 209.0),
                                        Vec2(20.0, 209.0)};

struct Rastered {
  DishRasterParams params;
  test::Allocated<DishRasterWorkspace> space;
  DishRaster raster;

  explicit Rastered(const DishRasterParams& params_ = {}) : params(params_), space(params_) {}
  bool load(const FrameView& frame, std::span<const Vec2> outline_px, double px_per_mm) {
    return load_dish_raster(frame, outline_px, px_per_mm, params, *space, raster);
  }
};

TEST(DishRaster, LumaIsOpenCvsGreyOfTheMeanColour) {
  const std::uint32_t seed = test::random_seed();
  const cv::Mat3b picture = coloured_picture(300, 240, seed);
  Rastered cells;
  ASSERT_TRUE(cells.load(test::frame_of(picture), kRasterBox, 3.0));
  ASSERT_EQ(cells.raster.step_px, 3);
  ASSERT_EQ(cells.raster.width(), 80);
  ASSERT_EQ(cells.raster.height(), 60);
  cv::Mat3f exact;
  cv::Mat3f small;
  picture(cv::Rect(20, 30, 240, 180)).convertTo(exact, CV_32F);
  cv::resize(exact, small, {80, 60}, 0.0, 0.0, cv::INTER_AREA);
  cv::Mat1f gray;
  cv::cvtColor(small, gray, cv::COLOR_BGR2GRAY);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) ASSERT_NEAR(cells.raster.colours.at(x, y).luma, gray(y, x), 0.51);
  }
}

TEST(DishRaster, TheOrderOfBytesDoesNotMatter) {
  const cv::Mat3b picture = coloured_picture(300, 240, 3);
  cv::Mat3b turned;
  cv::cvtColor(picture, turned, cv::COLOR_BGR2RGB);
  FrameView rgb = test::frame_of(turned);
  rgb.format = PixelFormat::rgb8;
  Rastered a;
  Rastered b;
  ASSERT_TRUE(a.load(test::frame_of(picture), kRasterBox, 3.0));
  ASSERT_TRUE(b.load(rgb, kRasterBox, 3.0));
  for (int y = 0; y < a.raster.height(); ++y) {
    for (int x = 0; x < a.raster.width(); ++x) {
      const CellColour& one = a.raster.colours.at(x, y);
      const CellColour& other = b.raster.colours.at(x, y);
      ASSERT_TRUE(one.luma == other.luma && one.red == other.red && one.green == other.green);
    }
  }
}

// In linear light a shadow is a factor: as sRGB's tone curve has it, half the light keeps the shares but for
// a few units; all of grey has equal shares, whatever its light.
TEST(DishRaster, SharesDoNotTellOfAShadow) {
  const auto shares_of = [](const cv::Vec3b& bgr) {
    const cv::Mat3b picture(240, 300, bgr);
    Rastered cells;
    EXPECT_TRUE(cells.load(test::frame_of(picture), kRasterBox, 3.0));
    return cells.raster.colours.at(10, 10);
  };
  for (int gray = 0; gray < 256; gray += 15) {
    const auto value = static_cast<std::uint8_t>(gray);
    const CellColour colour = shares_of({value, value, value});
    EXPECT_EQ(colour.red, 170);
    EXPECT_EQ(colour.green, 170);
    EXPECT_EQ(colour.luma, gray);
  }
  const auto shaded = [](int value, double light) {
    return cv::saturate_cast<std::uint8_t>(255.0 * std::pow(light * std::pow(value / 255.0, 2.2), 1.0 / 2.2));
  };
  for (const cv::Vec3b& bgr : {cv::Vec3b(60, 120, 200), cv::Vec3b(90, 180, 110), cv::Vec3b(210, 160, 140)}) {
    const CellColour lit = shares_of(bgr);
    const CellColour dark = shares_of({shaded(bgr[0], 0.5), shaded(bgr[1], 0.5), shaded(bgr[2], 0.5)});
    EXPECT_LT(dark.luma, 0.8 * lit.luma);
    EXPECT_NEAR(dark.red, lit.red, 6);
    EXPECT_NEAR(dark.green, lit.green, 6);
  }
  EXPECT_GT(shares_of({40, 40, 220}).red, 240);
  EXPECT_GT(shares_of({40, 220, 40}).green, 240);
}

TEST(DishRaster, TakesLargerCellsWhereMemoryIsShort) {
  DishRasterParams params;
  params.max_cells = 1000;
  const cv::Mat3b picture = coloured_picture(300, 240, 3);
  Rastered cells(params);
  ASSERT_TRUE(cells.load(test::frame_of(picture), kRasterBox, 3.0));
  EXPECT_LE(cells.raster.width() * cells.raster.height(), params.max_cells);
  EXPECT_GT(cells.raster.width() * cells.raster.height(), params.max_cells / 2);
  EXPECT_NEAR(cells.raster.cell_mm, cells.raster.step_px / 3.0, 1e-12);
}

TEST(DishRaster, IsCutOffAtTheFrameAndFailsBeyondIt) {
  const cv::Mat3b picture = coloured_picture(300, 240, 3);
  const auto box = [](double left, double top, double right, double bottom) {
    return std::array<Vec2, 4>{Vec2(left, top), Vec2(right, top), Vec2(right, bottom), Vec2(left, bottom)};
  };
  Rastered cells;
  ASSERT_TRUE(cells.load(test::frame_of(picture), box(-100.0, -50.0, 1e6, 59.0), 2.0));
  EXPECT_EQ(cells.raster.left_px, 0);
  EXPECT_EQ(cells.raster.top_px, 0);
  EXPECT_EQ(cells.raster.width(), 150);
  EXPECT_EQ(cells.raster.height(), 30);
  EXPECT_FALSE(cells.load(test::frame_of(picture), box(400.0, 10.0, 500.0, 90.0), 2.0));
  EXPECT_FALSE(cells.load(test::frame_of(picture), box(10.0, -90.0, 90.0, -20.0), 2.0));
  EXPECT_FALSE(cells.load(test::frame_of(picture), box(10.0, 10.0, 13.0, 13.0), 2.0));  // two cells
  EXPECT_FALSE(cells.load(test::frame_of(picture), {}, 2.0));
}

TEST(DishRaster, CellsAndPixelsAreEachOthersInverse) {
  DishRaster raster;
  raster.left_px = 13;
  raster.top_px = 40;
  raster.step_px = 4;
  // A cell's middle is that of its pixels.
  EXPECT_LT((raster.pixel_of(0.0, 0.0) - Vec2(14.5, 41.5)).norm(), 1e-12);
  for (const Vec2& cell : {Vec2(0.0, 0.0), Vec2(7.25, 3.5), Vec2(-2.0, 100.0)})
    EXPECT_LT((raster.cell_of(raster.pixel_of(cell.x(), cell.y())) - cell).norm(), 1e-12);
}

// OpenCV's fill takes in the border, ours the centres that lie inside.
TEST(DishRaster, MarksTheCellsWithinAnOutline) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> size(20.0, 110.0);
  const cv::Mat3b picture = coloured_picture(300, 240, 3);
  for (int round = 0; round < 30; ++round) {
    Rastered cells;
    ASSERT_TRUE(cells.load(test::frame_of(picture), kRasterBox, 3.0));
    const Vec2 semi(size(random), size(random));
    std::vector<Vec2> outline;
    std::vector<cv::Point2f> polygon;
    for (int i = 0; i < 90; ++i) {
      const double t = 2.0 * CV_PI * i / 90.0;
      outline.emplace_back(140.0 + semi.x() * std::cos(t), 120.0 + semi.y() * std::sin(t));
      polygon.emplace_back(static_cast<float>(outline.back().x()), static_cast<float>(outline.back().y()));
    }
    mark_zone(cells.raster, outline, DishZone::flange);
    int marked = 0;
    for (int y = 0; y < cells.raster.height(); ++y) {
      for (int x = 0; x < cells.raster.width(); ++x) {
        const Vec2 pixel = cells.raster.pixel_of(x, y);
        const double inside_px = cv::pointPolygonTest(
            polygon, {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())}, true);
        const bool is_marked = cells.raster.zones.at(x, y) == DishZone::flange;
        marked += is_marked ? 1 : 0;
        if (std::abs(inside_px) > 1e-3) {
          ASSERT_EQ(is_marked, inside_px > 0.0);
        }
      }
    }
    EXPECT_GT(marked, 100);
  }
}

}  // namespace
}  // namespace traygauge
