// How often somebody may be wrong about a token.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "firmware/web/peer_address.hpp"
#include "firmware/web/request_handler.hpp"

namespace traygauge {

struct AttemptLimits {
  // Somebody who types may be wrong some times in a row.
  unsigned burst = 10;
  // Then once in so long: at that pace a token of 20 random characters is not found in the life of the sun.
  std::chrono::milliseconds interval{10000};
  // Peers that are remembered; of more, the one that failed longest ago is forgotten.
  std::size_t max_peers = 1024;
};

// A bucket of attempts for each IPv4 address and each /64 of IPv6.
class AttemptLimiter {
 public:
  explicit AttemptLimiter(AttemptLimits limits) : limits_(limits) {}

  // False where the peer has been wrong too often: its next token is not looked at.
  bool may_try(const PeerAddress& peer, SteadyTime now) const;
  void note_failure(const PeerAddress& peer, SteadyTime now);
  std::size_t size() const { return peers_.size(); }

 private:
  // `debt` failures at `at`; they are forgiven one an interval.
  struct Peer {
    PeerAddress address;
    double debt = 0;
    SteadyTime at;
  };
  double debt_of(const Peer& peer, SteadyTime now) const;

  AttemptLimits limits_;
  std::vector<Peer> peers_;
};

}  // namespace traygauge
