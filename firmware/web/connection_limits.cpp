#include "firmware/web/connection_limits.hpp"

namespace traygauge {

bool is_overdue(const ConnectionProgress& progress, const HttpLimits& limits, SteadyTime now) {
  using Phase = ConnectionProgress::Phase;
  const auto passed = now - progress.since;
  if (progress.phase == Phase::head) return passed > limits.max_head_time;
  if (progress.phase == Phase::body) return passed > limits.max_body_time;
  if (progress.is_suspended) return false;
  if (now - progress.read_at > limits.max_stall) return true;
  if (progress.is_live || limits.min_bytes_per_s == 0) return false;
  const std::chrono::duration<double> allowed(static_cast<double>(progress.sent_bytes) /
                                              static_cast<double>(limits.min_bytes_per_s));
  return passed > limits.max_stall + allowed;
}

unsigned PeerCounts::count(const PeerAddress& peer) const {
  const auto found = counts_.find(peer.neighbourhood());
  return found == counts_.end() ? 0 : found->second;
}

void PeerCounts::remove(const PeerAddress& peer) {
  const auto found = counts_.find(peer.neighbourhood());
  if (found != counts_.end() && --found->second == 0) counts_.erase(found);
}

}  // namespace traygauge
