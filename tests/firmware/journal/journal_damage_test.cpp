// Bits that flip on the disk: what is whole is found, what is not is told and kept aside.
#include <gtest/gtest.h>

#include <random>
#include <span>

#include "tests/firmware/journal/journal_disk.hpp"
#include "tests/support/power_cut.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using Kind = JournalNotice::Kind;

std::vector<std::string> without(std::vector<std::string> payloads, std::size_t index) {
  payloads.erase(payloads.begin() + static_cast<std::ptrdiff_t>(index));
  return payloads;
}

// Records of 1, 2, 3 and 1 blocks, stopped in good order.
std::vector<std::string> make_four_records(RecordedFileSystem& disk) {
  return append_letters(*open_test_journal(disk), {100, 5000, 9000, 200});
}

TEST(JournalDamage, ARecordInTheMiddleIsToldAndKeptAside) {
  RecordedFileSystem disk;
  const auto payloads = make_four_records(disk);
  const Bytes before = file_on(disk);
  flip_bit(disk, byte_of_block(4) + 1000);
  auto journal = open_test_journal(disk);
  EXPECT_EQ(payloads_in(*journal), without(payloads, 2));
  const auto notices = journal->take_notices();
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_EQ(notices[0].kind, Kind::damaged);
  EXPECT_EQ(notices[0].first_sequence, 3U);
  EXPECT_EQ(notices[0].last_sequence, 3U);
  EXPECT_EQ(notices[0].bytes, 3 * kBlockBytes);
  EXPECT_EQ(notices[0].text, "state/results.journal: record 3 is damaged. The 12288 bytes are kept in " +
                                 notices[0].kept_in + ". Check the disk or card.");
  const auto begin = before.begin() + static_cast<std::ptrdiff_t>(byte_of_block(3));
  Bytes expected(begin, begin + 3 * kBlockBytes);
  expected[kBlockBytes + 1000] ^= std::byte{1};
  EXPECT_EQ(file_on(disk, notices[0].kept_in), expected);

  // Told again while it lies among records that wait, but kept once.
  journal.reset();
  const std::size_t files = disk.image().size();
  const std::uint64_t written = disk.bytes_written();
  journal = open_test_journal(disk);
  EXPECT_EQ(notice_among(journal->take_notices(), Kind::damaged).first_sequence, 3U);
  EXPECT_EQ(disk.image().size(), files);
  EXPECT_EQ(disk.bytes_written() - written, 2 * kBlockBytes);  // the heads
  EXPECT_EQ(*journal->append("next"), 5U);
}

TEST(JournalDamage, WhatIsKeptAsideOutlastsAPowerCut) {
  RecordedFileSystem disk;
  make_four_records(disk);
  flip_bit(disk, byte_of_block(4) + 1000);
  const auto journal = open_test_journal(disk);
  const std::string kept_in = notice_among(journal->take_notices(), Kind::damaged).kept_in;
  const PowerCut cut(disk, disk.operations().size());
  const DiskImage left = cut.state([](std::size_t) { return false; });
  ASSERT_TRUE(left.contains(kept_in));
  EXPECT_EQ(left.at(kept_in), file_on(disk, kept_in));
}

TEST(JournalDamage, TheOldestAndTheNewestAreToldToo) {
  for (const std::size_t index : {0U, 3U}) {
    RecordedFileSystem disk;
    const auto payloads = make_four_records(disk);
    flip_bit(disk, byte_of_block(index == 0 ? 0 : 6) + 60);
    auto journal = open_test_journal(disk);
    EXPECT_EQ(payloads_in(*journal), without(payloads, index));
    const auto notice = notice_among(journal->take_notices(), Kind::damaged);
    EXPECT_EQ(notice.first_sequence, index + 1);
    EXPECT_EQ(notice.bytes, kBlockBytes);
    EXPECT_EQ(*journal->append("next"), 5U);
    journal.reset();
    EXPECT_EQ(payloads_in(*open_test_journal(disk)).back(), "next");
  }
}

