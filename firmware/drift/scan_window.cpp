#include "firmware/drift/scan_window.hpp"

#include <algorithm>

namespace traygauge {

void ScanWindow::put(const WindowScan& scan) {
  const auto place =
      std::lower_bound(scans_.begin(), scans_.end(), scan.number,
                       [](const WindowScan& other, std::int64_t number) { return other.number < number; });
  if (place != scans_.end() && place->number == scan.number) {
    *place = scan;
    return;
  }
  scans_.insert(place, scan);
  if (scans_.size() > max_scans_) scans_.erase(end_ == End::first ? scans_.end() - 1 : scans_.begin());
}

CheckSeries ScanWindow::series(WatchedCheck check, std::size_t max_values) const {
  CheckSeries series;
  const auto take = [&](const WindowScan& scan) {
    const std::optional<double>& value = scan.values[static_cast<std::size_t>(check)];
    if (!scan.counts || !value || series.values.size() == max_values) return;
    if (series.values.empty()) series.first_number = scan.number;
    series.last_number = scan.number;
    series.values.push_back(*value);
  };
  if (end_ == End::first) {
    std::for_each(scans_.begin(), scans_.end(), take);
    return series;
  }
  std::for_each(scans_.rbegin(), scans_.rend(), take);
  std::reverse(series.values.begin(), series.values.end());
  std::swap(series.first_number, series.last_number);
  return series;
}

}  // namespace traygauge
