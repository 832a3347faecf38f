#include "firmware/hub/shape_shelf.hpp"

#include <utility>

#include "firmware/hub/scan_shape_reader.hpp"

namespace traygauge {

Expected<void> ShapeShelf::put(const ScanId& id, std::string json) {
  const Expected<ReadShape> shape = read_shape(json);
  if (!shape.ok()) return Failure{"the shape of scan " + scan_id_text(id) + ": " + shape.failure()};
  if (shape->id != scan_id_text(id))
    return Failure{"the shape of scan " + scan_id_text(id) + " says that it is of " + shape->id};
  shapes_.put(id, std::move(json));
  return {};
}

}  // namespace traygauge
