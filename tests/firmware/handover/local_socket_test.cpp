#include "firmware/handover/local_socket.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;

class LocalSocket : public ::testing::Test {
 protected:
  // The listener's end of a connection that was just asked for.
  static LocalConnection taken(LocalListener& listener) {
    auto connection = listener.accept();
    EXPECT_TRUE(connection.ok() && connection->is_open());
    return std::move(*connection);
  }

  TemporaryFolder folder_;
  fs::path path_ = folder_.path() / "hub";
};

TEST_F(LocalSocket, CarriesBytesBothWays) {
  auto listener = LocalListener::open(path_);
  ASSERT_TRUE(listener.ok()) << listener.failure();
  auto station = connect_local(path_);
  ASSERT_TRUE(station.ok()) << station.failure();
  LocalConnection hub = taken(*listener);
  ASSERT_TRUE(station->send_all("a result", Milliseconds(100)).ok());
  EXPECT_EQ(hub.receive_some(Milliseconds(100)).value(), "a result");
  ASSERT_TRUE(hub.send_all("stored", Milliseconds(100)).ok());
  EXPECT_EQ(station->receive_some(Milliseconds(100)).value(), "stored");
  EXPECT_EQ(station->receive_some(Milliseconds(0)).value(), "");
}

TEST_F(LocalSocket, SaysThatNobodyAnswers) {
  const auto connection = connect_local(path_);
  ASSERT_FALSE(connection.ok());
  EXPECT_NE(connection.failure().find(path_.string()), std::string::npos) << connection.failure();
  EXPECT_FALSE(connect_local(folder_.path() / std::string(200, 'x')).ok());
  EXPECT_FALSE(connect_local("").ok());
}

TEST_F(LocalSocket, NoticesThatThePeerLeft) {
  auto listener = LocalListener::open(path_);
  auto station = connect_local(path_);
  taken(*listener).close();
  EXPECT_FALSE(station->receive_some(Milliseconds(100)).ok());
  EXPECT_FALSE(station->send_all("x", Milliseconds(100)).ok());
}

// Not a byte more is sent once the time is over, so that a hub that hangs does not hang the station.
TEST_F(LocalSocket, DoesNotWaitForAPeerThatDoesNotRead) {
  auto listener = LocalListener::open(path_);
  auto station = connect_local(path_);
  const LocalConnection hub = taken(*listener);
  const std::string much(64UL * 1024 * 1024, 'x');
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_FALSE(station->send_all(much, Milliseconds(50)).ok());
  EXPECT_GE(std::chrono::steady_clock::now() - begin, Milliseconds(50));
}

TEST_F(LocalSocket, ReplacesWhatAKilledHubLeft) {
  {
    auto killed = LocalListener::open(path_);
    ASSERT_TRUE(killed.ok());
    fs::rename(path_, path_.string() + ".kept");  // its end then does not remove it
  }
  fs::rename(path_.string() + ".kept", path_);
  ASSERT_TRUE(fs::is_socket(path_));
  EXPECT_FALSE(connect_local(path_).ok());
  auto next = LocalListener::open(path_);
  ASSERT_TRUE(next.ok()) << next.failure();
  EXPECT_TRUE(connect_local(path_).ok());
}

TEST_F(LocalSocket, RespectsALivingHubAndForeignFiles) {
  auto first = LocalListener::open(path_);
  const auto second = LocalListener::open(path_);
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.failure().find("another hub"), std::string::npos) << second.failure();
  EXPECT_TRUE(connect_local(path_).ok());

  const fs::path precious = folder_.path() / "notes.txt";
  std::ofstream(precious) << "precious";
  EXPECT_FALSE(LocalListener::open(precious).ok());
  EXPECT_EQ(fs::file_size(precious), 8U);
}

TEST_F(LocalSocket, IsForItsUserAndGroupAlone) {
  auto listener = LocalListener::open(path_);
  struct stat found {};
  ASSERT_EQ(::stat(path_.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777U, 0660U);
}

TEST_F(LocalSocket, LeavesNoSocketBehind) {
  { auto listener = LocalListener::open(path_); }
  EXPECT_FALSE(fs::exists(path_));
}

}  // namespace
}  // namespace traygauge::test
