#include "firmware/hub/shape_shelf.hpp"

#include <algorithm>
#include <utility>

#include "firmware/hub/scan_shape_reader.hpp"

namespace traygauge {

Expected<void> ShapeShelf::put(const ScanId& id, std::string json) {
  const Expected<ReadShape> shape = read_shape(json);
  if (!shape.ok()) return Failure{"the shape of scan " + scan_id_text(id) + ": " + shape.failure()};
  if (shape->id != scan_id_text(id))
    return Failure{"the shape of scan " + scan_id_text(id) + " says that it is of " + shape->id};
  std::erase_if(shapes_, [&](const Shape& other) {
    if (!(other.id == id)) return false;
    bytes_ -= other.json->size();
    return true;
  });
  bytes_ += json.size();
  shapes_.push_back({id, std::make_shared<const std::string>(std::move(json))});
  while (shapes_.size() > limits_.max_shapes || (bytes_ > limits_.max_bytes && shapes_.size() > 1)) {
    bytes_ -= shapes_.front().json->size();
    shapes_.pop_front();
  }
  return {};
}

std::shared_ptr<const std::string> ShapeShelf::find(const ScanId& id) const {
  const auto found =
      std::find_if(shapes_.begin(), shapes_.end(), [&](const Shape& shape) { return shape.id == id; });
  return found == shapes_.end() ? nullptr : found->json;
}

}  // namespace traygauge
