#include "firmware/journal/format_check.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "firmware/journal/journal.hpp"
#include "firmware/journal/journal_block.hpp"
#include "firmware/journal/posix_file_system.hpp"
#include "firmware/journal/scan_counter.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;

// Journal and counter keep their version at this byte of a block, whatever their version is.
constexpr std::streamoff kVersionByte = 8;

class FormatCheck : public ::testing::Test {
 protected:
  void make_both() {
    ASSERT_TRUE(Journal::open(posix_file_system(), {journal(), kMinJournalBytes}).ok());
    const auto opened = ScanCounter::open(posix_file_system(), counter(), 0);
    ASSERT_TRUE(opened.ok());
    // Both blocks are written by now.
    for (int i = 0; i < 200; ++i) ASSERT_TRUE((*opened)->next().ok());
  }
  // In the block that begins at this byte, or so many before the end.
  static void write_version(const std::string& file, std::streamoff block, std::ios::seekdir from,
                            char version) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(block + kVersionByte, from);
    stream.put(version);
    ASSERT_TRUE(stream.good());
  }
  std::string journal() const { return (folder_.path() / "waiting").string(); }
  std::string counter() const { return (folder_.path() / "last_scan").string(); }

  TemporaryFolder folder_;
};

TEST_F(FormatCheck, PassesWhatThisProgramWroteAndWhatIsAbsent) {
  EXPECT_TRUE(check_journal_format(journal()).ok());
  EXPECT_TRUE(check_counter_format(counter()).ok());
  make_both();
  EXPECT_TRUE(check_journal_format(journal()).ok());
  EXPECT_TRUE(check_counter_format(counter()).ok());
}

TEST_F(FormatCheck, NamesWhatANewerProgramWroteInEitherBlock) {
  const auto block = static_cast<std::streamoff>(kBlockBytes);
  for (const bool is_last : {false, true}) {
    make_both();
    const auto from = is_last ? std::ios::end : std::ios::beg;
    write_version(journal(), is_last ? -block : 0, from, 100);
    write_version(counter(), is_last ? -block : 0, from, 100);
    const Expected<void> of_journal = check_journal_format(journal());
    ASSERT_FALSE(of_journal.ok()) << is_last;
    EXPECT_EQ(of_journal.failure(),
              journal() + ": a newer program wrote this journal. Install that program again.");
    const Expected<void> of_counter = check_counter_format(counter());
    ASSERT_FALSE(of_counter.ok()) << is_last;
    EXPECT_NE(of_counter.failure().find("a newer program wrote this counter of scans"), std::string::npos);
    fs::remove(journal());
    fs::remove(counter());
  }
}

// The station meets it when it opens the file, and says what became of it.
TEST_F(FormatCheck, PassesWhatIsDamagedOrShort) {
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{10}, kBlockBytes, 3 * kBlockBytes}) {
    std::ofstream(journal(), std::ios::binary) << std::string(bytes, 'x');
    EXPECT_TRUE(check_journal_format(journal()).ok()) << bytes;
    EXPECT_TRUE(check_counter_format(journal()).ok()) << bytes;
  }
}

TEST_F(FormatCheck, LeavesTheFilesAsTheyAre) {
  make_both();
  const auto before = fs::last_write_time(journal());
  fs::permissions(journal(), fs::perms::owner_read);
  EXPECT_TRUE(check_journal_format(journal()).ok());
  EXPECT_EQ(fs::last_write_time(journal()), before);
}

}  // namespace
}  // namespace traygauge::test
