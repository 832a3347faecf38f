// Many hubs, a broker and a collector that are killed again and again: everything is stored, once.
//
// TRAYGAUGE_FLEET_STATIONS and TRAYGAUGE_FLEET_RESULTS say how many hubs, and how many results each; 20 and
// 30 where they do not.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>

#include "firmware/fleet/fleet.hpp"
#include "firmware/store/database.hpp"
#include "tests/firmware/fleet/broker_process.hpp"
#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;
using SteadyClock = std::chrono::steady_clock;

int count_of(const char* variable, int otherwise) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atoi(text);
}

class CollectorProgram {
 public:
  explicit CollectorProgram(std::uint16_t broker_port) {
    std::ofstream(config())
        << "store = \"collected.db\"\n[broker]\nhost = \"127.0.0.1\"\ntls = false\nport = " << broker_port
        << "\n";
    start();
  }
  ~CollectorProgram() { end(SIGKILL); }
  CollectorProgram(const CollectorProgram&) = delete;
  CollectorProgram& operator=(const CollectorProgram&) = delete;

  void start() {
    const pid_t parent = ::getpid();
    const std::string log = folder_.path() / "log";
    const std::string file = config();
    process_ = ::fork();
    if (process_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);
    const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
    ::execl(TRAYGAUGE_COLLECT, TRAYGAUGE_COLLECT, "collect", file.c_str(), nullptr);
    ::_exit(1);
  }
  int end(int signal) {
    if (process_ == 0) return 0;
    int status = 0;
    ::kill(process_, signal);
    ::waitpid(process_, &status, 0);
    process_ = 0;
    return status;
  }
  long resident_kib() const {
    std::ifstream status("/proc/" + std::to_string(process_) + "/status");
    for (std::string word; status >> word;) {
      long kib = 0;
      if (word == "VmHWM:" && status >> kib) return kib;
    }
    return 0;
  }
  std::string log() const {
    std::ifstream stream(folder_.path() / "log");
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  std::filesystem::path store() const { return folder_.path() / "collected.db"; }

 private:
  std::string config() const { return folder_.path() / "collector.toml"; }
  MemoryFolder folder_;
  pid_t process_ = 0;
};

// A hub without its sockets and pages: a store and what tells it to the fleet.
struct SimulatedHub {
  SimulatedHub(const std::filesystem::path& folder, const std::string& name, std::uint16_t port) {
    HubStoreParams params;
    params.options.file = folder / (name + ".db");
    params.options.destinations = {kFleetDestination};
    Expected<HubStore> opened = HubStore::open(params);
    if (!opened.ok()) throw std::runtime_error(opened.failure());
    store.emplace(std::move(*opened));
    FleetConfig config;
    config.broker.host = "127.0.0.1";
    config.broker.port = port;
    config.broker.is_encrypted = false;
    config.name = name;
    FleetLimits limits;
    limits.broker.longest_wait = milliseconds(2000);
    limits.receipt_within = milliseconds(5000);
    limits.longest_wait = milliseconds(4000);
    limits.shortest_postponement = milliseconds(1000);
    limits.longest_postponement = milliseconds(4000);
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
  Storm(std::uint16_t port, int hubs) {
    for (int i = 0; i < hubs; ++i) {
      names_.push_back("canteen-" + std::to_string(i));
      hubs_.push_back(std::make_unique<SimulatedHub>(folder_.path(), names_.back(), port));
    }
  }
  void put_all(std::uint64_t number) {
    for (std::size_t i = 0; i < hubs_.size(); ++i) hubs_[i]->put(names_[i], number);
  }
  // One round of every hub's loop.
  void step() {
    descriptors_.clear();
    milliseconds wait(20);
    for (const auto& hub : hubs_) {
      hub->fleet->add_descriptors(descriptors_);
      wait = std::min(wait, hub->fleet->timeout());
    }
    ::poll(descriptors_.data(), descriptors_.size(), static_cast<int>(wait.count()));
    for (const auto& hub : hubs_) hub->fleet->attend();
  }
  void run_for(milliseconds time) {
    for (const auto end = SteadyClock::now() + time; SteadyClock::now() < end;) step();
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

TEST(FleetStorm, EverythingIsStoredOnceWhateverIsKilled) {
  TRAYGAUGE_NEED_BROKER();
  const int hubs = count_of("TRAYGAUGE_FLEET_STATIONS", 20);
  const int results = count_of("TRAYGAUGE_FLEET_RESULTS", 30);
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
  std::mt19937 random(random_seed());
  BrokerProcess broker;
  CollectorProgram collector(broker.port());
  Storm storm(broker.port(), hubs);
  const auto begin = SteadyClock::now();
  for (int number = 1; number <= results; ++number) {
    storm.put_all(static_cast<std::uint64_t>(number));
    storm.step();
    if (number % 10 == 3) {
      collector.end(SIGKILL);
      storm.run_for(milliseconds(random() % 200));
      collector.start();
    }
    if (number % 10 == 6) {
      broker.kill();
      storm.run_for(milliseconds(random() % 200));
      broker.start();
    }
  }
  const auto end = SteadyClock::now() + std::chrono::seconds(120);
  while (storm.waiting() > 0 && SteadyClock::now() < end) storm.run_for(milliseconds(200));
  EXPECT_EQ(storm.waiting(), 0) << collector.log() << broker.log();
  const std::chrono::duration<double> took = SteadyClock::now() - begin;
  const long collector_kib = collector.resident_kib();
  const long broker_kib = broker.resident_kib();
  EXPECT_EQ(collector.end(SIGTERM), 0) << collector.log();

  auto database = Database::open(collector.store(), "unix");
  ASSERT_TRUE(database.ok()) << database.failure();
  const auto expected = std::int64_t{hubs} * results;
  EXPECT_EQ(*(*database)->integer("", "SELECT count(*) FROM events"), expected);
  EXPECT_EQ(
      *(*database)->integer("",
                            "SELECT count(DISTINCT station || '-' || json_extract(body, '$.scan.number'))"
                            " FROM events"),
      expected);
  EXPECT_EQ(*(*database)->integer("", "SELECT count(*) FROM twins"), 0);
  std::cout << hubs << " hubs with " << results << " results each: " << expected << " stored in "
            << took.count() << " s, published " << storm.published() << " times; collector " << collector_kib
            << " KiB, broker " << broker_kib << " KiB" << std::endl;
}

// Everything waits already: how fast it drains.
TEST(FleetStorm, TheRateOfOneHubAndOfMany) {
  TRAYGAUGE_NEED_BROKER();
  for (const int hubs : {1, 10}) {
    BrokerProcess broker;
    CollectorProgram collector(broker.port());
    Storm storm(broker.port(), hubs);
    constexpr int kResults = 1000;
    for (int number = 1; number <= kResults / hubs; ++number)
      storm.put_all(static_cast<std::uint64_t>(number));
    const auto begin = SteadyClock::now();
    while (storm.delivered() < kResults && SteadyClock::now() - begin < std::chrono::seconds(60))
      storm.step();
    const std::chrono::duration<double> took = SteadyClock::now() - begin;
    EXPECT_EQ(storm.delivered(), static_cast<std::uint64_t>(kResults)) << collector.log();
    std::cout << hubs << " hubs: " << kResults / took.count() << " results a second; collector "
              << collector.resident_kib() << " KiB" << std::endl;
  }
}

}  // namespace
}  // namespace traygauge::test
