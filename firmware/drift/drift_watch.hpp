// What the last scans of each station say together. It is read from the stored documents and then kept as
// scans come in, so that a hub that was started anew says the same.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/drift/drift.hpp"
#include "firmware/drift/scan_window.hpp"
#include "firmware/hub/hub_store.hpp"

namespace traygauge {

struct StationTrends {
  std::string station;
  std::int64_t last_received_ms = 0;  // when the hub stored its last scan
  std::vector<CheckTrend> trends;     // of the values that a scan has, in the order of WatchedCheck
};

// Whether the station has measured within DriftParams::forgotten_after. A clock that was set back says so,
// too.
bool still_measures(const StationTrends& station, const WallTime& now, const DriftParams& params);

// Used by one thread. The store outlives it.
class DriftWatch {
 public:
  explicit DriftWatch(HubStore& store, DriftParams params = {}) : hub_store_(store), params_(params) {}

  // Reads the store where it was opened since, or could not be read, a minute ago at least. Else does
  // nothing.
  Expected<void> follow(std::chrono::steady_clock::time_point now);
  // A scan was stored or corrected.
  void note(const ScanId& id);

  // By the names of the stations. Scans that retention deletes count until the hub is started anew.
  std::vector<StationTrends> trends() const;
  const DriftParams& params() const { return params_; }

 private:
  struct Station {
    ScanWindow first;
    ScanWindow last;
  };

  Expected<void> read_all(Store& store);
  Station empty_station() const;
  Expected<Station> read_station(Store& store, const std::string& name) const;
  Expected<void> look_at(Store& store, const ScanId& id);
  StationTrends trends_of(const std::string& name, const Station& station) const;

  HubStore& hub_store_;
  DriftParams params_;
  std::map<std::string, Station> stations_;
  std::uint64_t opening_ = 0;  // of the store that was read; 0: none
  std::chrono::steady_clock::time_point not_before_;
};

}  // namespace traygauge
