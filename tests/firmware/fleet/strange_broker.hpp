// Something at a port that is no broker, or a bad one.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "firmware/base/file_descriptor.hpp"

namespace traygauge::test {

class StrangeBroker {
 public:
  // Says `greeting` to everybody who connects, then closes the connection or says nothing more.
  StrangeBroker(std::string greeting, bool then_closes);
  ~StrangeBroker();
  StrangeBroker(const StrangeBroker&) = delete;
  StrangeBroker& operator=(const StrangeBroker&) = delete;

  std::uint16_t port() const { return port_; }
  int connections() const { return connections_; }

 private:
  void serve();

  std::uint16_t port_ = 0;
  FileDescriptor listener_;
  std::string greeting_;
  bool then_closes_;
  std::atomic<bool> stop_{false};
  std::atomic<int> connections_{0};
  std::thread thread_;
};

}  // namespace traygauge::test
