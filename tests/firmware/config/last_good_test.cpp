#include "firmware/config/last_good.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <string>

#include "firmware/base/exit_status.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;

// A configuration is its text; one that begins with "bad" is refused, one with "stop" in it wants to stop.
class LastGood : public ::testing::Test {
 protected:
  void write(const std::string& text) const { std::ofstream(file()) << text; }
  static std::string content(const fs::path& path) {
    std::ifstream stream(path);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  ChosenConfig<std::string> choose(const fs::path& copy) const {
    return read_or_last_good(
        file(), copy,
        [](const fs::path& path) {
          const std::string text = content(path);
          if (text.starts_with("bad")) throw UsageError(path.string() + ": is bad");
          return text;
        },
        [](const std::string& text) {
          return text.find("stop") != std::string::npos ? OnBadConfig::stop : OnBadConfig::keep;
        });
  }
  fs::path file() const { return folder_.path() / "station.toml"; }
  fs::path copy() const { return folder_.path() / "last-good.toml"; }

  TemporaryFolder folder_;
};

TEST_F(LastGood, IsWhatCountsWhereALaterOneIsBad) {
  write("first");
  EXPECT_EQ(choose(copy()).config, "first");
  EXPECT_TRUE(choose(copy()).problem.empty());
  write("bad");
  const auto chosen = choose(copy());
  EXPECT_EQ(chosen.config, "first");
  EXPECT_NE(chosen.problem.find("station.toml: is bad"), std::string::npos) << chosen.problem;
  write("second");
  EXPECT_EQ(choose(copy()).config, "second");
  write("bad");
  EXPECT_EQ(choose(copy()).config, "second");
}

TEST_F(LastGood, MayWantToStopInstead) {
  write("stop");
  choose(copy());
  write("bad");
  EXPECT_THROW(choose(copy()), UsageError);
}

TEST_F(LastGood, ThatIsAbsentOrNotWantedHelpsNobody) {
  write("bad");
  EXPECT_THROW(choose(copy()), UsageError);
  EXPECT_THROW(choose({}), UsageError);
  EXPECT_FALSE(fs::exists(copy()));
  write("good");
  EXPECT_TRUE(choose({}).problem.empty());
}

TEST_F(LastGood, ThatIsBadToo) {
  write("good");
  choose(copy());
  write("bad");
  std::ofstream(copy()) << "bad as well";
  EXPECT_THROW(choose(copy()), UsageError);
}

// A card wears out by writes.
TEST_F(LastGood, IsWrittenOnlyWhenItIsAnotherOne) {
  write("good");
  choose(copy());
  struct stat before {};
  ASSERT_EQ(::stat(copy().c_str(), &before), 0);
  choose(copy());
  struct stat after {};
  ASSERT_EQ(::stat(copy().c_str(), &after), 0);
  EXPECT_EQ(before.st_ino, after.st_ino);
  EXPECT_EQ(before.st_mtim.tv_nsec, after.st_mtim.tv_nsec);
}

TEST_F(LastGood, ThatCannotBeKeptIsTold) {
  write("good");
  const auto chosen = choose(folder_.path() / "no such folder" / "last-good.toml");
  EXPECT_EQ(chosen.config, "good");
  EXPECT_NE(chosen.problem.find("could not be kept"), std::string::npos);
}

}  // namespace
}  // namespace traygauge::test
