#include "tests/support/logged_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <thread>

namespace traygauge::test {
namespace {

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

LoggedProcess::~LoggedProcess() {
  end(SIGKILL);
}

// Between fork() and exec() nothing may allocate: the test may have threads.
void LoggedProcess::start(std::vector<std::string> arguments, std::vector<std::string> environment) {
  const std::vector<char*> words = pointers_to(arguments);
  const std::vector<char*> variables = pointers_to(environment);
  char* const* const its_environment = environment.empty() ? environ : variables.data();
  const pid_t parent = ::getpid();
  id_ = ::fork();
  if (id_ != 0) return;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  const int file = ::open(log_.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  ::dup2(file, STDOUT_FILENO);
  ::dup2(file, STDERR_FILENO);
  ::execve(words[0], words.data(), its_environment);
  ::_exit(1);
}

int LoggedProcess::end(int signal) {
  if (id_ == 0) return 0;
  int status = 0;
  ::kill(id_, signal);
  ::waitpid(id_, &status, 0);
  id_ = 0;
  return status;
}

int LoggedProcess::stop() {
  constexpr std::chrono::seconds kLongestStart{20};
  const auto end_of_wait = std::chrono::steady_clock::now() + kLongestStart;
  while (!handles(SIGTERM) && std::chrono::steady_clock::now() < end_of_wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return end(SIGTERM);
}

std::string LoggedProcess::log() const {
  std::ifstream stream(log_);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

long LoggedProcess::status_kib(const std::string& key) const {
  std::ifstream status("/proc/" + std::to_string(id_) + "/status");
  for (std::string word; status >> word;) {
    long kib = 0;
    if (word == key && status >> kib) return kib;
  }
  return 0;
}

bool LoggedProcess::handles(int signal) const {
  std::ifstream status("/proc/" + std::to_string(id_) + "/status");
  for (std::string word; status >> word;) {
    std::uint64_t caught = 0;
    if (word == "SigCgt:" && status >> std::hex >> caught) return ((caught >> (signal - 1)) & 1U) != 0;
  }
  return false;
}

}  // namespace traygauge::test
