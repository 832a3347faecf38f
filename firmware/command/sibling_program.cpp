#include "firmware/command/sibling_program.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "firmware/base/exit_status.hpp"

namespace traygauge {

std::string sibling_path(const std::string& name) {
  std::error_code ignored;
  return (std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path() / name).string();
}

int run_sibling_program(const std::string& name, const std::vector<std::string>& arguments) {
  const std::string program = sibling_path(name);
  std::vector<std::string> texts = {program};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), nullptr, nullptr, pointers.data(), environ);
  if (error != 0) {
    throw UsageError(program + " could not be started (" + std::strerror(error) +
                     "); it is built and installed together with traygauge");
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : kExitWrongUse;
}

void become_sibling_program(const std::string& name, char* const* arguments) {
  execv(sibling_path(name).c_str(), arguments);
}

}  // namespace traygauge
