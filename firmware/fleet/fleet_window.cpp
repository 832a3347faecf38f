#include "firmware/fleet/fleet_window.hpp"

#include <algorithm>
#include <utility>

namespace traygauge {

void FleetWindow::add(InFlight entry) {
  bytes_ += entry.bytes;
  entries_.push_back(std::move(entry));
}

std::optional<InFlight> FleetWindow::take_event(std::string_view event_id) {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const InFlight& entry) { return entry.event_id == event_id; });
  return found == entries_.end() ? std::nullopt : std::optional(take(found));
}

std::optional<InFlight> FleetWindow::take_number(int number) {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const InFlight& entry) { return entry.number == number; });
  return found == entries_.end() ? std::nullopt : std::optional(take(found));
}

InFlight FleetWindow::take_oldest() {
  return take(entries_.begin());
}

void FleetWindow::clear() {
  entries_.clear();
  bytes_ = 0;
}

bool FleetWindow::holds(const DeliveryKey& key) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const InFlight& entry) { return entry.key == key; });
}

InFlight FleetWindow::take(std::vector<InFlight>::iterator found) {
  InFlight entry = std::move(*found);
  entries_.erase(found);
  bytes_ -= entry.bytes;
  return entry;
}

}  // namespace traygauge
