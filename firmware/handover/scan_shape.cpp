#include "firmware/handover/scan_shape.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "core/labels/label_regions.hpp"
#include "firmware/handover/cell_outlines.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

// A screen shows a dish of 260 mm on some 600 pixels: finer cells are not seen, and cost the hub's memory.
constexpr double kLeastCellMm = 2.0;
constexpr double kOutlineToleranceMm = 0.5;

double rounded_mm(double value_mm) {
  return std::round(value_mm * 10.0) / 10.0;
}

// In tenths of a mm, which are shorter to write than numbers with a point.
Json tenths(double value_mm) {
  return std::isfinite(value_mm) ? Json(std::lround(value_mm * 10.0)) : Json();
}

Json point(const Vec2& place_mm) {
  return {rounded_mm(place_mm.x()), rounded_mm(place_mm.y())};
}

Json dish_shape(const MeasuredSurface& surface) {
  const HeightMap& map = surface.heights;
  const int stride = std::max(1, static_cast<int>(std::ceil(kLeastCellMm / map.cell_mm)));
  const int columns = (map.cells.width + stride - 1) / stride;
  const int rows = (map.cells.height + stride - 1) / stride;
  Json upper = Json::array();
  Json inner = Json::array();
  Json labels = Json::array();
  for (int y = 0; y < map.cells.height; y += stride) {
    for (int x = 0; x < map.cells.width; x += stride) {
      const HeightCell& cell = map.cells.at(x, y);
      const bool is_on_dish = cell.label != kBackgroundLabel;
      upper.push_back(is_on_dish && cell.kind != CellKind::unseen ? tenths(cell.z_mm) : Json());
      inner.push_back(is_on_dish ? tenths(surface.inner.height_mm(map.centre_mm(x, y))) : Json());
      labels.push_back(is_item(cell.label) ? cell.label : 0);
    }
  }
  return {{"dish", surface.dish},
          {"cell_mm", map.cell_mm * stride},
          {"columns", columns},
          {"rows", rows},
          {"origin_mm", point(map.origin_mm)},
          {"surface_tenth_mm", std::move(upper)},
          {"inner_tenth_mm", std::move(inner)},
          {"labels", std::move(labels)}};
}

void add_outlines(const MeasuredSurface& surface, std::span<const ItemResult> items, Json& outlines) {
  for (const ItemResult& item : items) {
    if (item.dish != surface.dish) continue;
    for (const Outline& outline : outline_label(surface.heights, item.label, kOutlineToleranceMm)) {
      Json points = Json::array();
      for (const Vec2& place_mm : outline) points.push_back(point(place_mm));
      outlines.push_back({{"label", item.label}, {"dish", item.dish}, {"points_mm", std::move(points)}});
    }
  }
}

}  // namespace

std::string compose_shape(const Measurement& measurement, std::string_view id) {
  if (measurement.views.surfaces.empty()) return {};
  Json json = {{"id", id}, {"dishes", Json::array()}, {"outlines", Json::array()}};
  for (const MeasuredSurface& surface : measurement.views.surfaces) {
    json["dishes"].push_back(dish_shape(surface));
    add_outlines(surface, measurement.items, json["outlines"]);
  }
  return json.dump();
}

}  // namespace traygauge
