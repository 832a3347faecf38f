// Mosquitto as a process of the test's own, which ends with it.
#pragma once

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <string>

#include "tests/firmware/store/memory_folder.hpp"
#include "tests/support/logged_process.hpp"

namespace traygauge::test {

// Skips the test where Debian's package mosquitto is not installed; on CI that is a failure.
#define TRAYGAUGE_NEED_BROKER()                                               \
  if (!BrokerProcess::is_installed()) {                                       \
    if (std::getenv("CI") != nullptr) FAIL() << "mosquitto is not installed"; \
    GTEST_SKIP() << "mosquitto is not installed";                             \
  }

class BrokerProcess {
 public:
  static bool is_installed();

  // It listens at a free port of this machine. `lines` are of its configuration, after the listener's; FOLDER
  // in them becomes folder(). Without lines everybody may do everything. Nothing is kept on disk.
  explicit BrokerProcess(const std::string& lines = "allow_anonymous true\npersistence false\n");

  // Again, at the same port; returns when it answers.
  void start();
  void kill() { process_.end(SIGKILL); }

  std::uint16_t port() const { return port_; }
  // For files that it reads; there from before the constructor: see make_folder().
  const std::filesystem::path& folder() const { return folder_.path(); }
  std::string log() const { return process_.log(); }
  long resident_kib() const { return process_.resident_kib(); }

 private:
  MemoryFolder folder_;
  std::string lines_;
  std::uint16_t port_ = 0;
  LoggedProcess process_{folder_.path() / "broker.log"};
};

}  // namespace traygauge::test
