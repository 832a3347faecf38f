// Three nodes of NATS JetStream with config/fleet/nats.conf, which end with the test.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "firmware/broker/broker_config.hpp"
#include "tests/firmware/store/memory_folder.hpp"
#include "tests/support/logged_process.hpp"

namespace traygauge::test {

class NatsCluster {
 public:
  static constexpr int kNodes = 3;
  // The program: TRAYGAUGE_NATS, or what get_nats.sh has fetched. Empty: there is none.
  static std::string program();

  NatsCluster();

  void start(int node);
  void kill(int node);                          // by SIGKILL
  BrokerConfig config(int node) const;          // of a hub
  std::string collector_lines(int node) const;  // of the table [broker]
  long peak_kib(int node) const;

 private:
  struct Node {
    std::uint16_t clients = 0;
    std::uint16_t cluster = 0;
    std::uint16_t mqtt = 0;
    std::unique_ptr<LoggedProcess> process;
  };
  std::vector<std::string> environment(int node) const;

  MemoryFolder folder_;
  std::array<Node, kNodes> nodes_;
};

}  // namespace traygauge::test