TEST(JournalDamage, NeighboursAreToldTogether) {
  RecordedFileSystem disk;
  const auto payloads = make_four_records(disk);
  flip_bit(disk, byte_of_block(2));
  flip_bit(disk, byte_of_block(3));
  const auto journal = open_test_journal(disk);
  EXPECT_EQ(payloads_in(*journal), (std::vector<std::string>{payloads[0], payloads[3]}));
  const auto notice = notice_among(journal->take_notices(), Kind::damaged);
  EXPECT_EQ(notice.text.substr(0, 55), "state/results.journal: records 2 to 3 are damaged. The ");
  EXPECT_EQ(notice.bytes, 5 * kBlockBytes);
}

TEST(JournalDamage, AWholeRingThatIsOneRecordIsKept) {
  RecordedFileSystem disk;
  append_letters(*open_test_journal(disk), {14 * kBlockPayloadBytes});
  flip_bit(disk, byte_of_block(5) + 100);
  const auto journal = open_test_journal(disk);
  EXPECT_EQ(notice_among(journal->take_notices(), Kind::damaged).bytes, 14 * kBlockBytes);
  EXPECT_TRUE(payloads_in(*journal).empty());
  EXPECT_TRUE(journal->append("next").ok());
}

TEST(JournalDamage, OneHeadIsEnoughAndTheOtherIsMended) {
  for (const std::size_t byte : {std::size_t{100}, std::size_t{kTestJournalBytes - kBlockBytes + 3}}) {
    RecordedFileSystem disk;
    const auto payloads = make_four_records(disk);
    flip_bit(disk, byte);
    auto journal = open_test_journal(disk);
    EXPECT_EQ(payloads_in(*journal), payloads);
    EXPECT_FALSE(notice_among(journal->take_notices(), Kind::head_repaired).text.empty());
    journal.reset();
    journal = open_test_journal(disk);
    EXPECT_TRUE(journal->take_notices().empty());
  }
}

TEST(JournalDamage, WithoutAHeadTheFileIsLeftAlone) {
  RecordedFileSystem disk;
  make_four_records(disk);
  flip_bit(disk, 100);
  flip_bit(disk, kTestJournalBytes - kBlockBytes + 100);
  const Bytes before = file_on(disk);
  EXPECT_EQ(
      failure_of(Journal::open(disk, {kTestJournal, kTestJournalBytes})),
      "state/results.journal: the first and the last block of this journal are damaged. Check the disk, and "
      "move the file away; a new one is then made. It was not changed.");
  EXPECT_EQ(file_on(disk), before);
}

// A checksum does not tell who wrote a head: its size is not to make the station read for hours.
TEST(JournalDamage, AHeadOfAFileLargerThanAnyJournalIsNone) {
  JournalHead head;
  head.oldest.sequence = 1;
  head.file_bytes = kMaxJournalBytes + kBlockBytes;
  Bytes block(kBlockBytes);
  encode_head(head, BlockBytes(block));
  RecordedFileSystem disk({{kTestJournal, block}});
  EXPECT_FALSE(Journal::open(disk, {kTestJournal, kTestJournalBytes}).ok());
  EXPECT_EQ(file_on(disk), block);
}

// Record 0 would wait for ever: whoever reads on asks for what comes after a number.
TEST(JournalDamage, NumbersThatNoRecordHasAreRefused) {
  JournalHead head;
  head.file_bytes = kTestJournalBytes;
  Bytes file(kTestJournalBytes);
  encode_head(head, BlockBytes(std::span(file).first<kBlockBytes>()));
  RecordedFileSystem before_first({{kTestJournal, file}});
  EXPECT_FALSE(Journal::open(before_first, {kTestJournal, kTestJournalBytes}).ok());
  head.oldest.sequence = head.next_sequence = kLastSequence;
  encode_head(head, BlockBytes(std::span(file).first<kBlockBytes>()));
  RecordedFileSystem at_last({{kTestJournal, file}});
  const auto journal = open_test_journal(at_last);
  EXPECT_TRUE(journal->append("last").ok());
  EXPECT_FALSE(journal->append("after the last").ok());
  EXPECT_EQ(payloads_in(*journal), (std::vector<std::string>{"last"}));
}

