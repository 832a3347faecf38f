// Many hubs in one process, and the collector that ships.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/fleet/fleet.hpp"
#include "firmware/store/database.hpp"
#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/support/logged_process.hpp"

namespace traygauge::test {

inline int count_of(const char* variable, int otherwise) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atoi(text);
}

// A hub takes six files and sockets.
inline void allow_many_files() {
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
}

class CollectorProgram {
 public:
  // `broker`: the lines of that table. `head`: those above it.
  explicit CollectorProgram(const std::string& broker,
                            const std::string& head = "store = \"collected.db\"\n") {
    std::ofstream(config()) << head << "[broker]\n" << broker;
    start();
  }

  void start() { process_.start({TRAYGAUGE_COLLECT, "collect", config()}); }
  int end(int signal) { return process_.end(signal); }
  int stop() { return process_.stop(); }
  long peak_kib() const { return process_.peak_kib(); }
  std::string log() const { return process_.log(); }
  std::filesystem::path store() const { return folder_.path() / "collected.db"; }

 private:
  std::string config() const { return folder_.path() / "collector.toml"; }

  MemoryFolder folder_;
  LoggedProcess process_{folder_.path() / "log"};
};

// What takes minutes in a canteen takes seconds here.
inline FleetLimits storm_limits() {
  FleetLimits limits;
  limits.broker.longest_wait = std::chrono::milliseconds(2000);
  limits.receipt_within = std::chrono::milliseconds(5000);
  limits.longest_wait = std::chrono::milliseconds(4000);
  limits.shortest_postponement = std::chrono::milliseconds(1000);
  limits.longest_postponement = std::chrono::milliseconds(4000);
  return limits;
}

// A hub without its sockets and pages: a store and what tells it to the fleet.
struct SimulatedHub {
  SimulatedHub(const std::filesystem::path& folder, const std::string& name, const BrokerConfig& broker,
               const FleetLimits& limits) {
    HubStoreParams params;
    params.options.file = folder / (name + ".db");
    params.options.destinations = {kFleetDestination};
    Expected<HubStore> opened = HubStore::open(params);
    if (!opened.ok()) throw std::runtime_error(opened.failure());
    store.emplace(std::move(*opened));
    FleetConfig config;
    config.broker = broker;
    config.name = name;
    auto started = Fleet::start(
        config, *store, [] { return std::string("{}"); }, limits);
    if (!started.ok()) throw std::runtime_error(started.failure());
    fleet = std::move(*started);
  }
  void put(const std::string& station, std::uint64_t number) {
    SampleScan scan;
    scan.id = {station, number};
    if (!store->store()->scans().put(sample_document(scan), at(kMorningMs)).ok())
      throw std::runtime_error("not stored");
  }
  std::optional<HubStore> store;
  std::unique_ptr<Fleet> fleet;
};

class Storm {
 public:
  // `brokers`: a hub at each in turn.
  Storm(const std::vector<BrokerConfig>& brokers, int hubs, const FleetLimits& limits = storm_limits()) {
    for (int i = 0; i < hubs; ++i) {
      names_.push_back("canteen-" + std::to_string(i));
      const BrokerConfig& broker = brokers[static_cast<std::size_t>(i) % brokers.size()];
      hubs_.push_back(std::make_unique<SimulatedHub>(folder_.path(), names_.back(), broker, limits));
    }
  }
  void put_all(std::uint64_t number) {
    for (std::size_t i = 0; i < hubs_.size(); ++i) hubs_[i]->put(names_[i], number);
  }
  // One round of every hub's loop.
  void step() {
    descriptors_.clear();
    std::chrono::milliseconds wait(20);
    for (const auto& hub : hubs_) {
      hub->fleet->add_descriptors(descriptors_);
      wait = std::min(wait, hub->fleet->timeout());
    }
    ::poll(descriptors_.data(), descriptors_.size(), static_cast<int>(wait.count()));
    for (const auto& hub : hubs_) hub->fleet->attend();
  }
  void run_for(std::chrono::milliseconds time) {
    for (const auto end = std::chrono::steady_clock::now() + time; std::chrono::steady_clock::now() < end;)
      step();
  }
  // False where something still waits after that time.
  bool drain(std::chrono::seconds limit) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (waiting() > 0 && std::chrono::steady_clock::now() < end) run_for(std::chrono::milliseconds(200));
    return waiting() == 0;
  }
  // Kills the collector, which is away for so long.
  void interrupt(CollectorProgram& collector, std::chrono::milliseconds away) {
    collector.end(SIGKILL);
    run_for(away);
    collector.start();
  }
  // Delivered since the start, by the hubs' own count.
  std::uint64_t delivered() const {
    std::uint64_t sum = 0;
    for (const auto& hub : hubs_) sum += hub->fleet->state().delivered;
    return sum;
  }
  std::uint64_t published() const {
    std::uint64_t sum = 0;
    for (const auto& hub : hubs_) sum += hub->fleet->state().published;
    return sum;
  }
  std::int64_t waiting() const {
    std::int64_t sum = 0;
    for (const auto& hub : hubs_) sum += *hub->fleet->count_waiting();
    return sum;
  }

 private:
  MemoryFolder folder_;
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<SimulatedHub>> hubs_;
  std::vector<pollfd> descriptors_;
};

// Nothing is lost and nothing doubled.
inline void expect_each_once(const std::filesystem::path& store, int hubs, int results) {
  auto database = Database::open(store, "unix");
  ASSERT_TRUE(database.ok()) << database.failure();
  const auto count = [&](const char* sql) { return *(*database)->integer("", sql); };
  const auto expected = std::int64_t{hubs} * results;
  EXPECT_EQ(count("SELECT count(*) FROM events"), expected);
  EXPECT_EQ(count("SELECT count(DISTINCT station || '-' || json_extract(body, '$.scan.number')) FROM events"),
            expected);
  EXPECT_EQ(count("SELECT count(*) FROM twins"), 0);
}

}  // namespace traygauge::test
