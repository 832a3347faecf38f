// Three nodes of NATS JetStream with config/fleet/nats.conf, which end with the test.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/broker/broker_config.hpp"
#include "tests/firmware/store/memory_folder.hpp"

namespace traygauge::test {

class NatsCluster {
 public:
  static constexpr int kNodes = 3;
  // The program: TRAYGAUGE_NATS, or what get_nats.sh has fetched. Empty: there is none.
  static std::string program();

  NatsCluster();
  ~NatsCluster();
  NatsCluster(const NatsCluster&) = delete;
  NatsCluster& operator=(const NatsCluster&) = delete;

  void start(int node);
  void kill(int node);                          // by SIGKILL
  BrokerConfig config(int node) const;          // of a hub
  std::string collector_lines(int node) const;  // of the table [broker]
  long resident_kib(int node) const;

 private:
  struct Node {
    std::uint16_t clients = 0;
    std::uint16_t cluster = 0;
    std::uint16_t mqtt = 0;
    pid_t process = 0;
  };
  std::vector<std::string> environment(int node) const;

  MemoryFolder folder_;
  std::array<Node, kNodes> nodes_;
};

}  // namespace traygauge::test
