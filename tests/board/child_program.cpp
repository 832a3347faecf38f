#include "tests/board/child_program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace traygauge {
namespace {

// The number after `key` in one of proc's lines.
std::size_t number_after(const std::string& line, const std::string& key) {
  std::size_t number = 0;
  if (line.starts_with(key)) std::istringstream(line.substr(key.size())) >> number;
  return number;
}

}  // namespace

// The shell is replaced by the program, so that its id is the program's.
ChildProgram::ChildProgram(const std::string& command) {
  const std::string text = "exec " + command;
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  id_ = ::fork();
  if (id_ == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    ::execl("/bin/sh", "sh", "-c", text.c_str(), nullptr);
    ::_exit(127);
  }
  ::close(ends[1]);
  if (id_ < 0) throw std::runtime_error("no process for " + command);
  stream_ = ::fdopen(ends[0], "r");
}

bool ChildProgram::read_line(std::string& line) {
  line.clear();
  for (int letter = std::fgetc(stream_); letter != EOF; letter = std::fgetc(stream_)) {
    if (letter == '\n') return true;
    line += static_cast<char>(letter);
  }
  return false;
}

int ChildProgram::finish() {
  if (stream_ == nullptr) return status_;
  std::fclose(stream_);
  stream_ = nullptr;
  int ended = 0;
  if (::waitpid(id_, &ended, 0) == id_ && WIFEXITED(ended)) status_ = WEXITSTATUS(ended);
  return status_;
}

ChildProgram::Memory ChildProgram::memory() const {
  const std::string folder = "/proc/" + std::to_string(id_) + "/";
  Memory memory;
  std::ifstream status(folder + "status");
  for (std::string line; std::getline(status, line);) memory.peak_kib += number_after(line, "VmHWM:");
  std::ifstream maps(folder + "smaps");
  bool is_buffer = false;
  for (std::string line; std::getline(maps, line);) {
    const std::string first = line.substr(0, line.find(' '));
    if (first.find('-') != std::string::npos) is_buffer = line.find("/dev/video") != std::string::npos;
    if (is_buffer) memory.buffers_kib += number_after(line, "Rss:");
  }
  return memory;
}

}  // namespace traygauge
