// The two kinds of blocks in a journal's file.
//
//   file    head · ring of record blocks · head      (the heads lie apart, so that one bad spot spares the
//   other) record  one block for each 4,048 bytes of payload, neighbours in the ring; the last is padded with
//   zeros
//
// Every block carries a checksum over all of it and the number of its journal, so no payload is taken for a
// block, and no block for one of another journal that lay on the same disk. Numbers are little-endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace traygauge {

inline constexpr std::size_t kBlockBytes = 4096;  // what a disk writes anyway for a byte
inline constexpr std::size_t kRecordHeaderBytes = 44;
inline constexpr std::size_t kChecksumBytes = 4;
inline constexpr std::size_t kBlockPayloadBytes = kBlockBytes - kRecordHeaderBytes - kChecksumBytes;
inline constexpr std::size_t kMaxPayloadBytes = 65536;

// Records are numbered from 1; the number after the last one is still a number.
inline constexpr std::uint64_t kLastSequence = UINT64_MAX - 1;

// Of the whole file.
inline constexpr std::uint64_t kMinJournalBytes = std::uint64_t{32} << 10;
inline constexpr std::uint64_t kMaxJournalBytes = std::uint64_t{1} << 30;

using BlockBytes = std::span<std::byte, kBlockBytes>;
using ConstBlockBytes = std::span<const std::byte, kBlockBytes>;

// Where the oldest waiting record begins. Where none waits: the number and the block of the next one.
struct OldestRecord {
  std::uint64_t sequence = 0;
  std::uint32_t block = 0;  // in the ring, from 0
};

struct BlockHeader {
  std::uint64_t journal_id = 0;
  std::uint64_t sequence = 0;
  OldestRecord oldest;              // when the record was written: removals outlast a power cut this way
  std::uint32_t payload_bytes = 0;  // of the whole record
  std::uint32_t payload_crc = 0;    // tells parts of two attempts at one record apart
  std::uint16_t part = 0;
};

// How many blocks a record takes, at least one.
constexpr std::uint32_t blocks_of(std::size_t payload_bytes) {
  if (payload_bytes == 0) return 1;
  return static_cast<std::uint32_t>((payload_bytes + kBlockPayloadBytes - 1) / kBlockPayloadBytes);
}

// `piece` is the part's share of the payload, at most kBlockPayloadBytes.
void encode_block(const BlockHeader& header, std::span<const std::byte> piece, BlockBytes block);
// None where the block is damaged, of another journal, or none of a record.
std::optional<BlockHeader> decode_block(ConstBlockBytes block, std::uint64_t journal_id);
// The part's share of the payload.
std::span<const std::byte> piece_of(const BlockHeader& header, ConstBlockBytes block);

struct JournalHead {
  std::uint64_t journal_id = 0;
  std::uint64_t file_bytes = 0;
  std::uint64_t generation = 0;  // the head with the greater one is the newer
  OldestRecord oldest;
  std::uint64_t next_sequence = 1;
  std::uint32_t next_block = 0;
};

enum class HeadState { intact, damaged, newer_version, foreign };

void encode_head(const JournalHead& head, BlockBytes block);
// `head` is set where the state is intact.
HeadState decode_head(ConstBlockBytes block, JournalHead& head);

}  // namespace traygauge
