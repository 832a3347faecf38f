// A plate drawn with food on it, what two views would say about its relief, and what a network would read.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "core/segmentation/food_outline.hpp"
#include "tests/core/segmentation/drawn_reading.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge::test {

inline constexpr int kSide = 600;
inline constexpr double kPxPerMm = 2.5;
inline constexpr double kRimPx = 290.0;

struct Disc {
  double x = 0.0;
  double y = 0.0;
  double radius = 0.0;
  std::array<int, 3> bgr{};
  double height_mm = 20.0;  // flat, with a steep edge
  int grain = 0;            // grey values, from pixel to pixel
  // Of pieces that are mixed with those of `bgr`; the same where there are none.
  std::optional<std::array<int, 3>> other_bgr{};
  bool is_agreed = true;   // by both views, upon its height
  int food = 0;            // discs of one food have one embedding
  double margin = 0.0;     // of the network, which knows nothing of the rest of the plate
  double lift_bits = 5.0;  // of a census window, by which it matches better upon its height than on the glaze
};

inline Disc of_food(int food, Disc disc) {
  disc.food = food;
  return disc;
}

inline Disc with_margin(double margin, Disc disc) {
  disc.margin = margin;
  return disc;
}

inline double distance(double x, double y, const Disc& disc) {
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
    EXPECT_TRUE(load_dish_raster(frame, rim, kPxPerMm, params_.raster, memory_->raster, raster));
    mark_zone(raster, rim, DishZone::edge);
    rim = ring(kRimPx - 6.0);
    mark_zone(raster, rim, DishZone::flange);
    rim = ring(kRimPx - 60.0);
    mark_zone(raster, rim, DishZone::inside);
    labels.assign(static_cast<std::size_t>(raster.width() * raster.height()), 0);
    const ImageView<std::uint8_t> cells{labels.data(), raster.width(), raster.height()};
    lay_height_evidence(raster);
    const ImageView<const HeightSample> relief{relief_.data(), raster.width(), raster.height()};
    draw_reading();
    const PictureReading reading = reading_.view();
    const OutlinedFood outlined = outline_food({raster, relief, reading}, params_, *memory_, cells);
    EXPECT_TRUE(outlined.is_outlined);
    is_told_by_height_ = outlined.is_told_by_height;
    return label_items(raster, reading, params_, *memory_, kFirstItemLabel, 100, cells).items;
  }

  // Some of the food, at the last call of outline().
  bool is_told_by_height() const { return is_told_by_height_; }

  // Share of the cells whose being food or not is right.
  double right_fraction(const std::vector<std::uint8_t>& labels, const DishRaster& raster) const {
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

  // Share of the cells of either food that are those of the item at its middle.
  double item_fraction(const std::vector<std::uint8_t>& labels, const DishRaster& raster) const {
    int right = 0;
    int all = 0;
    for (int y = 0; y < raster.height(); ++y) {
      for (int x = 0; x < raster.width(); ++x) {
        const Vec2 pixel = raster.pixel_of(x, y);
        const Disc* on = nullptr;
        for (const Disc& disc : food_) {
          if (distance(pixel.x(), pixel.y(), disc) < disc.radius) on = &disc;
        }
        if (on == nullptr) continue;
        const Vec2 middle = raster.cell_of({on->x, on->y});
        const auto label_at = [&](double i, double j) {
          return labels[static_cast<std::size_t>(std::lround(j) * raster.width() + std::lround(i))];
        };
        right += label_at(x, y) == label_at(middle.x(), middle.y()) ? 1 : 0;
        ++all;
      }
    }
    return static_cast<double>(right) / all;
  }

 private:
  // What two views would say: food of some height differs where it is compared on the glaze. Noise as of
  // census windows; without relief nothing is known.
  void lay_height_evidence(const DishRaster& raster) {
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
        bool is_agreed = true;
        double lift_bits = 0.0;
        for (const Disc& disc : food_) {
          const double part = distance(pixel.x(), pixel.y(), disc) / disc.radius;
          if (part >= 1.0) continue;
          is_agreed = disc.is_agreed;
          lift_bits = disc.lift_bits;
          height_mm = std::max(height_mm, disc.height_mm * std::min(1.0, 6.0 * (1.0 - part)));
        }
        HeightSample& sample = relief_[static_cast<std::size_t>(y * raster.width() + x)];
        sample.is_known = true;
        sample.is_confirmed = is_agreed;
        sample.height = static_cast<std::int8_t>(std::lround(height_mm / kHeightUnitMm));
        sample.food_cost = doubled(9.0);
        sample.glaze_cost = height_mm > 0.0 ? doubled(9.0 + lift_bits) : sample.food_cost;
      }
    }
  }

  // Embeddings of two foods differ by 3, as the network's training asks for.
  void draw_reading() {
    const auto at = [&](const Vec2& pixel) {
      const Disc* on = nullptr;
      for (const Disc& disc : food_) {
        if (distance(pixel.x(), pixel.y(), disc) < disc.radius) on = &disc;
      }
      return on;
    };
    reading_.draw(
        [&](const Vec2& pixel) {
          const Disc* on = at(pixel);
          return on == nullptr ? 0.0 : on->margin;
        },
        [&](const Vec2& pixel, int channel) {
          const Disc* on = at(pixel);
          return on != nullptr && on->food == channel ? 3.0 / std::numbers::sqrt2 : 0.0;
        });
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
  bool is_told_by_height_ = false;
  DrawnReading reading_{kSide, 8};
  std::vector<HeightSample> relief_;
  std::vector<std::uint8_t> pixels_;
  FoodOutlineParams params_;
  test::Allocated<FoodOutlineWorkspace> memory_{FoodOutlineParams{}};
};

inline constexpr std::array<int, 3> kWhite = {204, 209, 214};
inline constexpr std::array<int, 3> kGreen = {40, 130, 50};
inline constexpr std::array<int, 3> kBrown = {40, 80, 150};
inline constexpr std::array<int, 3> kOchre = {50, 110, 160};
inline constexpr std::array<int, 3> kOrange = {40, 110, 210};

}  // namespace traygauge::test
