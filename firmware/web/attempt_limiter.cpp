#include "firmware/web/attempt_limiter.hpp"

#include <algorithm>

namespace traygauge {

double AttemptLimiter::debt_of(const Peer& peer, SteadyTime now) const {
  const std::chrono::duration<double> passed = now - peer.at;
  const std::chrono::duration<double> interval = limits_.interval;
  return std::max(0.0, peer.debt - passed / interval);
}

bool AttemptLimiter::may_try(const PeerAddress& peer, SteadyTime now) const {
  const PeerAddress address = peer.neighbourhood();
  const auto found = std::find_if(peers_.begin(), peers_.end(),
                                  [&address](const Peer& known) { return known.address == address; });
  return found == peers_.end() || debt_of(*found, now) + 1 <= limits_.burst;
}

void AttemptLimiter::note_failure(const PeerAddress& peer, SteadyTime now) {
  const PeerAddress address = peer.neighbourhood();
  auto found = std::find_if(peers_.begin(), peers_.end(),
                            [&address](const Peer& known) { return known.address == address; });
  if (found == peers_.end() && peers_.size() >= limits_.max_peers) {
    found = std::min_element(peers_.begin(), peers_.end(),
                             [](const Peer& a, const Peer& b) { return a.at < b.at; });
    *found = {address, 0, now};
  } else if (found == peers_.end()) {
    found = peers_.insert(peers_.end(), {address, 0, now});
  }
  found->debt = debt_of(*found, now) + 1;
  found->at = now;
}

}  // namespace traygauge
