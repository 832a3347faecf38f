// Where the hub listens: an IP address with a port, or a Unix socket.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "firmware/base/expected.hpp"
#include "firmware/base/file_descriptor.hpp"
#include "firmware/web/peer_address.hpp"

namespace traygauge {

struct ListenAddress {
  PeerAddress address;         // of a Unix socket where `path` is not empty
  std::uint16_t port = 0;      // 0: any that is free
  std::filesystem::path path;  // absolute

  // Only who is on this machine reaches it.
  bool is_local() const { return address.is_local(); }
  std::string text() const;
};

// "127.0.0.1:8080", "[::1]:8080", "localhost:8080" (IPv4), "*:8080" (all addresses), "/run/traygauge/web" (a
// Unix socket).
Expected<ListenAddress> parse_listen_address(std::string_view text);

// A listening socket that never blocks. Removes its file at its end.
class Listener {
 public:
  // A socket file that a killed predecessor left is replaced; its permissions are 0660.
  static Expected<Listener> open(const ListenAddress& address);

  Listener(Listener&&) noexcept = default;
  Listener& operator=(Listener&&) = delete;
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

  int descriptor() const { return socket_.number(); }
  // With the port that was taken.
  const ListenAddress& address() const { return address_; }

 private:
  Listener(FileDescriptor socket, ListenAddress address)
      : socket_(std::move(socket)), address_(std::move(address)) {}

  FileDescriptor socket_;
  ListenAddress address_;
};

}  // namespace traygauge
