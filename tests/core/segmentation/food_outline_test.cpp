// Food drawn on a plate: where it is and of how many items is known.
#include "core/segmentation/food_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "tests/core/matching/workspace_block.hpp"

namespace traygauge {
namespace {

constexpr int kSide = 600;
constexpr double kPxPerMm = 2.5;
constexpr double kRimPx = 290.0;

struct Disc {
  double x = 0.0;
  double y = 0.0;
  double radius = 0.0;
  std::array<int, 3> bgr{};
  double height_mm = 20.0;  // flat, with a steep edge
  int grain = 0;            // grey values, from pixel to pixel
  // Of pieces that are mixed with those of `bgr`; the same where there are none.
  std::optional<std::array<int, 3>> other_bgr{};
};

double distance(double x, double y, const Disc& disc) {
  return std::sqrt((x - disc.x) * (x - disc.x) + (y - disc.y) * (y - disc.y));
}

// A round plate lit from the left: its shade falls by `shade` across it, without an edge. Seen from above.
class Plate {
 public:
  explicit Plate(std::vector<Disc> food, double shade = 0.1, bool has_relief = true)
      : food_(std::move(food)), has_relief_(has_relief) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, 2.0);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        std::array<int, 3> bgr = {40, 50, 60};
        if (distance(x, y, {300, 300, 0, {}}) < kRimPx) bgr = {205, 210, 215};
        for (const Disc& disc : food_) {
          if (distance(x, y, disc) >= disc.radius) continue;
          bgr = disc.other_bgr && piece_at(x, y) ? *disc.other_bgr : disc.bgr;
          const int grain =
              disc.grain > 0
                  ? static_cast<int>(random() % (2U * static_cast<unsigned>(disc.grain))) - disc.grain
                  : 0;
          for (int& value : bgr) value += grain;
        }
        for (const int value : bgr) {
          const double lit = value * (1.0 - shade * x / kSide) + noise(random);
          pixels_.push_back(static_cast<std::uint8_t>(std::clamp(lit, 0.0, 255.0)));
        }
      }
    }
  }

  // Labels of the cells; returns the number of items.
  int outline(std::vector<std::uint8_t>& labels, DishRaster& raster) {
    const FrameView frame{pixels_.data(), kSide, kSide, 3 * kSide, PixelFormat::bgr8};
    std::vector<Vec2> rim = ring(kRimPx);
    EXPECT_TRUE(load_dish_raster(frame, rim, kPxPerMm, params_.raster, memory_.workspace.raster, raster));
    mark_zone(raster, rim, DishZone::edge);
    rim = ring(kRimPx - 6.0);
    mark_zone(raster, rim, DishZone::flange);
    rim = ring(kRimPx - 60.0);
    mark_zone(raster, rim, DishZone::inside);
    labels.assign(static_cast<std::size_t>(raster.width() * raster.height()), 0);
    const ImageView<std::uint8_t> cells{labels.data(), raster.width(), raster.height()};
    lay_relief(raster);
    const ImageView<const ReliefSample> relief{relief_.data(), raster.width(), raster.height()};
    EXPECT_TRUE(outline_food(raster, relief, params_, memory_.workspace, cells));
    return label_items(raster, relief, params_, memory_.workspace, kFirstItemLabel, 100, cells);
  }

  // Share of the cells whose being food or not is right.
  double right_share(const std::vector<std::uint8_t>& labels, const DishRaster& raster) const {
    int right = 0;
    for (int y = 0; y < raster.height(); ++y) {
      for (int x = 0; x < raster.width(); ++x) {
        const Vec2 pixel = raster.pixel_of(x, y);
        bool is_food = false;
        for (const Disc& disc : food_) is_food |= distance(pixel.x(), pixel.y(), disc) < disc.radius;
        if (is_food == is_item(labels[static_cast<std::size_t>(y * raster.width() + x)])) ++right;
      }
    }
    return static_cast<double>(right) / (raster.width() * raster.height());
  }

 private:
  // What two views would say: food of some height differs where it is compared on the glaze. Noise as of
  // census windows; without relief nothing is known.
  void lay_relief(const DishRaster& raster) {
    relief_.assign(static_cast<std::size_t>(raster.width() * raster.height()), {});
    if (!has_relief_) return;
    std::mt19937 random(11);
    std::normal_distribution<double> bits(0.0, 1.5);
    const auto doubled = [&](double mean) {
      return static_cast<std::uint8_t>(std::clamp(2.0 * (mean + bits(random)), 0.0, 62.0));
    };
    for (int y = 0; y < raster.height(); ++y) {
      for (int x = 0; x < raster.width(); ++x) {
        const Vec2 pixel = raster.pixel_of(x, y);
        double height_mm = 0.0;
        for (const Disc& disc : food_) {
          const double part = distance(pixel.x(), pixel.y(), disc) / disc.radius;
          if (part < 1.0) height_mm = std::max(height_mm, disc.height_mm * std::min(1.0, 6.0 * (1.0 - part)));
        }
        ReliefSample& sample = relief_[static_cast<std::size_t>(y * raster.width() + x)];
        sample.is_known = true;
        sample.height = static_cast<std::int8_t>(std::lround(height_mm / kReliefUnitMm));
        sample.food_cost = doubled(9.0);
        sample.glaze_cost = height_mm > 0.0 ? doubled(14.0) : sample.food_cost;
      }
    }
  }

  // Pieces of 8 mm, either kind as often.
  static bool piece_at(int x, int y) {
    const auto cell = static_cast<std::uint32_t>(x / 20 + 71 * (y / 20));
    return ((cell * 2654435761U) >> 16U & 1U) != 0;
  }

  static std::vector<Vec2> ring(double radius) {
    std::vector<Vec2> points;
    for (int i = 0; i < 120; ++i)
      points.emplace_back(300.0 + radius * std::cos(i * 0.05236), 300.0 + radius * std::sin(i * 0.05236));
    return points;
  }

  std::vector<Disc> food_;
  bool has_relief_;
  std::vector<ReliefSample> relief_;
  std::vector<std::uint8_t> pixels_;
  FoodOutlineParams params_;
  WithMemory<FoodOutlineWorkspace> memory_{FoodOutlineParams{}};
};

