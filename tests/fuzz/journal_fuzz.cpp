// Any bytes as a journal's file: it is opened, or refused and left as it was, but where the disk is full:
// then nothing that waits is lost. What is found in an opened one is given back and stays, together with what
// is appended, until it is removed. First two bytes: how the file is made of what follows, and the configured
// size. Then blocks: a byte, how many bytes come, and these; zeros up to the block's end.
#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/crc32c.hpp"
#include "core/base/little_endian.hpp"
#include "firmware/journal/journal.hpp"
#include "firmware/journal/scan_counter.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/support/recorded_file_system.hpp"

namespace traygauge {
namespace {

using test::Bytes;
using test::RecordedFileSystem;

constexpr const char* kPath = "state/waiting";
constexpr std::size_t kMaxBlocks = 32;
constexpr std::size_t kChecksumAt = kBlockBytes - kChecksumBytes;

// How a file is made of an input: without right checksums no change gets far.
struct Making {
  explicit Making(std::size_t byte)
      : seals_blocks(byte % 2 == 1),
        seals_payloads(byte / 2 % 2 == 1),
        ends_early(byte / 4 % 2 == 1),
        is_counter(byte / 8 % 2 == 1) {}
  bool seals_blocks;
  bool seals_payloads;  // of records of one block
  bool ends_early;      // the last block is not filled
  bool is_counter;      // the file with the number of the next scan
};

void seal_payload(std::span<std::byte> block) {
  constexpr std::uint32_t kRecordMagic = 0x4b424a54;
  constexpr std::size_t kBytesAt = 36;
  if (load_little_endian<std::uint32_t>(block, 0) != kRecordMagic) return;
  const auto bytes = load_little_endian<std::uint32_t>(block, kBytesAt);
  if (bytes > kBlockPayloadBytes) return;
  store_little_endian(block, kBytesAt + sizeof(bytes), crc32c(block.subspan(kRecordHeaderBytes, bytes)));
}

Bytes make_file(std::string_view rest, const Making& making) {
  Bytes file;
  for (std::size_t i = 0; i < kMaxBlocks && !rest.empty(); ++i) {
    const std::size_t bytes = take_byte(rest);
    const std::string_view taken = rest.substr(0, bytes);
    rest.remove_prefix(taken.size());
    const std::size_t begin = file.size();
    std::transform(taken.begin(), taken.end(), std::back_inserter(file),
                   [](char c) { return static_cast<std::byte>(c); });
    if (rest.empty() && making.ends_early) break;
    file.resize(begin + kBlockBytes);
    const std::span<std::byte> block = std::span(file).subspan(begin, kBlockBytes);
    if (making.seals_payloads) seal_payload(block);
    if (making.seals_blocks) store_little_endian(block, kChecksumAt, crc32c(block.first(kChecksumAt)));
  }
  return file;
}

// Of a head, intact or not. It takes seconds to look through a ring of a gigabyte.
bool is_too_large(const Bytes& file) {
  constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 20;
  for (std::size_t at = 0; at + kBlockBytes <= file.size(); at += kBlockBytes) {
    JournalHead head;
    const ConstBlockBytes block = std::span(file).subspan(at).first<kBlockBytes>();
    if (decode_head(block, head) == HeadState::intact && head.file_bytes > kMaxBytes &&
        head.file_bytes <= kMaxJournalBytes)
      return true;
  }
  return false;
}

std::vector<std::string> payloads_in(Journal& journal) {
  std::vector<std::string> payloads;
  for (std::uint64_t sequence = 0;;) {
    const auto record = journal.next_after(sequence);
    demand(record.ok(), "the disk gives what it has");
    if (!*record) break;
    demand((*record)->sequence > sequence, "records in their order");
    sequence = (*record)->sequence;
    payloads.push_back((*record)->payload);
  }
  demand(payloads.size() == journal.waiting_count(), "what waits is read");
  return payloads;
}

void remove_all(Journal& journal) {
  for (;;) {
    const auto oldest = journal.oldest();
    demand(oldest.ok(), "the oldest record");
    if (!*oldest) break;
    demand(journal.remove_oldest((*oldest)->sequence).ok(), "what was read is removed");
  }
  demand(journal.waiting_count() == 0, "nothing waits");
}

std::unique_ptr<Journal> reopen(RecordedFileSystem& disk, std::uint64_t file_bytes) {
  auto journal = Journal::open(disk, {kPath, file_bytes});
  demand(journal.ok(), "what was opened is opened again");
  return std::move(*journal);
}

// Of a file that the end of its disk's space stopped halfway.
void check_with_room(RecordedFileSystem& disk, std::uint64_t file_bytes, const Bytes& file) {
  constexpr std::uint64_t kRoomBytes = std::uint64_t{1} << 30;
  disk.set_free_bytes(kRoomBytes);
  RecordedFileSystem roomy({{kPath, file}});
  roomy.set_free_bytes(kRoomBytes);
  demand(payloads_in(*reopen(disk, file_bytes)) == payloads_in(*reopen(roomy, file_bytes)),
         "what waited on a full disk still waits");
}

void check_journal(RecordedFileSystem& disk, std::uint64_t file_bytes, const Bytes& file) {
  auto opened = Journal::open(disk, {kPath, file_bytes});
  if (!opened.ok()) {
    demand(!opened.failure().empty(), "a sentence");
    if (disk.image().at(kPath) != file) check_with_room(disk, file_bytes, file);
    return;
  }
  for (const JournalNotice& notice : (*opened)->take_notices()) demand(!notice.text.empty(), "a sentence");
  std::vector<std::string> payloads = payloads_in(**opened);
  const std::string added = "added";
  if ((*opened)->append(added).ok()) payloads.push_back(added);
  opened->reset();
  std::unique_ptr<Journal> journal = reopen(disk, file_bytes);
  demand(payloads_in(*journal) == payloads, "what waited still waits");
  remove_all(*journal);
  journal.reset();
  demand(reopen(disk, file_bytes)->waiting_count() == 0, "what was removed stays away");
}

void check_counter(RecordedFileSystem& disk, std::uint64_t largest_known, const Bytes& file) {
  auto opened = ScanCounter::open(disk, kPath, largest_known);
  if (!opened.ok()) {
    demand(!opened.failure().empty(), "a sentence");
    demand(disk.image().at(kPath) == file, "a file that is refused stays as it was");
    return;
  }
  const Expected<std::uint64_t> first = (*opened)->next();
  if (!first.ok()) return;
  demand(*first > largest_known, "a number that nobody knows");
  opened->reset();
  auto again = ScanCounter::open(disk, kPath, largest_known);
  demand(again.ok() && (*again)->notice().empty(), "what was opened is whole");
  const Expected<std::uint64_t> second = (*again)->next();
  demand(!second.ok() || *second > *first, "no number twice");
}

}  // namespace
}  // namespace traygauge

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace traygauge;
  std::string_view rest = text_of_input(data, size);
  const Making making(take_byte(rest));
  const std::size_t choice = take_byte(rest);
  const Bytes file = make_file(rest, making);
  if (is_too_large(file)) return 0;
  RecordedFileSystem disk({{kPath, file}});
  constexpr std::uint64_t kFreeBytes = std::uint64_t{1} << 20;
  disk.set_free_bytes(kFreeBytes);
  if (making.is_counter) {
    check_counter(disk, choice, file);
  } else {
    check_journal(disk, kMinJournalBytes + choice % 8 * kBlockBytes, file);
  }
  return 0;
}
