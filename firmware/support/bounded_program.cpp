#include "firmware/support/bounded_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <thread>

#include "firmware/base/file_descriptor.hpp"

namespace traygauge {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::size_t kMaxOutputBytes = 8UL * 1024 * 1024;

std::chrono::milliseconds time_until(SteadyClock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - SteadyClock::now());
  return std::max(left, std::chrono::milliseconds(0));
}

// In a group of its own, so that what it starts itself ends with it. Returns the error's number.
int start(const std::vector<std::string>& arguments, int output, pid_t& child) {
  std::vector<std::string> texts = arguments;
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error = posix_spawnp(&child, pointers.front(), &actions, &attributes, pointers.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

// Until its end, the deadline or the limit of bytes; true: its end.
bool read_output(int input, SteadyClock::time_point deadline, std::string& text) {
  std::array<char, 65536> part{};
  while (text.size() < kMaxOutputBytes) {
    pollfd waiting{input, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(time_until(deadline).count()));
    if (ready == 0) return false;
    const ssize_t count = ready < 0 ? -1 : ::read(input, part.data(), part.size());
    if (count == 0) return true;
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) text.append(part.data(), static_cast<std::size_t>(count));
  }
  return false;
}

bool has_ended(pid_t child, SteadyClock::time_point deadline) {
  constexpr std::chrono::milliseconds kPause(5);
  for (;;) {
    if (::waitpid(child, nullptr, WNOHANG) != 0) return true;
    if (time_until(deadline).count() == 0) return false;
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace

std::string output_of(const std::vector<std::string>& arguments, std::chrono::milliseconds limit) {
  const SteadyClock::time_point deadline = SteadyClock::now() + limit;
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) return "(no pipe could be made)\n";
  const FileDescriptor input(ends[0]);
  FileDescriptor output(ends[1]);
  pid_t child = 0;
  if (const int error = start(arguments, output.number(), child); error != 0) {
    if (error == ENOENT) return "(" + arguments.front() + " is not installed on this machine)\n";
    return "(" + arguments.front() + " could not be started: " + std::system_category().message(error) +
           ")\n";
  }
  output.close();
  std::string text;
  const bool is_whole = read_output(input.number(), deadline, text);
  if (is_whole && has_ended(child, deadline)) return text;
  ::kill(-child, SIGKILL);
  while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  if (text.size() >= kMaxOutputBytes) return text + "\n(cut: it wrote more than 8 MiB)\n";
  return text + "\n(cut: it did not end within " + std::to_string(limit.count() / 1000) + " s)\n";
}

}  // namespace traygauge
