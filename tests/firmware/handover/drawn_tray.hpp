// A measured tray whose shape is known: a level disc of food on a level dish.
#pragma once

#include <array>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "core/pipeline/measurement.hpp"

namespace traygauge::test {

class DrawnTray {
 public:
  static constexpr double kCellMm = 0.85;
  static constexpr int kCells = 200;
  static constexpr double kDiscRadiusMm = 40.0;
  static constexpr float kFoodMm = 32.5F;
  static constexpr float kDishMm = 10.0F;
  static constexpr std::uint8_t kFood = 2;

  DrawnTray() : cells_(static_cast<std::size_t>(kCells) * kCells) {
    surface_.heights.cells = {cells_.data(), kCells, kCells, kCells};
    surface_.heights.cell_mm = kCellMm;
    surface_.heights.origin_mm = {100.0, 50.0};
    const Vec2 middle = middle_mm();
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x) {
        const double distance_mm = (surface_.heights.centre_mm(x, y) - middle).norm();
        HeightCell& cell = cells_[static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x)];
        if (distance_mm > 80.0) continue;
        const bool is_food = distance_mm < kDiscRadiusMm;
        cell = {is_food ? kFoodMm : kDishMm, 0.0F, is_food ? kFood : kDishLabel, 0, CellKind::surface, 255};
      }
    }
    items_[0].label = kFood;
    items_[0].volume_ml = 100.0;
    measurement_.items = items_;
    measurement_.views.surfaces = {&surface_, 1};
  }
  DrawnTray(const DrawnTray&) = delete;
  DrawnTray& operator=(const DrawnTray&) = delete;

  Vec2 middle_mm() const { return surface_.heights.centre_mm(kCells / 2, kCells / 2); }
  const Measurement& measurement() const { return measurement_; }
  const HeightMap& heights() const { return surface_.heights; }
  HeightCell& cell(int x, int y) {
    return cells_[static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x)];
  }

 private:
  std::vector<HeightCell> cells_;
  MeasuredSurface surface_;
  std::array<ItemResult, 1> items_;
  Measurement measurement_;
};

}  // namespace traygauge::test
