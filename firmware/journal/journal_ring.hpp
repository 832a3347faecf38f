// The blocks of a journal's file: reads and writes records and heads, knows nothing of what waits.
//
// A position counts blocks and only grows; the block that it names is its remainder by the ring's size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "firmware/journal/file_system.hpp"
#include "firmware/journal/journal_block.hpp"

namespace traygauge {

struct RecordEntry {
  std::uint64_t sequence = 0;
  std::uint64_t position = 0;
  std::uint32_t payload_bytes = 0;
  std::uint32_t payload_crc = 0;

  std::uint32_t blocks() const { return blocks_of(payload_bytes); }
};

struct ReadRecord {
  std::error_code error;               // the disk refused to read, twice
  std::optional<std::string> payload;  // none where the record is damaged
};

inline constexpr std::uint64_t kHeadsInFile = 2;

class JournalRing {
 public:
  // `file_bytes`: whole blocks, more than kHeadsInFile.
  JournalRing(std::unique_ptr<File> file, std::uint64_t journal_id, std::uint64_t file_bytes);

  std::uint64_t id() const { return journal_id_; }
  std::uint64_t file_bytes() const { return (block_count_ + kHeadsInFile) * kBlockBytes; }
  std::uint32_t block_count() const { return block_count_; }
  std::uint32_t block_at(std::uint64_t position) const {
    return static_cast<std::uint32_t>(position % block_count_);
  }

  // Not durable before sync(). The entry's checksum is that of the payload.
  [[nodiscard]] std::error_code write_record(const RecordEntry& entry, const OldestRecord& oldest,
                                             std::string_view payload);
  ReadRecord read_record(const RecordEntry& entry);
  // After a failed write: the attempt is not to be taken for a record.
  [[nodiscard]] std::error_code erase_block(std::uint64_t position);

  // Of generation g: the first head where g is even, else the last.
  [[nodiscard]] std::error_code write_head(const JournalHead& head);
  [[nodiscard]] std::error_code sync() { return file_->sync_data(); }

  // As they lie in the ring. A block that cannot be read is zeros; `unreadable` says that there was one.
  std::vector<std::byte> read_blocks(std::uint64_t position, std::uint32_t count, bool& unreadable);

 private:
  std::uint64_t offset_of(std::uint64_t position) const { return (1 + block_at(position)) * kBlockBytes; }
  std::optional<std::string> payload_in(const RecordEntry& entry, std::span<const std::byte> blocks) const;
  // In one go, or two where they pass the ring's end.
  std::error_code write_blocks(std::uint64_t position, std::span<const std::byte> blocks);
  std::error_code read_into(std::uint64_t position, std::span<std::byte> blocks);

  std::unique_ptr<File> file_;
  std::uint64_t journal_id_ = 0;
  std::uint32_t block_count_ = 0;
};

}  // namespace traygauge
