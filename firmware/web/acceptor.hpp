// Takes connections on, as many as there is room for.
#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "firmware/web/connection_limits.hpp"
#include "firmware/web/listener.hpp"
#include "firmware/web/peer_address.hpp"

namespace traygauge {

struct AcceptedSocket {
  int descriptor = -1;  // the taker closes it
  PeerAddress peer;
  sockaddr_storage address{};
  socklen_t address_bytes = 0;
};

// Counts what each peer holds. Who comes while there is no room waits in the kernel's queue.
class Acceptor {
 public:
  // Adds the listeners to `epoll` while there is room. `limits` outlives this.
  Acceptor(const HttpLimits& limits, std::vector<Listener> listeners, int epoll);

  // Calls `take` for each socket, which is counted from then on.
  void accept(const std::function<void(const AcceptedSocket&)>& take);
  void forget(const PeerAddress& peer);
  // Looks again whether the system has descriptors.
  void try_again();

  std::size_t open() const { return open_; }
  // The system has none left: accept() does nothing until try_again().
  bool is_short_of_descriptors() const { return is_short_of_descriptors_; }
  std::uint64_t refused() const { return refused_; }
  const std::vector<Listener>& listeners() const { return listeners_; }

 private:
  void accept_from(const Listener& listener, const std::function<void(const AcceptedSocket&)>& take);
  void admit(AcceptedSocket socket, const std::function<void(const AcceptedSocket&)>& take);
  bool has_room() const { return open_ < limits_.max_connections && !is_short_of_descriptors_; }
  void listen();

  const HttpLimits& limits_;
  std::vector<Listener> listeners_;
  int epoll_ = -1;
  PeerCounts peers_;
  std::size_t open_ = 0;
  std::uint64_t refused_ = 0;
  bool is_listening_ = false;
  bool is_short_of_descriptors_ = false;
};

}  // namespace traygauge
