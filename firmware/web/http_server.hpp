// The HTTP server of the hub: libmicrohttpd, driven by the hub's own loop on one thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/web/connection_limits.hpp"
#include "firmware/web/listener.hpp"
#include "firmware/web/request_handler.hpp"

namespace traygauge {

// Since the start, for /metrics.
struct HttpCounts {
  std::uint64_t connections = 0;       // accepted
  std::uint64_t requests = 0;          // answered by a handler
  std::uint64_t refused_requests = 0;  // answered before a handler saw them whole
  std::uint64_t refused_peers = 0;     // closed at once: the peer held too many
  std::uint64_t overdue = 0;           // closed: the client was too slow
  std::uint64_t open = 0;              // now
};

// Everything happens in run(): handlers need no locks, and must not block.
class HttpServer {
 public:
  // `handler` outlives the server.
  static Expected<HttpServer> start(HttpLimits limits, std::vector<Listener> listeners,
                                    RequestHandler& handler);
  HttpServer(HttpServer&&) noexcept;
  HttpServer& operator=(HttpServer&&) = delete;
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;
  ~HttpServer();

  // Readable when run() has something to do.
  int descriptor() const;
  // Until when run() is to be called though nothing is readable; none: not at all.
  std::optional<std::chrono::milliseconds> timeout() const;
  // Accepts, reads, answers, sends; never blocks.
  void run();

  HttpCounts counts() const;
  // In the order given to start(), with the ports that were taken.
  const std::vector<Listener>& listeners() const;

 private:
  class Daemon;
  explicit HttpServer(std::unique_ptr<Daemon> daemon);
  std::unique_ptr<Daemon> daemon_;
};

}  // namespace traygauge
