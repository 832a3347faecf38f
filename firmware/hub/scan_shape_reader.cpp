#include "firmware/hub/scan_shape_reader.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMaxSide = 4096;
// A table's height above and below the tray, in tenths of a mm.
constexpr int kMaxTenthMm = 100'000;
constexpr int kMaxLabel = 199;

const Json* part(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found == json.end() ? nullptr : &*found;
}

bool read_side(const Json& json, const char* key, int& side) {
  const Json* const found = part(json, key);
  if (found == nullptr || !found->is_number_unsigned() || *found < 1 || *found > kMaxSide) return false;
  side = found->get<int>();
  return true;
}

// As many numbers as there are cells, each within the limit, or null.
bool read_cells(const Json* json, std::size_t count, std::vector<std::optional<int>>& cells) {
  if (json == nullptr || !json->is_array() || json->size() != count) return false;
  cells.reserve(count);
  for (const Json& cell : *json) {
    if (cell.is_null()) {
      cells.emplace_back();
    } else if (cell.is_number_integer() && cell >= -kMaxTenthMm && cell <= kMaxTenthMm) {
      cells.emplace_back(cell.get<int>());
    } else {
      return false;
    }
  }
  return true;
}

bool read_labels(const Json* json, std::size_t count, std::vector<int>& labels) {
  if (json == nullptr || !json->is_array() || json->size() != count) return false;
  labels.reserve(count);
  for (const Json& label : *json) {
    if (!label.is_number_unsigned() || label > kMaxLabel) return false;
    labels.push_back(label.get<int>());
  }
  return true;
}

bool read_dish(const Json& json, DishShape& dish) {
  if (!json.is_object() || !read_side(json, "dish", dish.dish) || !read_side(json, "columns", dish.columns) ||
      !read_side(json, "rows", dish.rows)) {
    return false;
  }
  const Json* const cell = part(json, "cell_mm");
  const Json* const origin = part(json, "origin_mm");
  if (cell == nullptr || !cell->is_number() || !(*cell > 0.0) || origin == nullptr || !origin->is_array() ||
      origin->size() != 2 || !(*origin)[0].is_number() || !(*origin)[1].is_number()) {
    return false;
  }
  dish.cell_mm = cell->get<double>();
  dish.origin_x_mm = (*origin)[0].get<double>();
  dish.origin_y_mm = (*origin)[1].get<double>();
  const std::size_t count = dish.index(0, dish.rows);
  return read_cells(part(json, "surface_tenth_mm"), count, dish.surface_tenth_mm) &&
         read_cells(part(json, "inner_tenth_mm"), count, dish.inner_tenth_mm) &&
         read_labels(part(json, "labels"), count, dish.labels);
}

bool is_outline(const Json& json) {
  const Json* const label = part(json, "label");
  const Json* const points = part(json, "points_mm");
  if (label == nullptr || !label->is_number_unsigned() || points == nullptr || !points->is_array())
    return false;
  return std::ranges::all_of(*points, [](const Json& point) {
    return point.is_array() && point.size() == 2 && point[0].is_number() && point[1].is_number();
  });
}

}  // namespace

Expected<ReadShape> read_shape(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  const Json* const id = json.is_object() ? part(json, "id") : nullptr;
  const Json* const dishes = json.is_object() ? part(json, "dishes") : nullptr;
  const Json* const outlines = json.is_object() ? part(json, "outlines") : nullptr;
  if (id == nullptr || !id->is_string() || dishes == nullptr || !dishes->is_array() || outlines == nullptr ||
      !outlines->is_array()) {
    return Failure{"expected an object with id, dishes and outlines, found something else"};
  }
  ReadShape shape;
  shape.id = id->get<std::string>();
  for (const Json& one : *dishes) {
    if (!read_dish(one, shape.dishes.emplace_back()))
      return Failure{
          "dish " + std::to_string(shape.dishes.size()) +
          ": expected cell_mm, origin_mm and, for columns times rows cells, heights in tenths of a "
          "mm and labels to 199; found something else"};
  }
  for (const Json& one : *outlines) {
    if (!one.is_object() || !is_outline(one))
      return Failure{"outlines: expected a label and points of two numbers each, found something else"};
  }
  return shape;
}

}  // namespace traygauge
