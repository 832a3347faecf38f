// What people are told of the fleet.
#include "firmware/fleet/fleet.hpp"

namespace traygauge {

bool Fleet::has_waited_long() const {
  return state_.waiting_since && std::chrono::steady_clock::now() - *state_.waiting_since > limits_.patience;
}

Expected<std::int64_t> Fleet::count_waiting() const {
  Store* const store = store_.store();
  if (store == nullptr) return Failure{store_.problem()};
  const Expected<std::int64_t> stored = store->deliveries().count_pending(kFleetDestination);
  return stored.ok() ? Expected<std::int64_t>(*stored - static_cast<std::int64_t>(done_.size())) : stored;
}

std::string Fleet::trouble() const {
  std::string text;
  const std::string& reason = link_->problem().empty() ? state_.last_failure : link_->problem();
  if (link_->is_refused() || has_waited_long()) {
    const Expected<std::int64_t> waiting = count_waiting();
    text = waiting.ok() ? "Results wait for the fleet: " + std::to_string(*waiting) + "." : waiting.failure();
    if (!reason.empty()) text += " " + reason;
  }
  if (state_.undeliverable.empty()) return text;
  const auto& [id, bytes] = *state_.undeliverable.begin();
  if (!text.empty()) text += ' ';
  text += id + " (" + std::to_string(bytes) + " bytes)";
  if (state_.undeliverable.size() > 1)
    text += " and " + std::to_string(state_.undeliverable.size() - 1) + " more";
  return text +
         " cannot be delivered though others are: see whether broker and collector take messages of "
         "that size. It is kept and sent again.";
}

}  // namespace traygauge
