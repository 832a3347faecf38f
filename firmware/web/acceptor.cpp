#include "firmware/web/acceptor.hpp"

#include <sys/epoll.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <utility>

namespace traygauge {

Acceptor::Acceptor(const HttpLimits& limits, std::vector<Listener> listeners, int epoll)
    : limits_(limits), listeners_(std::move(listeners)), epoll_(epoll) {
  listen();
}

void Acceptor::accept(const std::function<void(const AcceptedSocket&)>& take) {
  for (const Listener& listener : listeners_) accept_from(listener, take);
  listen();
}

void Acceptor::forget(const PeerAddress& peer) {
  peers_.remove(peer);
  --open_;
  listen();
}

void Acceptor::try_again() {
  is_short_of_descriptors_ = false;
  listen();
}

void Acceptor::listen() {
  if (has_room() == is_listening_) return;
  is_listening_ = !is_listening_;
  for (const Listener& listener : listeners_) {
    epoll_event event{EPOLLIN, {}};
    ::epoll_ctl(epoll_, is_listening_ ? EPOLL_CTL_ADD : EPOLL_CTL_DEL, listener.descriptor(), &event);
  }
}

void Acceptor::accept_from(const Listener& listener, const std::function<void(const AcceptedSocket&)>& take) {
  for (unsigned i = 0; i < limits_.max_accepts_per_run && has_room(); ++i) {
    AcceptedSocket socket;
    socket.address_bytes = sizeof(socket.address);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the kernel's interface
    auto* const address = reinterpret_cast<sockaddr*>(&socket.address);
    socket.descriptor =
        ::accept4(listener.descriptor(), address, &socket.address_bytes, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (socket.descriptor >= 0) {
      admit(socket, take);
    } else if (errno != EINTR && errno != ECONNABORTED) {
      is_short_of_descriptors_ = errno != EAGAIN && errno != EWOULDBLOCK;
      return;
    }
  }
}

void Acceptor::admit(AcceptedSocket socket, const std::function<void(const AcceptedSocket&)>& take) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the kernel's interface
  const auto peer = PeerAddress::of(*reinterpret_cast<const sockaddr*>(&socket.address));
  const bool is_counted = peer && !is_in_any(limits_.uncounted_peers, *peer);
  if (!peer || (is_counted && peers_.count(*peer) >= limits_.max_connections_per_peer)) {
    ++refused_;
    ::close(socket.descriptor);
    return;
  }
  socket.peer = *peer;
  peers_.add(*peer);
  ++open_;
  const int bytes = limits_.send_buffer_bytes;
  ::setsockopt(socket.descriptor, SOL_SOCKET, SO_SNDBUF, &bytes, sizeof(bytes));
  take(socket);
}

}  // namespace traygauge
