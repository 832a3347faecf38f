#include "tests/support/logged_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/becomes_true.hpp"

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
  becomes_true([this] { return handles(SIGTERM); });
  return end(SIGTERM);
}

std::string LoggedProcess::log() const {
  std::ifstream stream(log_);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

long LoggedProcess::status_kib(const std::string& key) const {
  const std::string kib = status_of(key);
  return kib.empty() ? 0 : std::stol(kib);
}

bool LoggedProcess::handles(int signal) const {
  const std::string caught = status_of("SigCgt:");
  return !caught.empty() && ((std::stoull(caught, nullptr, 16) >> (signal - 1)) & 1U) != 0;
}

std::string LoggedProcess::status_of(const std::string& key) const {
  std::ifstream status("/proc/" + std::to_string(id_) + "/status");
  for (std::string word, value; status >> word;) {
    if (word == key && status >> value) return value;
  }
  return {};
}

}  // namespace traygauge::test