TEST(JournalDamage, WhatIsDamagedWhileTheJournalIsOpenIsPassedOver) {
  RecordedFileSystem disk;
  const auto journal = open_test_journal(disk);
  const auto payloads = append_letters(*journal, {100, 5000, 9000, 200});
  journal->take_notices();
  flip_bit(disk, byte_of_block(0) + 80);
  EXPECT_EQ(payloads_in(*journal), without(payloads, 0));
  const auto notices = journal->take_notices();
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_EQ(notices[0].first_sequence, 1U);
  EXPECT_EQ(file_on(disk, notices[0].kept_in).size(), kBlockBytes);
  EXPECT_EQ(journal->waiting_count(), 3U);
  EXPECT_TRUE(journal->remove_oldest(2).ok());
}

TEST(JournalDamage, WhatCannotBeKeptAsideIsToldAndDoesNotStopTheOthers) {
  RecordedFileSystem disk;
  const auto payloads = make_four_records(disk);
  flip_bit(disk, byte_of_block(1) + 80);
  disk.set_free_bytes(0);
  auto journal = open_test_journal(disk);
  EXPECT_EQ(payloads_in(*journal), without(payloads, 1));
  auto notice = notice_among(journal->take_notices(), Kind::damaged);
  EXPECT_TRUE(notice.kept_in.empty());
  EXPECT_NE(notice.text.find("could not be kept in this file: No space left on device."), std::string::npos);
  journal.reset();
  disk.set_free_bytes(1 << 20);
  journal = open_test_journal(disk);
  notice = notice_among(journal->take_notices(), Kind::damaged);
  EXPECT_EQ(file_on(disk, notice.kept_in).size(), 2 * kBlockBytes);
}

// A file of another size would not have the remains.
TEST(JournalDamage, WhatCannotBeKeptAsideIsNotLeftBehindByAnotherSize) {
  int not_kept = 0;
  for (std::size_t call = 0; call < 40; ++call) {
    RecordedFileSystem disk;
    make_four_records(disk);
    flip_bit(disk, byte_of_block(1) + 80);
    disk.set_fault(Fault{std::errc::no_space_on_device, call, false, true});
    const auto journal = Journal::open(disk, {kTestJournal, 2 * kTestJournalBytes});
    if (!journal.ok()) continue;
    const auto notice = notice_among((*journal)->take_notices(), Kind::damaged);
    if (!notice.kept_in.empty()) continue;
    ++not_kept;
    EXPECT_EQ((*journal)->file_bytes(), kTestJournalBytes) << "call " << call;
  }
  EXPECT_GT(not_kept, 0);
}

// Any bit anywhere: at most the record that has it is lost, and never without a notice.
TEST(JournalDamage, AFlippedBitCostsAtMostItsRecord) {
  std::mt19937 random(random_seed());
  RecordedFileSystem whole;
  const auto payloads = make_four_records(whole);
  const DiskImage image = whole.image();
  for (int i = 0; i < 2000; ++i) {
    RecordedFileSystem disk(image);
    flip_bit(disk, random() % kTestJournalBytes, random() % 8);
    const auto journal = open_test_journal(disk);
    ASSERT_NE(journal, nullptr);
    const auto found = payloads_in(*journal);
    const auto notices = journal->take_notices();
    if (found == payloads) continue;
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_EQ(notices[0].kind, Kind::damaged);
    EXPECT_EQ(notices[0].first_sequence, notices[0].last_sequence);
    EXPECT_EQ(found, without(payloads, notices[0].first_sequence - 1));
  }
}

// Whatever bytes a journal has: an answer, and nothing that was never appended.
TEST(JournalDamage, ManyRandomBytesDoNoHarm) {
  std::mt19937 random(random_seed());
  RecordedFileSystem whole;
  const auto payloads = make_four_records(whole);
  const DiskImage image = whole.image();
  for (int i = 0; i < 500; ++i) {
    Bytes bytes = image.at(kTestJournal);
    for (std::size_t blocks = 1 + random() % 10; blocks > 0; --blocks) {
      const std::size_t at = random() % 16 * kBlockBytes + random() % 4000;
      for (std::size_t k = 0; k < 64; ++k) bytes[at + k] = static_cast<std::byte>(random());
    }
    if (random() % 4 == 0) bytes.resize(random() % bytes.size());
    RecordedFileSystem disk(DiskImage{{kTestJournal, bytes}});
    auto journal = Journal::open(disk, {kTestJournal, kTestJournalBytes});
    if (!journal.ok()) continue;
    for (const std::string& payload : payloads_in(**journal)) {
      EXPECT_NE(std::find(payloads.begin(), payloads.end(), payload), payloads.end());
    }
    EXPECT_TRUE((*journal)->append("next").ok());
  }
}

