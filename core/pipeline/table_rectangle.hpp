// A rectangle of the table, along its axes: where something may stand.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

struct TableRectangle {
  Vec2 least_mm = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 most_mm = -least_mm;

  bool empty() const { return !(least_mm.array() < most_mm.array()).all(); }
  Vec2 middle_mm() const { return 0.5 * (least_mm + most_mm); }
  Vec2 size_mm() const { return most_mm - least_mm; }
  double area_mm2() const { return empty() ? 0.0 : size_mm().prod(); }

  void include(const TableRectangle& other) {
    least_mm = least_mm.cwiseMin(other.least_mm);
    most_mm = most_mm.cwiseMax(other.most_mm);
  }
  TableRectangle shared_with(const TableRectangle& other) const {
    return {least_mm.cwiseMax(other.least_mm), most_mm.cwiseMin(other.most_mm)};
  }
  TableRectangle grown(double margin_mm) const {
    return {least_mm - Vec2::Constant(margin_mm), most_mm + Vec2::Constant(margin_mm)};
  }
};

// Includes what a box of a picture shows at this height over the table; false where it shows no such place.
bool include_box(const LensModel& lens, const Pose& camera_from_table, const PixelBox& box, double height_mm,
                 TableRectangle& rectangle);

// Joins places that are near each other, until no two are. Returns how many are left; these stand first.
// `joined`, if it is not empty, has a number for each place: which of those left holds it.
std::size_t join_near(std::span<TableRectangle> places, double distance_mm,
                      std::span<std::size_t> joined = {});

}  // namespace traygauge
