// Many hubs, a broker and a collector that are killed again and again: everything is stored, once.
//
// TRAYGAUGE_FLEET_STATIONS and TRAYGAUGE_FLEET_RESULTS say how many hubs, and how many results each; 20 and
// 30 where they do not. TRAYGAUGE_FLEET_WAITING: how many wait already when the broker comes, 1,000.
// TRAYGAUGE_FLEET_DAYS: how many simulated days the broker is away, 1.
#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "tests/firmware/collect/storm.hpp"
#include "tests/firmware/fleet/broker_process.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;
using SteadyClock = std::chrono::steady_clock;

BrokerConfig config_of(const BrokerProcess& broker) {
  BrokerConfig config;
  config.host = "127.0.0.1";
  config.port = broker.port();
  config.is_encrypted = false;
  return config;
}

std::string lines_of(const BrokerProcess& broker) {
  return "host = \"127.0.0.1\"\ntls = false\nport = " + std::to_string(broker.port()) + "\n";
}

TEST(FleetStorm, EverythingIsStoredOnceWhateverIsKilled) {
  TRAYGAUGE_NEED_BROKER();
  const int hubs = count_of("TRAYGAUGE_FLEET_STATIONS", 20);
  const int results = count_of("TRAYGAUGE_FLEET_RESULTS", 30);
  allow_many_files();
  std::mt19937 random(random_seed());
  BrokerProcess broker;
  CollectorProgram collector(lines_of(broker));
  Storm storm({config_of(broker)}, hubs);
  const auto begin = SteadyClock::now();
  for (int number = 1; number <= results; ++number) {
    storm.put_all(static_cast<std::uint64_t>(number));
    storm.step();
    if (number % 10 == 3) storm.interrupt(collector, milliseconds(random() % 200));
    if (number % 10 == 6) {
      broker.kill();
      storm.run_for(milliseconds(random() % 200));
      broker.start();
    }
  }
  EXPECT_TRUE(storm.drain(std::chrono::seconds(120))) << storm.waiting() << collector.log() << broker.log();
  const std::chrono::duration<double> took = SteadyClock::now() - begin;
  const long collector_kib = collector.peak_kib();
  const long broker_kib = broker.resident_kib();
  EXPECT_EQ(collector.stop(), 0) << collector.log();

  expect_each_once(collector.store(), hubs, results);
  std::cout << hubs << " hubs with " << results << " results each stored in " << took.count()
            << " s, published " << storm.published() << " times; collector " << collector_kib
            << " KiB, broker " << broker_kib << " KiB" << std::endl;
}

TEST(FleetStorm, ACollectorEndsInOrderRightAfterItsStart) {
  TRAYGAUGE_NEED_BROKER();
  const BrokerProcess broker;
  CollectorProgram collector(lines_of(broker));
  for (int start = 0; start < 20; ++start) {
    ASSERT_EQ(collector.stop(), 0) << collector.log();
    collector.start();
  }
}

// A day of a hub, with 2,000 results, passes in some seconds, and the longest wait for the broker is shorter
// in proportion.
TEST(FleetStorm, ABrokerThatIsAwayForDaysLosesNothing) {
  TRAYGAUGE_NEED_BROKER();
  constexpr int kHubs = 3;
  constexpr int kResultsOfADay = 2000;
  constexpr int kResultsOfAnHour = 83;
  constexpr milliseconds kHour{100};
  const int days = count_of("TRAYGAUGE_FLEET_DAYS", 1);
  const int results = days * kResultsOfADay;
  BrokerProcess broker;
  CollectorProgram collector(lines_of(broker));
  FleetLimits limits = storm_limits();
  limits.broker.shortest_wait = milliseconds(1);
  limits.broker.longest_wait =
      FleetLimits().broker.longest_wait / (milliseconds(std::chrono::hours(1)) / kHour);
  Storm storm({config_of(broker)}, kHubs, limits);
  storm.put_all(1);
  ASSERT_TRUE(storm.drain(std::chrono::seconds(20))) << collector.log();
  broker.kill();
  for (int number = 2; number <= results; ++number) {
    storm.put_all(static_cast<std::uint64_t>(number));
    if (number % kResultsOfAnHour == 0) storm.run_for(kHour);
  }
  EXPECT_EQ(storm.waiting(), std::int64_t{kHubs} * (results - 1));
  broker.start();
  const auto begin = SteadyClock::now();
  EXPECT_TRUE(storm.drain(std::chrono::seconds(60 + days * 20))) << storm.waiting() << collector.log();
  const std::chrono::duration<double> took = SteadyClock::now() - begin;
  EXPECT_EQ(collector.stop(), 0) << collector.log();
  expect_each_once(collector.store(), kHubs, results);
  std::cout << days << " days: " << kHubs << " hubs with " << results << " results each stored in "
            << took.count() << " s" << std::endl;
}

// Everything waits already: how fast it drains.
TEST(FleetStorm, TheRateOfOneHubAndOfMany) {
  TRAYGAUGE_NEED_BROKER();
  for (const int hubs : {1, 10}) {
    BrokerProcess broker;
    CollectorProgram collector(lines_of(broker));
    Storm storm({config_of(broker)}, hubs);
    const int waiting = count_of("TRAYGAUGE_FLEET_WAITING", 1000);
    for (int number = 1; number <= waiting / hubs; ++number)
      storm.put_all(static_cast<std::uint64_t>(number));
    const auto begin = SteadyClock::now();
    const auto all = static_cast<std::uint64_t>(waiting);
    while (storm.delivered() < all && SteadyClock::now() - begin < std::chrono::seconds(60 + waiting / 100))
      storm.step();
    const std::chrono::duration<double> took = SteadyClock::now() - begin;
    EXPECT_EQ(storm.delivered(), all) << collector.log();
    std::cout << hubs << " hubs: " << waiting / took.count() << " results a second; collector "
              << collector.peak_kib() << " KiB" << std::endl;
  }
}

}  // namespace
}  // namespace traygauge::test
