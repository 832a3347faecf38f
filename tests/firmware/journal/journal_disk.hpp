// What the tests of the journal share: a disk in memory, one path, ways to look inside.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "firmware/journal/journal.hpp"
#include "firmware/journal/journal_block.hpp"
#include "tests/support/recorded_file_system.hpp"

namespace traygauge::test {

inline const std::string kTestJournal = "state/results.journal";
inline constexpr std::uint64_t kTestJournalBytes = 16 * kBlockBytes;  // 14 blocks in the ring

inline std::unique_ptr<Journal> open_test_journal(FileSystem& disk,
                                                  std::uint64_t file_bytes = kTestJournalBytes) {
  auto opened = Journal::open(disk, {kTestJournal, file_bytes});
  EXPECT_TRUE(opened.ok()) << (opened.ok() ? "" : opened.failure());
  return opened.ok() ? std::move(*opened) : nullptr;
}

// "why not"; empty, and a failure of the test, where it worked.
template <class T>
std::string failure_of(const Expected<T>& result) {
  EXPECT_FALSE(result.ok());
  return result.ok() ? std::string() : result.failure();
}

inline std::vector<std::string> payloads_in(Journal& journal) {
  std::vector<std::string> payloads;
  std::uint64_t sequence = 0;
  for (;;) {
    const auto record = journal.next_after(sequence);
    EXPECT_TRUE(record.ok());
    if (!record.ok() || !record->has_value()) return payloads;
    sequence = (*record)->sequence;
    payloads.push_back((*record)->payload);
  }
}

// Appends payloads of these sizes, each of another letter from 'a' on.
inline std::vector<std::string> append_letters(Journal& journal, const std::vector<std::size_t>& sizes) {
  std::vector<std::string> payloads;
  for (const std::size_t size : sizes) {
    payloads.emplace_back(size, static_cast<char>('a' + payloads.size()));
    const auto stored = journal.append(payloads.back());
    EXPECT_TRUE(stored.ok()) << (stored.ok() ? "" : stored.failure());
  }
  return payloads;
}

// The first notice of this kind; one without text where there is none.
inline JournalNotice notice_among(const std::vector<JournalNotice>& notices, JournalNotice::Kind kind) {
  const auto found = std::find_if(notices.begin(), notices.end(),
                                  [&](const JournalNotice& notice) { return notice.kind == kind; });
  return found == notices.end() ? JournalNotice{} : *found;
}

inline Bytes file_on(const RecordedFileSystem& disk, const std::string& path = kTestJournal) {
  const DiskImage image = disk.image();
  const auto found = image.find(path);
  EXPECT_NE(found, image.end()) << path;
  return found == image.end() ? Bytes() : found->second;
}

inline void flip_bit(RecordedFileSystem& disk, std::size_t byte, unsigned bit = 0,
                     const std::string& path = kTestJournal) {
  Bytes bytes = file_on(disk, path);
  ASSERT_LT(byte, bytes.size());
  bytes[byte] ^= static_cast<std::byte>(1U << bit);
  disk.overwrite(path, std::move(bytes));
}

// Where the ring's block lies in the file.
inline std::size_t byte_of_block(std::size_t block) {
  return (1 + block) * kBlockBytes;
}

}  // namespace traygauge::test
