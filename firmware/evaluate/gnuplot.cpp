#include "firmware/evaluate/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <ostream>
#include <sstream>
#include <system_error>
#include <thread>

#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

constexpr std::chrono::milliseconds kPollInterval{5};
constexpr std::size_t kMaxSaid = 4096;  // bytes of its messages that are passed on

// Paths are absolute because gnuplot takes names that begin with "<" or "|" for commands, and "-" for its
// input.
std::vector<std::string> compose_command(const Plot& plot) {
  const fs::path script = fs::absolute(plot.script);
  std::vector<std::string> command = {"gnuplot",
                                      "--default-settings",
                                      script.parent_path() / "common.gp",
                                      "-c",
                                      script,
                                      fs::absolute(plot.data),
                                      fs::absolute(plot.svg)};
  command.insert(command.end(), plot.texts.begin(), plot.texts.end());
  return command;
}

// Its output goes nowhere, because ours may be JSON, and its messages to `messages`. Nothing where there is
// no such program.
std::optional<pid_t> start(std::vector<std::string> command, std::FILE* messages) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (std::string& argument : command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(messages), STDERR_FILENO);
  pid_t child = 0;
  const int problem = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem == 0) return child;
  // The last two: what PATH names is no folder, or one that nobody may look into.
  if (problem == ENOENT || problem == ENOTDIR || problem == EACCES) return std::nullopt;
  throw PlotError("gnuplot could not be started: " + std::generic_category().message(problem));
}

// Its status as waitpid() gives it. Nothing where it took too long and was ended.
std::optional<int> wait_for(pid_t child, std::chrono::milliseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() >= deadline) {
      kill(child, SIGKILL);
      while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
      }
      return std::nullopt;
    }
    std::this_thread::sleep_for(kPollInterval);
  }
  return status;
}

// On one line.
std::string read_messages(std::FILE* messages) {
  std::array<char, kMaxSaid> buffer{};
  std::rewind(messages);
  const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), messages);
  std::istringstream words(std::string(buffer.data(), size));
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

std::string describe_end(const std::optional<int>& status, std::chrono::milliseconds timeout) {
  if (!status) return "took longer than " + std::to_string(timeout.count()) + " ms";
  if (WIFSIGNALED(*status)) return std::string("was ended: ") + strsignal(WTERMSIG(*status));
  return "failed with exit status " + std::to_string(WEXITSTATUS(*status));
}

// Whether gnuplot is installed.
bool draw(const Plot& plot, std::chrono::milliseconds timeout) {
  const Stream messages(std::tmpfile(), &std::fclose);
  if (!messages) throw PlotError("no temporary file: " + std::generic_category().message(errno));
  const std::optional<pid_t> child = start(compose_command(plot), messages.get());
  if (!child) return false;
  const std::optional<int> status = wait_for(*child, timeout);
  if (status == 0) return true;
  std::error_code ignored;
  fs::remove(plot.svg, ignored);  // half of it, or nothing
  const std::string said = read_messages(messages.get());
  throw PlotError(printable(plot.svg.string()) + ": not drawn: gnuplot " + describe_end(status, timeout) +
                  (said.empty() ? "" : " and said: " + printable(said)));
}

}  // namespace

void draw_plots(const std::vector<Plot>& plots, std::ostream& error, std::chrono::milliseconds timeout) {
  std::error_code ignored;
  for (const Plot& plot : plots) fs::remove(plot.svg, ignored);
  for (const Plot& plot : plots) {
    if (draw(plot, timeout)) continue;
    error << "no plots: gnuplot is not installed; install the package gnuplot-nox\n";
    return;
  }
}

}  // namespace traygauge
