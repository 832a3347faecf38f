// The hub as it ships, under its filter of system calls: it looks a name up, speaks TLS and signs; and it is
// killed again and again.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "firmware/handover/hub_link.hpp"
#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/firmware/webhook/receiver.hpp"
#include "tests/firmware/webhook/tls_receiver.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using std::chrono::milliseconds;

class HubProgram {
 public:
  explicit HubProgram(const std::string& webhook) {
    std::ofstream(folder_.path() / "station.toml")
        << "[station]\nname = \"kitchen\"\nsocket = \"hub\"\nfolder = \"f\"\n[hub]\nstore = \"r.db\"\n"
        << webhook;
    start();
    HubLinkParams params;
    params.socket = folder_.path() / "hub";
    params.station = "kitchen";
    params.retry_after = milliseconds(1);
    link_ = std::make_unique<HubLink>(params);
  }
  ~HubProgram() { kill(); }
  HubProgram(const HubProgram&) = delete;
  HubProgram& operator=(const HubProgram&) = delete;

  void start() {
    std::vector<std::string> arguments{TRAYGAUGE_HUB, "hub", "--config", folder_.path() / "station.toml"};
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (folder_.path() / "log").c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND, 0600);
    const int failed = ::posix_spawn(&process_, pointers[0], &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error("the hub does not start");
  }
  void kill() {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  // As a station does: until the hub says that it has it.
  void deliver(std::uint64_t number) {
    const std::string id = scan_id_text({"kitchen", number});
    for (int i = 0; i < 5000; ++i) {
      if (link_->deliver(id, sample_document(number)).answer == HubAnswer::stored) return;
      std::this_thread::sleep_for(milliseconds(1));
    }
    throw std::runtime_error("the hub stores nothing: " + log());
  }
  std::string log() const {
    std::ifstream stream(folder_.path() / "log");
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  MemoryFolder folder_;
  pid_t process_ = 0;
  std::unique_ptr<HubLink> link_;
};

bool becomes_true(const std::function<bool()>& condition) {
  for (int i = 0; i < 1000 && !condition(); ++i) std::this_thread::sleep_for(milliseconds(10));
  return condition();
}

TEST(WebhookProgram, SpeaksTlsUnderItsFilter) {
  const MemoryFolder folder;
  const Certificate certificate("localhost");
  certificate.write(folder.path() / "ca.pem");
  const TlsReceiver receiver(certificate);
  HubProgram hub("webhook = \"https://localhost:" + std::to_string(receiver.port()) + "/\"\nwebhook_ca = \"" +
                 (folder.path() / "ca.pem").string() + "\"\n");
  hub.deliver(1);
  EXPECT_TRUE(becomes_true([&] { return receiver.answered() == 1; })) << hub.log();
}

TEST(WebhookProgram, KillsLoseNothingAndKeepTheOrder) {
  std::mt19937 random(random_seed());
  const auto take = [](const ReceivedMessage&) { return Reply::status(200); };
  const Receiver receiver(take);
  HubProgram hub("webhook = \"" + receiver.url() + "\"\n");
  std::vector<std::string> stored;
  for (std::uint64_t number = 1; number <= 200; ++number) {
    hub.deliver(number);
    stored.push_back(scan_id_text({"kitchen", number}));
    if (random() % 10 != 0) continue;
    std::this_thread::sleep_for(milliseconds(random() % 5));
    hub.kill();
    hub.start();
  }
  std::vector<std::string> first_times;
  EXPECT_TRUE(becomes_true([&] {
    first_times.clear();
    for (const std::string& id : receiver.event_ids()) {
      if (std::find(first_times.begin(), first_times.end(), id) == first_times.end())
        first_times.push_back(id);
    }
    return first_times.size() >= stored.size();
  })) << hub.log();
  EXPECT_EQ(first_times, stored);
  std::cout << stored.size() << " stored, told " << receiver.event_ids().size() << " times" << std::endl;
}

}  // namespace
}  // namespace traygauge::test
