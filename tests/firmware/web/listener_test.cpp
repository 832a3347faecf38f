#include "firmware/web/listener.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "tests/firmware/web/web_client.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;

TEST(UnixListeners, ReplaceWhatAKilledHubLeftAndNothingElse) {
  const TemporaryFolder folder;
  const ListenAddress address = *parse_listen_address((folder.path() / "web").string());
  {
    auto killed = Listener::open(address);
    ASSERT_TRUE(killed.ok()) << killed.failure();
    struct stat found {};
    ASSERT_EQ(::stat(address.path.c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777U, 0660U);
    const auto second = Listener::open(address);
    ASSERT_FALSE(second.ok());
    EXPECT_NE(second.failure().find("another program listens"), std::string::npos) << second.failure();
    fs::rename(address.path, folder.path() / "kept");  // its end then does not remove it
  }
  fs::rename(folder.path() / "kept", address.path);
  ASSERT_TRUE(fs::is_socket(address.path));
  auto next = Listener::open(address);
  ASSERT_TRUE(next.ok()) << next.failure();
  EXPECT_TRUE(WebClient(address.path).is_connected());

  const fs::path notes = folder.path() / "notes";
  std::ofstream(notes) << "precious";
  EXPECT_FALSE(Listener::open(*parse_listen_address(notes.string())).ok());
  EXPECT_EQ(fs::file_size(notes), 8U);
}

}  // namespace
}  // namespace traygauge::test
