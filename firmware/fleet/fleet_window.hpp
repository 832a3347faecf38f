// What was published and is not known to be delivered.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/store/deliveries.hpp"

namespace traygauge {

struct InFlight {
  DeliveryKey key;
  std::string event_id;
  std::size_t bytes = 0;  // of its message, which is not kept
  int attempts = 0;       // before this one
  int number = 0;         // the broker's acknowledgement has it
  std::chrono::steady_clock::time_point sent_at;
};

// In the order in which they were sent.
class FleetWindow {
 public:
  void add(InFlight entry);
  // None where it is not in flight.
  std::optional<InFlight> take_event(std::string_view event_id);
  std::optional<InFlight> take_number(int number);
  InFlight take_oldest();
  void clear();

  bool holds(const DeliveryKey& key) const;
  bool is_empty() const { return entries_.empty(); }
  std::size_t count() const { return entries_.size(); }
  std::size_t bytes() const { return bytes_; }
  const InFlight& oldest() const { return entries_.front(); }

 private:
  InFlight take(std::vector<InFlight>::iterator found);

  std::vector<InFlight> entries_;
  std::size_t bytes_ = 0;
};

}  // namespace traygauge
