// How much one peer may take, and for how long.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "firmware/web/peer_address.hpp"
#include "firmware/web/request_handler.hpp"

namespace traygauge {

struct HttpLimits {
  using Milliseconds = std::chrono::milliseconds;

  // 50 pages hold an event stream each and open two or three connections beside it for a moment. A connection
  // takes connection_memory_bytes at most, and its body.
  unsigned max_connections = 256;
  // One machine must not take all connections. A browser opens six.
  unsigned max_connections_per_peer = 64;
  // Behind a proxy all pages come from its address, so that the limit above does not hold for it.
  std::vector<AddressRange> uncounted_peers = local_ranges();
  // The head of a request and a piece of the answer have to fit; larger pieces would not be quicker.
  std::size_t connection_memory_bytes = 16UL * 1024;
  // Browsers send about 1 KiB, a proxy with its own cookies some more.
  std::size_t max_header_bytes = 8UL * 1024;
  // No route takes more, whatever it says: bodies are held in memory.
  std::size_t max_body_bytes = 64UL * 1024;
  // From the connection, or the end of the last answer, to the end of the next head: also how long a
  // connection may idle. Longer than a page's usual pause would be of no use, shorter makes browsers connect
  // anew.
  Milliseconds max_head_time{20000};
  // From the head to the end of the body: max_body_bytes at 3 kB/s.
  Milliseconds max_body_time{20000};
  // A client that takes nothing for so long is gone, or means harm.
  Milliseconds max_stall{15000};
  // The least rate at which an answer is read, after max_stall; a phone at the edge of the network has more.
  std::size_t min_bytes_per_s = 1024;
  // Kernel memory for what was sent and not acknowledged, so that many slow readers do not take megabytes
  // each.
  int send_buffer_bytes = 64 * 1024;
  // How often the times above are looked at, and RequestHandler::attend() called.
  Milliseconds sweep_interval{1000};
  // Connections accepted in one run(), so that a flood does not keep the hub from its other work.
  unsigned max_accepts_per_run = 32;
};

// Where a connection stands, for its deadlines.
struct ConnectionProgress {
  enum class Phase : std::uint8_t { head, body, answer };

  Phase phase = Phase::head;
  SteadyTime since{};            // this phase
  SteadyTime read_at{};          // when the client last took a piece of the answer
  std::uint64_t sent_bytes = 0;  // of the answer's body
  bool is_live = false;          // an event stream: no least rate
  bool is_suspended = false;     // there is nothing to send
};

// The client has had its time.
bool is_overdue(const ConnectionProgress& progress, const HttpLimits& limits, SteadyTime now);

// Connections that each peer holds: IPv4 by address, IPv6 by /64.
class PeerCounts {
 public:
  unsigned count(const PeerAddress& peer) const;
  void add(const PeerAddress& peer) { ++counts_[peer.neighbourhood()]; }
  void remove(const PeerAddress& peer);

 private:
  std::map<PeerAddress, unsigned> counts_;
};

}  // namespace traygauge
