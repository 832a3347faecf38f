// The same through a JetStream cluster of three, whose nodes are killed in turn and come back, and the
// collector with them. TRAYGAUGE_FLEET_STATIONS and TRAYGAUGE_FLEET_RESULTS as in fleet_storm_test.cpp.
#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "tests/firmware/collect/nats_cluster.hpp"
#include "tests/firmware/collect/storm.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;

TEST(NatsStorm, EverythingIsStoredOnceWhicheverNodeIsKilled) {
  if (NatsCluster::program().empty()) {
    if (std::getenv("CI") != nullptr) FAIL() << "no nats-server: get_nats.sh did not fetch it";
    GTEST_SKIP() << "no nats-server: tests/firmware/collect/get_nats.sh build/nats fetches it";
  }
  const int hubs = count_of("TRAYGAUGE_FLEET_STATIONS", 20);
  const int results = count_of("TRAYGAUGE_FLEET_RESULTS", 30);
  allow_many_files();
  std::mt19937 random(random_seed());
  NatsCluster cluster;
  CollectorProgram collector(cluster.collector_lines(0));
  Storm storm({cluster.config(0), cluster.config(1), cluster.config(2)}, hubs);
  const auto begin = std::chrono::steady_clock::now();
  int killed = 0;
  for (int number = 1; number <= results; ++number) {
    storm.put_all(static_cast<std::uint64_t>(number));
    storm.step();
    if (number % 10 == 3) storm.interrupt(collector, milliseconds(random() % 200));
    if (number % 10 == 6) {
      cluster.kill(killed);
      storm.run_for(milliseconds(500 + random() % 1500));
      cluster.start(killed);
      killed = (killed + 1) % NatsCluster::kNodes;
      // One node at a time: two of three have to agree.
      storm.run_for(milliseconds(3000));
    }
  }
  EXPECT_TRUE(storm.drain(std::chrono::seconds(180))) << storm.waiting() << collector.log();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const long collector_kib = collector.peak_kib();
  EXPECT_EQ(collector.stop(), 0) << collector.log();
  expect_each_once(collector.store(), hubs, results);
  std::cout << hubs << " hubs with " << results << " results each stored in " << took.count()
            << " s, published " << storm.published() << " times; collector " << collector_kib
            << " KiB, nodes";
  for (int node = 0; node < NatsCluster::kNodes; ++node) std::cout << " " << cluster.peak_kib(node);
  std::cout << " KiB" << std::endl;
}

}  // namespace
}  // namespace traygauge::test
