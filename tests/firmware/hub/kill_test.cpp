// Station and hub are killed at random moments under load: what was shown as done or kept is stored, once.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "firmware/store/open_store.hpp"
#include "tests/support/random_seed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;

int kill_count() {
  constexpr int kOnEveryRun = 100;
  const char* const given = std::getenv("TRAYGAUGE_KILLS");
  return given != nullptr ? std::atoi(given) : kOnEveryRun;
}

// A program that runs until it is killed; its output goes to `output`, or nowhere.
class Child {
 public:
  void start(std::vector<std::string> arguments, int output) {
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    if (output >= 0) {
      posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    } else {
      posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    }
    ASSERT_EQ(::posix_spawn(&process_, pointers[0], &actions, nullptr, pointers.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
  }
  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    wait();
  }
  int wait() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = 0;
    return status;
  }
  ~Child() { kill(); }

 private:
  pid_t process_ = 0;
};

// The names that a rig called done or kept.
class Shown {
 public:
  Shown() {
    if (::pipe2(ends_, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    ::fcntl(ends_[0], F_SETFL, O_NONBLOCK);
  }
  ~Shown() {
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  int input() const { return ends_[1]; }
  void read_all() {
    char buffer[65536];
    for (;;) {
      const ssize_t count = ::read(ends_[0], buffer, sizeof(buffer));
      if (count <= 0) break;
      pending_.append(buffer, static_cast<std::size_t>(count));
    }
    for (std::size_t end = pending_.find('\n'); end != std::string::npos; end = pending_.find('\n')) {
      const std::string line = pending_.substr(0, end);
      pending_.erase(0, end + 1);
      if (line == "empty") {
        is_empty = true;
      } else {
        (line.starts_with("done ") ? done : kept).insert(line.substr(5));
      }
    }
  }
  std::set<std::string> done;
  std::set<std::string> kept;
  bool is_empty = false;

 private:
  int ends_[2] = {-1, -1};
  std::string pending_;
};

TEST(Kill, NothingShownIsLostOrDoubled) {
  std::mt19937 random(random_seed());
  const TemporaryFolder folder;
  const std::string path = folder.path();
  const std::string store = path + "/results.db";
  Shown shown;
  Child hub;
  Child station;
  const auto start_hub = [&] {
    hub.start({TRAYGAUGE_HUB, "hub", "--socket", path + "/hub", "--store", store}, -1);
  };
  int runs = 0;
  const auto start_station = [&](int count) {
    station.start({TRAYGAUGE_RIG, path, "run" + std::to_string(++runs), std::to_string(count)},
                  shown.input());
  };
  constexpr int kWithoutEnd = 1'000'000;
  start_hub();
  start_station(kWithoutEnd);
  // On a slow machine both would else die before they have started, and nothing would ever be done.
  const auto wait_for_next_done = [&shown] {
    const std::size_t before = shown.done.size();
    for (int i = 0; i < 2000 && shown.done.size() == before; ++i) {
      std::this_thread::sleep_for(milliseconds(5));
      shown.read_all();
    }
  };
  const int kills = kill_count();
  for (int i = 0; i < kills; ++i) {
    if (i % 2 == 1) wait_for_next_done();
    std::this_thread::sleep_for(milliseconds(std::uniform_int_distribution<int>(1, 200)(random)));
    shown.read_all();
    const auto victim = std::uniform_int_distribution<int>(0, 3)(random);
    if (victim != 0) hub.kill();
    if (victim == 0 || victim == 3) station.kill();
    shown.read_all();
    // Sometimes the hub stays away for a while, so that results wait.
    if (victim != 0 && random() % 3 == 0) std::this_thread::sleep_for(milliseconds(20));
    if (victim != 0) start_hub();
    if (victim == 0 || victim == 3) start_station(kWithoutEnd);
  }
  station.kill();
  shown.read_all();
  start_station(1);
  for (int i = 0; i < 3000 && !shown.is_empty; ++i) {
    std::this_thread::sleep_for(milliseconds(10));
    shown.read_all();
  }
  ASSERT_TRUE(shown.is_empty) << "the hub did not take what waited within 30 s";
  hub.kill();

  StoreOptions options;
  options.file = store;
  const Expected<OpenedStore> opened = open_store(options, read_wall_clock());
  ASSERT_TRUE(opened.ok()) << opened.failure();
  EXPECT_TRUE(opened->notices.empty()) << opened->notices.front();
  std::map<std::string, int> stored;
  const Expected<void> read = opened->store->history().for_each({}, [&](const StoredScan& scan) {
    ++stored[nlohmann::json::parse(scan.document).at("tray").get<std::string>()];
    return true;
  });
  ASSERT_TRUE(read.ok()) << read.failure();
  for (const auto& [tray, count] : stored) EXPECT_EQ(count, 1) << tray;
  for (const auto* const names : {&shown.done, &shown.kept}) {
    for (const std::string& tray : *names) EXPECT_TRUE(stored.contains(tray)) << tray << " is lost";
  }
  const Expected<StoreTotals> totals = opened->store->scans().totals();
  ASSERT_TRUE(totals.ok());
  EXPECT_EQ(totals->counts.set_aside, 0);
  std::cout << kills << " kills: " << shown.done.size() << " shown as done, " << shown.kept.size()
            << " as kept, " << stored.size() << " stored" << std::endl;
  EXPECT_GE(shown.done.size(), static_cast<std::size_t>(kills / 4));
  EXPECT_GT(shown.kept.size(), 0U);
}

}  // namespace
}  // namespace traygauge::test
