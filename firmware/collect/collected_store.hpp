// Events of many hubs, each once.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/collect/collect_config.hpp"
#include "firmware/collect/collected_event.hpp"

namespace traygauge {

struct StoredBatch {
  std::size_t stored = 0;          // for the first time
  std::size_t repeated = 0;        // had come before
  std::vector<std::string> twins;  // ids that another tray has, too; both are kept, the later ones in `twins`
};

// A body that came again may say more, after a correction. But where hub or time differ, it is another tray,
// of a station whose name is given twice or whose numbers began anew.
class CollectedStore {
 public:
  CollectedStore() = default;
  CollectedStore(const CollectedStore&) = delete;
  CollectedStore& operator=(const CollectedStore&) = delete;
  virtual ~CollectedStore() = default;

  // All of it is on disk when this returns ok, else nothing of it. `received_ms`: UTC.
  virtual Expected<StoredBatch> put(std::span<const CollectedEvent> events, std::int64_t received_ms) = 0;
  virtual Expected<std::int64_t> count() = 0;
};

// The one that a configuration names. The failure names it, and says what to do.
Expected<std::unique_ptr<CollectedStore>> open_collected_store(const StoreConfig& config);

}  // namespace traygauge