constexpr std::array<int, 3> kGreen = {40, 130, 50};
constexpr std::array<int, 3> kBrown = {40, 80, 150};
constexpr std::array<int, 3> kOchre = {50, 110, 160};
constexpr std::array<int, 3> kOrange = {40, 110, 210};

TEST(FoodOutline, EmptyPlateHasNoFood) {
  Plate plate({}, 0.25);
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  EXPECT_EQ(plate.outline(labels, raster), 0);
  EXPECT_EQ(plate.right_share(labels, raster), 1.0);
}

TEST(FoodOutline, PilesApartAreItemsOfTheirOwn) {
  Plate plate({{220, 250, 60, kGreen}, {390, 330, 70, kGreen}});
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  EXPECT_EQ(plate.outline(labels, raster), 2);
  EXPECT_GT(plate.right_share(labels, raster), 0.995);
}

TEST(FoodOutline, ColourSplitsPilesThatTouch) {
  Plate plate({{240, 300, 70, kGreen}, {365, 300, 65, kBrown}});
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  EXPECT_EQ(plate.outline(labels, raster), 2);
  const auto label_at = [&](double x, double y) {
    const Vec2 cell = raster.cell_of({x, y});
    return labels[static_cast<std::size_t>(std::lround(cell.y()) * raster.width() + std::lround(cell.x()))];
  };
  EXPECT_NE(label_at(240, 300), label_at(380, 300));
  EXPECT_EQ(label_at(200, 280), label_at(285, 300));
  EXPECT_EQ(label_at(320, 300), label_at(400, 340));
}

TEST(FoodOutline, CrumbsAndLinesOfDecorationAreNoFood) {
  std::vector<Disc> crumbs;
  for (int i = 0; i < 12; ++i) crumbs.push_back({100.0 + 33.0 * i, 200.0 + 10.0 * i, 5.0, kBrown});
  Plate plate(crumbs);
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  EXPECT_EQ(plate.outline(labels, raster), 0);
}

TEST(FoodOutline, FoodOfTheGlazesColourIsToldByItsHeight) {
  constexpr std::array<int, 3> kWhite = {204, 209, 214};
  const Disc mash{260, 310, 80, kWhite, 20.0, 14};
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  Plate plate({mash});
  EXPECT_EQ(plate.outline(labels, raster), 1);
  EXPECT_GT(plate.right_share(labels, raster), 0.98);
  Plate blind({mash}, 0.1, false);
  EXPECT_EQ(blind.outline(labels, raster), 0);
}

TEST(FoodOutline, GlazeTintedByFoodIsToldByLyingFlat) {
  constexpr std::array<int, 3> kTint = {180, 205, 228};
  const std::vector<Disc> discs = {{220, 250, 60, kBrown}, {400, 350, 60, kTint, 0.0}};
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  Plate plate(discs);
  EXPECT_EQ(plate.outline(labels, raster), 1);
  Plate blind(discs, 0.1, false);
  EXPECT_EQ(blind.outline(labels, raster), 2);
}

TEST(FoodOutline, MixedPiecesAreOneItem) {
  const std::vector<Disc> discs = {{220, 260, 85, kOrange, 20.0, 0, kGreen}, {410, 340, 70, kBrown}};
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  Plate plate(discs);
  EXPECT_EQ(plate.outline(labels, raster), 2);
}

TEST(FoodOutline, WhatLiesWithinAnItemIsItsOwnOnlyWhereItStandsOut) {
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  Plate level({{300, 300, 110, kBrown, 15.0}, {300, 300, 50, kOchre, 15.0}});
  EXPECT_EQ(level.outline(labels, raster), 1);
  Plate raised({{300, 300, 110, kBrown, 15.0}, {300, 300, 50, kOchre, 45.0}});
  EXPECT_EQ(raised.outline(labels, raster), 2);
}

