// A server that runs in a thread of its own, as the hub's loop would drive it.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/web/http_server.hpp"

namespace traygauge::test {

class ServerThread {
 public:
  // On a free port of 127.0.0.1, unless `address` says otherwise.
  explicit ServerThread(RequestHandler& handler, HttpLimits limits = {},
                        const std::string& address = "127.0.0.1:0");
  ServerThread(const ServerThread&) = delete;
  ServerThread& operator=(const ServerThread&) = delete;
  ~ServerThread();

  std::uint16_t port() const { return port_; }
  HttpCounts counts();
  // How often the loop went round.
  std::uint64_t rounds() const { return rounds_; }

  // Calls `function` between two rounds of the loop, where handlers do not run.
  template <class Function>
  auto between_rounds(Function function) {
    const std::scoped_lock lock(mutex_);
    wake();  // as in the hub's loop, timeout() is asked again after whatever happens
    return function();
  }

 private:
  void loop();
  void wake() const;

  std::mutex mutex_;
  HttpServer server_;
  std::uint16_t port_ = 0;
  std::atomic<bool> is_over_ = false;
  std::atomic<std::uint64_t> rounds_ = 0;
  int wake_ = -1;
  std::thread thread_;
};

}  // namespace traygauge::test
