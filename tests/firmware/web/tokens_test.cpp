#include "firmware/web/tokens.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;

const std::string kFirst = "first-token-0123456789";
const std::string kSecond = "second+token/0123456789==";

class TokenFiles : public ::testing::Test {
 protected:
  TokenFile write(const char* name, const std::string& text, Role role = Role::view,
                  mode_t mode = 0600) const {
    const fs::path path = folder_.path() / name;
    fs::remove(path);
    std::ofstream(path) << text;
    ::chmod(path.c_str(), mode);
    return {path, role};
  }
  static std::string failure_of(const TokenFile& file) {
    TokenList list;
    const auto read = list.read(file);
    EXPECT_EQ(list.size() == 0, !read.ok());
    return read.ok() ? "" : read.failure();
  }

  TemporaryFolder folder_;
};

TEST_F(TokenFiles, GrantTheRoleOfTheirFile) {
  TokenList list;
  ASSERT_TRUE(list.read(write("view", "# of the hall\n\n" + kFirst + "  the hall's screen \r\n")).ok());
  ASSERT_TRUE(list.read(write("manage", kSecond, Role::manage)).ok());
  EXPECT_EQ(list.find(kFirst), (TokenHolder{Role::view, "the hall's screen"}));
  EXPECT_EQ(list.find(kSecond), (TokenHolder{Role::manage, ""}));
  for (const std::string& wrong : {std::string(), kFirst + "0", kFirst.substr(1), kFirst.substr(0, 21),
                                   std::string("#"), std::string(1000, 'x'), kFirst + std::string(1, '\0')}) {
    EXPECT_FALSE(list.find(wrong)) << wrong;
  }
}

// By whatever byte a text differs, at whatever place, it is not the token.
TEST_F(TokenFiles, CompareEveryByte) {
  const std::string longest(TokenList::kMaxCharacters, 'k');
  TokenList list;
  ASSERT_TRUE(list.read(write("view", longest + "\n" + kFirst)).ok());
  ASSERT_TRUE(list.find(longest));
  for (const std::string& token : {longest, kFirst}) {
    for (std::size_t at = 0; at < token.size(); ++at) {
      for (unsigned bit = 0; bit < 8; ++bit) {
        std::string wrong = token;
        wrong[at] = static_cast<char>(static_cast<unsigned char>(wrong[at]) ^ (1U << bit));
        ASSERT_FALSE(list.find(wrong)) << at;
      }
    }
    EXPECT_FALSE(list.find(token + "k"));
  }
}

TEST_F(TokenFiles, AreRefusedWhereOthersCanReadThem) {
  for (const mode_t mode : {0640U, 0604U, 0660U, 0644U, 0601U}) {
    const TokenFile file = write("view", kFirst, Role::view, mode);
    const std::string failure = failure_of(file);
    EXPECT_NE(failure.find("chmod 600 " + file.path.string()), std::string::npos) << failure;
  }
  EXPECT_EQ(failure_of(write("view", kFirst, Role::view, 0400)), "");
  EXPECT_NE(failure_of({folder_.path() / "absent", Role::view}).find("No such file"), std::string::npos);
  EXPECT_NE(failure_of({folder_.path(), Role::view}), "");
  const fs::path pipe = folder_.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(failure_of({pipe, Role::view}), "") << "and does not wait for a writer";
  EXPECT_NE(failure_of(write("view", std::string(100000, '#'))), "");
}

// The failure reaches logs and pages, which must not tell what stands in the file.
TEST_F(TokenFiles, SayWhichLineIsWrongAndNotWhatIsInIt) {
  for (const std::string& line : {std::string("short-secret"), std::string("secret\"with-quotes-0123456789"),
                                  std::string(200, 's'), kFirst + " again\xff", kFirst}) {
    const TokenFile file = write("view", kFirst + "\n" + line + "\n");
    const std::string failure = failure_of(file);
    EXPECT_NE(failure.find(file.path.string() + ":2: "), std::string::npos) << failure;
    EXPECT_EQ(failure.find("secret"), std::string::npos) << failure;
    EXPECT_EQ(failure.find(kFirst), std::string::npos) << failure;
  }
}

TEST_F(TokenFiles, AreReadAgainSoThatTokensCanBeRevoked) {
  const TokenFile view = write("view", kFirst);
  const TokenFile manage = write("manage", kSecond, Role::manage);
  Tokens tokens({view, manage});
  ASSERT_TRUE(tokens.read().ok());
  SteadyTime now{};
  const auto later = [&] {
    now += std::chrono::milliseconds(1001);
    tokens.refresh(now);
  };
  later();
  EXPECT_TRUE(tokens.find(kFirst));
  EXPECT_EQ(tokens.changes(), 0U);

  write("view", "another-token-0123456789");
  tokens.refresh(now + std::chrono::milliseconds(900));
  EXPECT_TRUE(tokens.find(kFirst)) << "read once a second";
  later();
  EXPECT_FALSE(tokens.find(kFirst));
  EXPECT_TRUE(tokens.find("another-token-0123456789"));
  EXPECT_EQ(tokens.changes(), 1U);

  // What cannot be read grants nothing, and the other file goes on.
  ::chmod(view.path.c_str(), 0644);
  later();
  EXPECT_FALSE(tokens.find("another-token-0123456789"));
  EXPECT_TRUE(tokens.find(kSecond));
  EXPECT_NE(tokens.problem().find("chmod 600"), std::string::npos);
  fs::remove(view.path);
  later();
  EXPECT_NE(tokens.problem().find(view.path.string()), std::string::npos);
  EXPECT_TRUE(tokens.are_configured());
  write("view", kFirst);
  later();
  EXPECT_TRUE(tokens.find(kFirst));
  EXPECT_EQ(tokens.problem(), "");
}

}  // namespace
}  // namespace traygauge::test
