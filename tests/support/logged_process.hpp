// A program that a test starts, kills and starts again. It ends with the test, however that ends.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace traygauge::test {

class LoggedProcess {
 public:
  // What it prints is appended to `log`.
  explicit LoggedProcess(std::filesystem::path log) : log_(std::move(log)) {}
  ~LoggedProcess();
  LoggedProcess(const LoggedProcess&) = delete;
  LoggedProcess& operator=(const LoggedProcess&) = delete;

  // The first argument is the program's path. Without `environment` it has the test's.
  void start(std::vector<std::string> arguments, std::vector<std::string> environment = {});
  // Waits for the end; the status as waitpid() has it, 0 where nothing runs.
  int end(int signal);
  // Ends it by SIGTERM once it handles that, which a program does not from its first moment.
  int stop();

  std::string log() const;
  // KiB, now and at most since the start; 0 where nothing runs.
  long resident_kib() const { return status_kib("VmRSS:"); }
  long peak_kib() const { return status_kib("VmHWM:"); }

 private:
  long status_kib(const std::string& key) const;
  bool handles(int signal) const;
  // What stands behind a key of /proc/PID/status; empty where nothing runs.
  std::string status_of(const std::string& key) const;

  std::filesystem::path log_;
  pid_t id_ = 0;
};

}  // namespace traygauge::test
