#include "firmware/journal/journal_block.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/base/crc32c.hpp"
#include "core/base/little_endian.hpp"

namespace traygauge {
namespace {

constexpr std::uint32_t kBlockMagic = 0x4b424a54;         // "TJBK"
constexpr std::uint64_t kHeadMagic = 0x4c4e524a59415254;  // "TRAYJRNL"
constexpr std::uint32_t kVersion = 1;
constexpr std::uint16_t kBlockVersion = kVersion;

// Offsets in a record's block.
constexpr std::size_t kMagicAt = 0;
constexpr std::size_t kPartAt = 4;
constexpr std::size_t kVersionAt = 6;
constexpr std::size_t kIdAt = 8;
constexpr std::size_t kSequenceAt = 16;
constexpr std::size_t kOldestAt = 24;
constexpr std::size_t kOldestBlockAt = 32;
constexpr std::size_t kPayloadBytesAt = 36;
constexpr std::size_t kPayloadCrcAt = 40;
static_assert(kPayloadCrcAt + sizeof(std::uint32_t) == kRecordHeaderBytes);

// Offsets in a head.
constexpr std::size_t kHeadVersionAt = 8;
constexpr std::size_t kHeadIdAt = 16;
constexpr std::size_t kHeadFileBytesAt = 24;
constexpr std::size_t kHeadGenerationAt = 32;
constexpr std::size_t kHeadOldestAt = 40;
constexpr std::size_t kHeadNextAt = 48;
constexpr std::size_t kHeadOldestBlockAt = 56;
constexpr std::size_t kHeadNextBlockAt = 60;

constexpr std::size_t kChecksumAt = kBlockBytes - kChecksumBytes;

void seal(BlockBytes block) {
  store_little_endian(block, kChecksumAt, crc32c(block.first(kChecksumAt)));
}

bool is_sealed(ConstBlockBytes block) {
  return load_little_endian<std::uint32_t>(block, kChecksumAt) == crc32c(block.first(kChecksumAt));
}

std::size_t piece_bytes(const BlockHeader& header) {
  const std::size_t before = std::size_t{header.part} * kBlockPayloadBytes;
  return std::min(kBlockPayloadBytes,
                  header.payload_bytes - std::min<std::size_t>(before, header.payload_bytes));
}

}  // namespace

void encode_block(const BlockHeader& header, std::span<const std::byte> piece, BlockBytes block) {
  assert(piece.size() == piece_bytes(header));
  std::fill(block.begin(), block.end(), std::byte{0});
  store_little_endian(block, kMagicAt, kBlockMagic);
  store_little_endian(block, kPartAt, header.part);
  store_little_endian(block, kVersionAt, kBlockVersion);
  store_little_endian(block, kIdAt, header.journal_id);
  store_little_endian(block, kSequenceAt, header.sequence);
  store_little_endian(block, kOldestAt, header.oldest.sequence);
  store_little_endian(block, kOldestBlockAt, header.oldest.block);
  store_little_endian(block, kPayloadBytesAt, header.payload_bytes);
  store_little_endian(block, kPayloadCrcAt, header.payload_crc);
  std::copy(piece.begin(), piece.end(), block.begin() + kRecordHeaderBytes);
  seal(block);
}

std::optional<BlockHeader> decode_block(ConstBlockBytes block, std::uint64_t journal_id) {
  if (load_little_endian<std::uint32_t>(block, kMagicAt) != kBlockMagic ||
      load_little_endian<std::uint16_t>(block, kVersionAt) != kBlockVersion ||
      load_little_endian<std::uint64_t>(block, kIdAt) != journal_id || !is_sealed(block)) {
    return std::nullopt;
  }
  BlockHeader header;
  header.journal_id = journal_id;
  header.sequence = load_little_endian<std::uint64_t>(block, kSequenceAt);
  header.oldest = {load_little_endian<std::uint64_t>(block, kOldestAt),
                   load_little_endian<std::uint32_t>(block, kOldestBlockAt)};
  header.payload_bytes = load_little_endian<std::uint32_t>(block, kPayloadBytesAt);
  header.payload_crc = load_little_endian<std::uint32_t>(block, kPayloadCrcAt);
  header.part = load_little_endian<std::uint16_t>(block, kPartAt);
  if (header.sequence == 0 || header.sequence > kLastSequence || header.payload_bytes > kMaxPayloadBytes ||
      header.part >= blocks_of(header.payload_bytes)) {
    return std::nullopt;
  }
  return header;
}

std::span<const std::byte> piece_of(const BlockHeader& header, ConstBlockBytes block) {
  return block.subspan(kRecordHeaderBytes, piece_bytes(header));
}

void encode_head(const JournalHead& head, BlockBytes block) {
  std::fill(block.begin(), block.end(), std::byte{0});
  store_little_endian(block, kMagicAt, kHeadMagic);
  store_little_endian(block, kHeadVersionAt, kVersion);
  store_little_endian(block, kHeadIdAt, head.journal_id);
  store_little_endian(block, kHeadFileBytesAt, head.file_bytes);
  store_little_endian(block, kHeadGenerationAt, head.generation);
  store_little_endian(block, kHeadOldestAt, head.oldest.sequence);
  store_little_endian(block, kHeadNextAt, head.next_sequence);
  store_little_endian(block, kHeadOldestBlockAt, head.oldest.block);
  store_little_endian(block, kHeadNextBlockAt, head.next_block);
  seal(block);
}

HeadState decode_head(ConstBlockBytes block, JournalHead& head) {
  if (load_little_endian<std::uint64_t>(block, kMagicAt) != kHeadMagic) return HeadState::foreign;
  // Later versions keep magic and version where they are, so that this one can say what it met.
  if (load_little_endian<std::uint32_t>(block, kHeadVersionAt) > kVersion) return HeadState::newer_version;
  if (!is_sealed(block)) return HeadState::damaged;
  head.journal_id = load_little_endian<std::uint64_t>(block, kHeadIdAt);
  head.file_bytes = load_little_endian<std::uint64_t>(block, kHeadFileBytesAt);
  head.generation = load_little_endian<std::uint64_t>(block, kHeadGenerationAt);
  head.oldest = {load_little_endian<std::uint64_t>(block, kHeadOldestAt),
                 load_little_endian<std::uint32_t>(block, kHeadOldestBlockAt)};
  head.next_sequence = load_little_endian<std::uint64_t>(block, kHeadNextAt);
  head.next_block = load_little_endian<std::uint32_t>(block, kHeadNextBlockAt);
  return HeadState::intact;
}

}  // namespace traygauge
