// A program whose lines are read.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdio>
#include <string>

namespace traygauge {

class ChildProgram {
 public:
  // Runs `command`, as a shell understands it.
  explicit ChildProgram(const std::string& command);
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;
  ~ChildProgram() { finish(); }

  // Blocks; false at the end, where `line` has what came without a line's end.
  bool read_line(std::string& line);
  // Waits for its end; its exit status.
  int finish();

  struct Memory {
    std::size_t peak_kib = 0;     // resident, so far
    std::size_t buffers_kib = 0;  // of it, the kernel's frame buffers that are mapped now
  };
  // While it runs; zeros afterwards.
  Memory memory() const;

 private:
  pid_t id_ = -1;
  std::FILE* stream_ = nullptr;
  int status_ = 127;
};

}  // namespace traygauge
