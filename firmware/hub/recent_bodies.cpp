#include "firmware/hub/recent_bodies.hpp"

#include <algorithm>
#include <utility>

namespace traygauge {

void RecentBodies::put(const ScanId& id, std::string body) {
  std::erase_if(entries_, [&](const Entry& other) {
    if (other.id != id) return false;
    bytes_ -= other.body->size();
    return true;
  });
  bytes_ += body.size();
  entries_.push_back({id, std::make_shared<const std::string>(std::move(body))});
  while (entries_.size() > limits_.max_count || (bytes_ > limits_.max_bytes && entries_.size() > 1)) {
    bytes_ -= entries_.front().body->size();
    entries_.pop_front();
  }
}

std::shared_ptr<const std::string> RecentBodies::find(const ScanId& id) const {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.id == id; });
  return found == entries_.end() ? nullptr : found->body;
}

}  // namespace traygauge
