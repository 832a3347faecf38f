#include "tests/firmware/web/server_thread.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace traygauge::test {
namespace {

template <class T>
T expect_value(Expected<T> value) {
  if (!value.ok()) throw std::runtime_error(value.failure());
  return std::move(*value);
}

HttpServer start_server(RequestHandler& handler, HttpLimits limits, const std::string& address) {
  std::vector<Listener> listeners;
  listeners.push_back(expect_value(Listener::open(expect_value(parse_listen_address(address)))));
  return expect_value(HttpServer::start(std::move(limits), std::move(listeners), handler));
}

}  // namespace

ServerThread::ServerThread(RequestHandler& handler, HttpLimits limits, const std::string& address)
    : server_(start_server(handler, std::move(limits), address)),
      port_(server_.listeners().front().address().port),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      thread_([this] { loop(); }) {}

ServerThread::~ServerThread() {
  is_over_ = true;
  wake();
  thread_.join();
  ::close(wake_);
}

void ServerThread::wake() const {
  EXPECT_EQ(::eventfd_write(wake_, 1), 0);
}

HttpCounts ServerThread::counts() {
  return between_rounds([this] { return server_.counts(); });
}

void ServerThread::loop() {
  while (!is_over_) {
    int timeout_ms = 0;
    {
      const std::scoped_lock lock(mutex_);
      const auto timeout = server_.timeout();
      timeout_ms = timeout ? static_cast<int>(timeout->count()) : -1;
    }
    std::array<pollfd, 2> waiting{pollfd{server_.descriptor(), POLLIN, 0}, pollfd{wake_, POLLIN, 0}};
    ::poll(waiting.data(), waiting.size(), timeout_ms);
    eventfd_t woken = 0;
    ::eventfd_read(wake_, &woken);
    ++rounds_;
    const std::scoped_lock lock(mutex_);
    server_.run();
  }
}

}  // namespace traygauge::test
