#include "firmware/command/confinement.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/gpio.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <thread>

namespace traygauge::test {
namespace {

// A filter holds for good: each test confines a process of its own, whose exit status counts the failures.
int failures_in_child(const std::function<int()>& test) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(test());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Whether a call that fails does so with that error; the call's name is printed where not.
int expect_error(const char* what, long result, int error) {
  if (result < 0 && errno == error) return 0;
  std::fprintf(stderr, "%s: expected error %d, found result %ld and error %d\n", what, error, result, errno);
  return 1;
}

int expect_done(const char* what, long result) {
  if (result >= 0) return 0;
  std::fprintf(stderr, "%s: failed with error %d\n", what, errno);
  return 1;
}

int expect_no_other_program() {
  char name[] = "/bin/true";
  char* const arguments[] = {name, nullptr};
  char* const environment[] = {nullptr};
  int failures = expect_error("execve", ::execve(name, arguments, environment), EPERM);
  failures += expect_error("io_uring_setup", ::syscall(SYS_io_uring_setup, 1, nullptr), EPERM);
  failures += expect_error("process_vm_readv",
                           ::syscall(SYS_process_vm_readv, ::getppid(), nullptr, 0, nullptr, 0, 0), EPERM);
  return failures;
}

TEST(Confinement, AStationOpensNoNetwork) {
  EXPECT_EQ(failures_in_child([] {
              if (!confine_station().ok()) return 100;
              int failures = 0;
              const auto refuse = [&failures] {
                for (const int family : {AF_INET, AF_INET6, AF_NETLINK, AF_PACKET, AF_BLUETOOTH, AF_VSOCK}) {
                  for (const int type : {SOCK_STREAM, SOCK_DGRAM, SOCK_RAW})
                    failures += expect_error("socket", ::socket(family, type, 0), EPERM);
                }
              };
              refuse();
              std::thread(refuse).join();
              return failures;
            }),
            0);
}

TEST(Confinement, AStationReachesHubAndDevices) {
  EXPECT_EQ(failures_in_child([] {
              if (!confine_station().ok()) return 100;
              int failures = expect_done("a Unix socket", ::socket(AF_UNIX, SOCK_STREAM, 0));
              const int device = ::open("/dev/null", O_RDWR);
              failures += expect_done("open", device);
              v4l2_capability camera{};
              // Only that it is no camera.
              failures += expect_error("VIDIOC_QUERYCAP", ::ioctl(device, VIDIOC_QUERYCAP, &camera), ENOTTY);
              return failures;
            }),
            0);
}

TEST(Confinement, AStationLeavesNoMemoryBehind) {
  EXPECT_EQ(failures_in_child([] {
              if (!confine_station().ok()) return 100;
              rlimit limit{};
              ::getrlimit(RLIMIT_CORE, &limit);
              return limit.rlim_max == 0 ? 0 : 1;
            }),
            0);
}

TEST(Confinement, AHubControlsNoDevice) {
  EXPECT_EQ(failures_in_child([] {
              if (!confine_hub().ok()) return 100;
              const int device = ::open("/dev/null", O_RDWR);
              v4l2_capability camera{};
              gpiochip_info chip{};
              termios port{};
              int failures = 0;
              failures += expect_error("VIDIOC_QUERYCAP", ::ioctl(device, VIDIOC_QUERYCAP, &camera), EPERM);
              failures += expect_error("GPIO_GET_CHIPINFO_IOCTL",
                                       ::ioctl(device, GPIO_GET_CHIPINFO_IOCTL, &chip), EPERM);
              failures += expect_error("TCSETS", ::ioctl(device, TCSETS, &port), EPERM);
              return failures;
            }),
            0);
}

TEST(Confinement, AHubServes) {
  EXPECT_EQ(failures_in_child([] {
              if (!confine_hub().ok()) return 100;
              const int server = ::socket(AF_INET, SOCK_STREAM, 0);
              int failures = expect_done("socket", server);
              failures += expect_done("O_NONBLOCK", ::fcntl(server, F_SETFL, O_NONBLOCK));
              failures += expect_done("listen", ::listen(server, 1));
              return failures;
            }),
            0);
}

TEST(Confinement, NeitherStartsAProgramNorGoesAroundItsRules) {
  EXPECT_EQ(failures_in_child([] { return confine_station().ok() ? expect_no_other_program() : 100; }), 0);
  EXPECT_EQ(failures_in_child([] { return confine_hub().ok() ? expect_no_other_program() : 100; }), 0);
}

}  // namespace
}  // namespace traygauge::test
