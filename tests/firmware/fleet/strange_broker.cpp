#include "tests/firmware/fleet/strange_broker.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <utility>
#include <vector>

#include "tests/firmware/webhook/receiver.hpp"

namespace traygauge::test {

StrangeBroker::StrangeBroker(std::string greeting, bool then_closes)
    : listener_(listen_anywhere(port_)), greeting_(std::move(greeting)), then_closes_(then_closes) {
  thread_ = std::thread([this] { serve(); });
}

StrangeBroker::~StrangeBroker() {
  stop_ = true;
  thread_.join();
}

void StrangeBroker::serve() {
  std::vector<FileDescriptor> open;
  while (!stop_) {
    pollfd ready{listener_.number(), POLLIN, 0};
    if (::poll(&ready, 1, 5) != 1) continue;
    FileDescriptor socket(::accept4(listener_.number(), nullptr, nullptr, SOCK_CLOEXEC));
    ++connections_;
    static_cast<void>(!::send(socket.number(), greeting_.data(), greeting_.size(), MSG_NOSIGNAL));
    if (!then_closes_) open.push_back(std::move(socket));
  }
}

}  // namespace traygauge::test
