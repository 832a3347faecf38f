// The hub as it ships, with one station that hands results over.
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "firmware/handover/hub_link.hpp"
#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/store/sample_scan.hpp"

namespace traygauge::test {

// `lines` stand at the end of its station file, in [hub] or after it.
class HubProgram {
 public:
  explicit HubProgram(const std::string& lines) {
    std::ofstream(folder_.path() / "station.toml")
        << "[station]\nname = \"kitchen\"\nsocket = \"hub\"\nfolder = \"f\"\n[hub]\nstore = \"r.db\"\n"
        << lines;
    start();
    HubLinkParams params;
    params.socket = folder_.path() / "hub";
    params.station = "kitchen";
    params.retry_after = std::chrono::milliseconds(1);
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
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
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

}  // namespace traygauge::test
