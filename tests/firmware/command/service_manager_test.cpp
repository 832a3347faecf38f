#include "firmware/command/service_manager.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

// What systemd has at its end.
class Manager {
 public:
  // A name that begins with '@' stands in no folder.
  explicit Manager(const std::string& path) : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.data(), path.size());
    if (path[0] == '@') address.sun_path[0] = '\0';
    const std::size_t size = offsetof(sockaddr_un, sun_path) + path.size();
    EXPECT_EQ(
        ::bind(socket_.number(), reinterpret_cast<const sockaddr*>(&address), static_cast<socklen_t>(size)),
        0);
    ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
  }
  ~Manager() { ::unsetenv("NOTIFY_SOCKET"); }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;

  std::vector<std::string> heard() const {
    std::vector<std::string> texts;
    std::array<char, 256> text{};
    for (;;) {
      const ssize_t size = ::recv(socket_.number(), text.data(), text.size(), 0);
      if (size < 0) return texts;
      texts.emplace_back(text.data(), static_cast<std::size_t>(size));
    }
  }

 private:
  FileDescriptor socket_;
};

const std::vector<std::string> kALife = {"READY=1\nWATCHDOG=1", "WATCHDOG=1", "STOPPING=1"};

void live() {
  ServiceManager told;
  told.note_progress();
  told.note_progress();
  told.note_stopping();
}

TEST(ServiceManager, HearsThatTheServiceRunsGetsOnAndStops) {
  const TemporaryFolder folder;
  const Manager manager(folder.path() / "notify");
  live();
  EXPECT_EQ(manager.heard(), kALife);
}

TEST(ServiceManager, IsFoundUnderANameInNoFolder) {
  const Manager manager("@traygauge-test-" + std::to_string(::getpid()));
  live();
  EXPECT_EQ(manager.heard(), kALife);
}

TEST(ServiceManager, MayBeAbsentOrGone) {
  live();
  const TemporaryFolder folder;
  ::setenv("NOTIFY_SOCKET", (folder.path() / "nobody").c_str(), 1);
  live();
  ::setenv("NOTIFY_SOCKET", std::string(200, '/').c_str(), 1);
  live();
  ::setenv("NOTIFY_SOCKET", "no path", 1);
  live();
  ::unsetenv("NOTIFY_SOCKET");
}

// A manager that does not read stops nobody.
TEST(ServiceManager, MayHang) {
  const TemporaryFolder folder;
  const Manager manager(folder.path() / "notify");
  ServiceManager told;
  for (int i = 0; i < 100'000; ++i) told.note_progress();
  EXPECT_FALSE(manager.heard().empty());
}

}  // namespace
}  // namespace traygauge::test
