// What the last trays looked like, in memory alone.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "firmware/base/expected.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/hub/recent_bodies.hpp"

namespace traygauge {

struct ShapeShelfLimits {
  // A page shows the last tray, and who corrects a scan looks back over the last quarter of an hour.
  std::size_t max_shapes = 20;
  // A dish has some 150 kB; a tray with six large ones is a megabyte.
  std::size_t max_bytes = 4UL * 1024 * 1024;
};

// Used by one thread.
class ShapeShelf {
 public:
  explicit ShapeShelf(ShapeShelfLimits limits = {}) : shapes_({limits.max_shapes, limits.max_bytes}) {}

  // Takes the place of an earlier one of that scan; the oldest leave. Fails, and keeps nothing, where the
  // text is not a shape of that scan.
  Expected<void> put(const ScanId& id, std::string json);
  // Null where none is kept.
  std::shared_ptr<const std::string> find(const ScanId& id) const { return shapes_.find(id); }

 private:
  RecentBodies shapes_;
};

}  // namespace traygauge
