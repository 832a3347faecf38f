#include "firmware/drift/drift_watch.hpp"

#include <optional>
#include <utility>

namespace traygauge {
namespace {

constexpr std::chrono::minutes kRetryAfter{1};

WindowScan window_scan(const StoredScan& scan) {
  return {stored_number(scan.id.number), scan.received.unix_ms, !scan.superseded_by && !scan.is_wrong,
          read_check_values(scan.document)};
}

std::optional<MedianEstimate> estimate_first(const CheckSeries& first, const CheckSeries& last) {
  if (first.values.empty() || first.last_number >= last.first_number) return std::nullopt;
  return estimate_median(first.values);
}

}  // namespace

bool still_measures(const StationTrends& station, const WallTime& now, const DriftParams& params) {
  const std::chrono::milliseconds silent(now.unix_ms - station.last_received_ms);
  return silent <= params.forgotten_after;
}

Expected<void> DriftWatch::follow(std::chrono::steady_clock::time_point now) {
  Store* const store = hub_store_.store();
  if (store == nullptr || opening_ == hub_store_.openings() || now < not_before_) return {};
  not_before_ = now + kRetryAfter;
  Expected<void> read = read_all(*store);
  if (!read.ok()) return read;
  not_before_ = {};
  opening_ = hub_store_.openings();
  return {};
}

Expected<void> DriftWatch::read_all(Store& store) {
  stations_.clear();
  const Expected<std::vector<std::string>> names = store.history().stations(params_.max_stations);
  if (!names.ok()) return Failure{names.failure()};
  for (const std::string& name : *names) {
    Expected<Station> station = read_station(store, name);
    if (!station.ok()) return Failure{station.failure()};
    stations_.emplace(name, std::move(*station));
  }
  return {};
}

// Documents are read once where both windows hold the same scans.
Expected<DriftWatch::Station> DriftWatch::read_station(Store& store, const std::string& name) const {
  const std::size_t max = params_.scans_looked_at;
  Station station = empty_station();
  Expected<void> read =
      store.history().for_each_of(name, HistoryOrder::newest_first, max,
                                  [&](const StoredScan& scan) { station.last.put(window_scan(scan)); });
  if (read.ok() && station.last.scans().size() < max) {
    for (const WindowScan& scan : station.last.scans()) station.first.put(scan);
  } else if (read.ok()) {
    read = store.history().for_each_of(name, HistoryOrder::oldest_first, max,
                                       [&](const StoredScan& scan) { station.first.put(window_scan(scan)); });
  }
  if (!read.ok()) return Failure{read.failure()};
  return station;
}

// Where the scan cannot be read, all is read anew later.
void DriftWatch::note(const ScanId& id) {
  Store* const store = hub_store_.store();
  if (store == nullptr || opening_ != hub_store_.openings()) return;
  if (!look_at(*store, id).ok()) opening_ = 0;
}

Expected<void> DriftWatch::look_at(Store& store, const ScanId& id) {
  const Expected<std::optional<StoredScan>> found = store.scans().find(id);
  if (!found.ok()) return Failure{found.failure()};
  if (!*found) return {};
  const StoredScan& scan = **found;
  auto station = stations_.find(id.station);
  if (station == stations_.end()) {
    if (stations_.size() >= params_.max_stations) return {};
    station = stations_.emplace(id.station, empty_station()).first;
  }
  const auto put = [&windows = station->second](const WindowScan& read) {
    windows.first.put(read);
    windows.last.put(read);
  };
  put(window_scan(scan));
  // The scan that it supersedes does not count any more. That one supersedes none anew.
  if (!scan.supersedes) return {};
  const Expected<std::optional<StoredScan>> earlier = store.scans().find(*scan.supersedes);
  if (!earlier.ok()) return Failure{earlier.failure()};
  if (*earlier) put(window_scan(**earlier));
  return {};
}

DriftWatch::Station DriftWatch::empty_station() const {
  const std::size_t max = params_.scans_looked_at;
  return {{ScanWindow::End::first, max}, {ScanWindow::End::last, max}};
}

std::vector<StationTrends> DriftWatch::trends() const {
  std::vector<StationTrends> all;
  for (const auto& [name, station] : stations_) all.push_back(trends_of(name, station));
  return all;
}

StationTrends DriftWatch::trends_of(const std::string& name, const Station& station) const {
  StationTrends told{name, 0, {}};
  if (!station.last.scans().empty()) told.last_received_ms = station.last.scans().back().received_ms;
  for (std::size_t i = 0; i < kWatchedChecks; ++i) {
    const auto check = static_cast<WatchedCheck>(i);
    const CheckSeries last = station.last.series(check, params_.values);
    if (last.values.empty()) continue;
    const CheckSeries first = station.first.series(check, params_.values);
    told.trends.push_back(
        judge_trend(check, estimate_median(last.values), estimate_first(first, last), params_));
  }
  return told;
}

}  // namespace traygauge