// The newest record's blocks, each on the disk or not: all of them, or an append that was interrupted.
TEST(JournalDamage, AnInterruptedAppendIsToldOnceAndItsPlaceUsedAgain) {
  RecordedFileSystem disk;
  const auto cut_off = open_test_journal(disk);
  append_letters(*cut_off, {100});
  const std::size_t moment = disk.operations().size() + 1;  // the write alone
  EXPECT_TRUE(cut_off->append(std::string(5000, 'n')).ok());
  const PowerCut cut(disk, moment);
  ASSERT_EQ(cut.choice_count(), 17U);
  RecordedFileSystem left(cut.state([](std::size_t choice) { return choice < 10; }));
  auto journal = open_test_journal(left);
  const auto notice = notice_among(journal->take_notices(), Kind::interrupted);
  EXPECT_EQ(notice.first_sequence, 2U);
  EXPECT_EQ(notice.bytes, 2 * kBlockBytes);
  EXPECT_EQ(notice.kept_in, kTestJournal + ".interrupted");
  EXPECT_EQ(payloads_in(*journal), std::vector{std::string(100, 'a')});
  journal.reset();
  journal = open_test_journal(left);
  EXPECT_TRUE(journal->take_notices().empty());
  EXPECT_EQ(*journal->append("next"), 2U);
}

// All states of one sector each, of an append of one block.
TEST(JournalDamage, AnAppendIsWholeOrAbsentInEveryStateOfItsSectors) {
  RecordedFileSystem disk;
  const auto journal = open_test_journal(disk);
  append_letters(*journal, {100});
  const std::size_t moment = disk.operations().size() + 1;
  EXPECT_TRUE(journal->append(std::string(3000, 'n')).ok());
  const PowerCut cut(disk, moment);
  ASSERT_EQ(cut.choice_count(), 9U);
  int whole = 0;
  for (std::uint32_t state = 0; state < 512; ++state) {
    RecordedFileSystem left(cut.state([&](std::size_t choice) { return (state >> choice & 1) != 0; }));
    const auto reopened = open_test_journal(left);
    const auto found = payloads_in(*reopened);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.front(), std::string(100, 'a'));
    whole += static_cast<int>(found.size()) - 1;
    EXPECT_TRUE(notice_among(reopened->take_notices(), Kind::damaged).text.empty());
  }
  // Only sectors that hold anything but zeros matter: 6 of header and payload, one with the checksum. The
  // eighth and the file's size, each kept or not, make no difference.
  EXPECT_EQ(whole, 4);
}

// Two attempts at one record, each of which left one of two blocks.
TEST(JournalDamage, PartsOfTwoAttemptsMakeNoRecord) {
  constexpr std::size_t kSectorsInBlock = 8;
  RecordedFileSystem disk;
  const auto first = open_test_journal(disk);
  std::size_t moment = disk.operations().size() + 1;
  EXPECT_TRUE(first->append(std::string(5000, 'a')).ok());
  RecordedFileSystem disk_with_end(
      PowerCut(disk, moment).state([](std::size_t choice) { return choice > kSectorsInBlock; }));
  const auto second = open_test_journal(disk_with_end);
  EXPECT_EQ(second->waiting_count(), 0U);
  moment = disk_with_end.operations().size() + 1;
  EXPECT_EQ(*second->append(std::string(5000, 'b')), 1U);
  RecordedFileSystem disk_with_both(
      PowerCut(disk_with_end, moment).state([](std::size_t choice) { return choice <= kSectorsInBlock; }));
  const auto third = open_test_journal(disk_with_both);
  EXPECT_EQ(third->waiting_count(), 0U);
  EXPECT_FALSE(notice_among(third->take_notices(), Kind::interrupted).text.empty());
}

}  // namespace
}  // namespace traygauge::test
