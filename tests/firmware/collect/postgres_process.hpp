// PostgreSQL as a process of the test's own, which ends with it.
#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/firmware/store/memory_folder.hpp"
#include "tests/support/logged_process.hpp"

namespace traygauge::test {

// Skips the test where Debian's package postgresql is not installed; on CI that is a failure.
#define TRAYGAUGE_NEED_POSTGRES()                                              \
  if (!PostgresProcess::is_installed()) {                                      \
    if (std::getenv("CI") != nullptr) FAIL() << "postgresql is not installed"; \
    GTEST_SKIP() << "postgresql is not installed";                             \
  }

class PostgresProcess {
 public:
  static bool is_installed();

  // An empty database that listens at a Unix socket alone; root runs it as the user postgres, as it demands.
  PostgresProcess();

  // Returns when it answers. `options`: settings such as "fsync=off".
  void start(const std::vector<std::string>& options = {});
  void end(int signal) { process_.end(signal); }

  std::string address() const { return "postgresql://postgres@/postgres?host=" + folder_.path().string(); }
  // The one value that a statement has; empty where it fails.
  std::string value_of(const std::string& statement) const;
  std::string log() const { return process_.log(); }

 private:
  std::vector<std::string> as_its_user(std::vector<std::string> arguments) const;

  MemoryFolder folder_;
  LoggedProcess process_{folder_.path() / "postgres.log"};
};

}  // namespace traygauge::test
