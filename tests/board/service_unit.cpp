#include "tests/board/service_unit.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "tests/board/child_program.hpp"

namespace traygauge {
namespace {

constexpr int kNotInside = 255;

bool enter_group(const std::string& group) {
  std::ofstream processes("/sys/fs/cgroup" + group + "/cgroup.procs");
  processes << ::getpid() << std::flush;
  return processes.good();
}

// Both at once: in the first one's files the second would be out of sight.
bool enter_namespaces(const std::string& process) {
  const std::string folder = "/proc/" + process + "/ns/";
  const int network = ::open((folder + "net").c_str(), O_RDONLY | O_CLOEXEC);
  const int mounts = ::open((folder + "mnt").c_str(), O_RDONLY | O_CLOEXEC);
  return network >= 0 && mounts >= 0 && ::setns(network, CLONE_NEWNET) == 0 &&
         ::setns(mounts, CLONE_NEWNS) == 0;
}

}  // namespace

std::string ServiceUnit::property(const std::string& key) const {
  ChildProgram show("systemctl show --value --property=" + key + " " + name_);
  std::string value;
  show.read_line(value);
  return value;
}

bool ServiceUnit::has_logged(const std::string& text) const {
  ChildProgram log("journalctl --quiet --boot --output=cat --unit=" + name_);
  bool has_text = false;
  for (std::string line; log.read_line(line);) has_text = has_text || line.find(text) != std::string::npos;
  return has_text;
}

// In a child, which has one thread and ends with what `attempt` returns.
int ServiceUnit::try_inside(const std::function<int()>& attempt) const {
  const std::string process = property("MainPID");
  const std::string group = property("ControlGroup");
  if (process.empty() || process == "0" || group.empty()) return -1;
  const pid_t child = ::fork();
  if (child == 0) ::_exit(enter_group(group) && enter_namespaces(process) ? attempt() : kNotInside);
  int ended = 0;
  if (child < 0 || ::waitpid(child, &ended, 0) != child || !WIFEXITED(ended)) return -1;
  const int result = WEXITSTATUS(ended);
  return result == kNotInside ? -1 : result;
}

int ServiceUnit::open_device(const std::string& path) const {
  return try_inside(
      [&path] { return ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_NOCTTY | O_CLOEXEC) >= 0 ? 0 : errno; });
}

int ServiceUnit::connect_here(int port) const {
  return try_inside([port] {
    const int file = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    constexpr timeval kPatience{5, 0};
    ::setsockopt(file, SOL_SOCKET, SO_SNDTIMEO, &kPatience, sizeof kPatience);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(file, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return 0;
    return errno == EINPROGRESS ? ETIMEDOUT : errno;
  });
}

}  // namespace traygauge