TEST(FoodOutline, NoFlangeNoAnswer) {
  DishRasterParams params;
  WithMemory<FoodOutlineWorkspace> memory{FoodOutlineParams{}};
  const std::vector<std::uint8_t> pixels(std::size_t{3} * 64 * 64, 200);
  const FrameView frame{pixels.data(), 64, 64, 3 * 64, PixelFormat::bgr8};
  const std::vector<Vec2> box = {{0, 0}, {63, 0}, {63, 63}, {0, 63}};
  DishRaster raster;
  ASSERT_TRUE(load_dish_raster(frame, box, kPxPerMm, params, memory.workspace.raster, raster));
  std::vector<std::uint8_t> labels(static_cast<std::size_t>(raster.width() * raster.height()));
  const std::vector<ReliefSample> relief(labels.size());
  EXPECT_FALSE(outline_food(raster, {relief.data(), raster.width(), raster.height()}, {}, memory.workspace,
                            {labels.data(), raster.width(), raster.height()}));
}

// Without an outline's cost every cell is what its own evidence says; with a great one all are alike.
TEST(FoodField, OutlineCostDecidesHowFarCellsAgree) {
  constexpr int kWide = 40;
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<CellColour> colours(kWide * kWide, {200, 170, 170});
    std::vector<DishZone> zones(colours.size(), DishZone::inside);
    std::vector<ReliefSample> relief(colours.size());
    int lifted = 0;
    for (ReliefSample& sample : relief) {
      const bool is_lifted = random() % 3 == 0;
      sample = {40, 10, static_cast<std::uint8_t>(is_lifted ? 60 : 10), true};
      lifted += is_lifted ? 1 : 0;
    }
    DishRaster raster;
    raster.colours = {colours.data(), kWide, kWide};
    raster.zones = {zones.data(), kWide, kWide};
    FoodFieldParams params;
    params.fold = 1;
    params.sweeps = 400;
    const GlazeColour glaze{colours.front(), 4.0, 1.0};
    WithMemory<FoodFieldWorkspace> memory{kWide * kWide};
    std::vector<std::uint8_t> cells(colours.size());
    const auto count_food = [&] {
      find_food(raster, {relief.data(), kWide, kWide}, glaze, params, memory.workspace,
                {cells.data(), kWide, kWide});
      return static_cast<int>(std::count(cells.begin(), cells.end(), kFoodSeed));
    };
    params.outline = 0.0;
    EXPECT_EQ(count_food(), lifted);
    params.outline = 50.0;
    EXPECT_EQ(count_food(), 0);
  }
}

// Against the shortest ways by relaxing every cell until nothing changes.
TEST(Geodesic, OwnersAreThoseOfTheShortestWay) {
  constexpr int kWidth = 23;
  constexpr int kHeight = 17;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<CellColour> colours(kWidth * kHeight);
    for (CellColour& colour : colours)
      colour = {static_cast<std::uint8_t>(random() % 60), static_cast<std::uint8_t>(random() % 20), 100};
    std::vector<std::uint8_t> owners(colours.size(), kNoOwner);
    for (int i = 0; i < 4; ++i) owners[random() % owners.size()] = static_cast<std::uint8_t>(1 + i);
    for (int i = 0; i < 60; ++i) owners[random() % owners.size()] = kBarred;
    const std::vector<std::uint8_t> seeds = owners;
    WithMemory<GeodesicWorkspace> memory{kWidth * kHeight};
    const GeodesicParams params;
    spread_owners({colours.data(), kWidth, kHeight}, params, memory.workspace,
                  {owners.data(), kWidth, kHeight});

    const auto cost = [&](int a, int b) {
      const auto& p = colours[static_cast<std::size_t>(a)];
      const auto& q = colours[static_cast<std::size_t>(b)];
      const int luma = p.luma - q.luma;
      const int red = p.red - q.red;
      const int squares = params.luma_weight * luma * luma + params.share_weight * red * red;
      return std::min(params.step_cost + squares / 16, kMaxGeodesicStep);
    };
    for (int label = 1; label <= 4; ++label) {
      std::vector<int> distance(colours.size(), 1 << 20);
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (seeds[i] == label) distance[i] = 0;
      }
      for (bool changed = true; changed;) {
        changed = false;
        for (int y = 0; y < kHeight; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            const int cell = y * kWidth + x;
            const auto at = static_cast<std::size_t>(cell);
            if (seeds[at] == kBarred) continue;
            for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
              if (x + dx < 0 || y + dy < 0 || x + dx >= kWidth || y + dy >= kHeight) continue;
              const int other = cell + dy * kWidth + dx;
              const int way = distance[static_cast<std::size_t>(other)] + cost(cell, other);
              if (way >= distance[at]) continue;
              distance[at] = way;
              changed = true;
            }
          }
        }
      }
      // No label comes nearer than the one that owns the cell.
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (seeds[i] == kBarred) {
          EXPECT_EQ(owners[i], kBarred);
        } else if (owners[i] == label) {
          EXPECT_EQ(memory.workspace.distance[i], distance[i]);
        } else if (owners[i] != kNoOwner) {
          EXPECT_LE(memory.workspace.distance[i], distance[i]);
        } else {
          EXPECT_GE(distance[i], 1 << 20);
        }
      }
    }
  }
}

}  // namespace
}  // namespace traygauge
