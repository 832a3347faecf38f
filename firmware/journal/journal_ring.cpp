#include "firmware/journal/journal_ring.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/crc32c.hpp"

namespace traygauge {
namespace {

BlockBytes block_in(std::span<std::byte> blocks, std::size_t index) {
  return blocks.subspan(index * kBlockBytes).first<kBlockBytes>();
}

ConstBlockBytes block_in(std::span<const std::byte> blocks, std::size_t index) {
  return blocks.subspan(index * kBlockBytes).first<kBlockBytes>();
}

}  // namespace

JournalRing::JournalRing(std::unique_ptr<File> file, std::uint64_t journal_id, std::uint64_t file_bytes)
    : file_(std::move(file)),
      journal_id_(journal_id),
      block_count_(static_cast<std::uint32_t>(file_bytes / kBlockBytes - kHeadsInFile)) {}

std::error_code JournalRing::write_record(const RecordEntry& entry, const OldestRecord& oldest,
                                          std::string_view payload) {
  std::vector<std::byte> blocks(entry.blocks() * kBlockBytes);
  std::span<const std::byte> rest = std::as_bytes(std::span(payload));
  BlockHeader header{journal_id_, entry.sequence, oldest, entry.payload_bytes, entry.payload_crc, 0};
  for (std::uint32_t part = 0; part < entry.blocks(); ++part) {
    header.part = static_cast<std::uint16_t>(part);
    const auto piece = rest.first(std::min(kBlockPayloadBytes, rest.size()));
    encode_block(header, piece, block_in(std::span(blocks), part));
    rest = rest.subspan(piece.size());
  }
  return write_blocks(entry.position, blocks);
}

ReadRecord JournalRing::read_record(const RecordEntry& entry) {
  std::vector<std::byte> blocks(entry.blocks() * kBlockBytes);
  const std::error_code error = read_into(entry.position, blocks);
  if (!error) return {{}, payload_in(entry, blocks)};
  // Many errors of a disk are gone at the second attempt.
  bool unreadable = false;
  auto payload = payload_in(entry, read_blocks(entry.position, entry.blocks(), unreadable));
  if (payload) return {{}, std::move(payload)};
  return {error, std::nullopt};
}

std::optional<std::string> JournalRing::payload_in(const RecordEntry& entry,
                                                   std::span<const std::byte> blocks) const {
  std::string payload;
  payload.reserve(entry.payload_bytes);
  for (std::uint32_t part = 0; part < entry.blocks(); ++part) {
    const ConstBlockBytes block = block_in(blocks, part);
    const auto header = decode_block(block, journal_id_);
    if (!header || header->sequence != entry.sequence || header->part != part ||
        header->payload_bytes != entry.payload_bytes) {
      return std::nullopt;
    }
    for (const std::byte byte : piece_of(*header, block)) payload.push_back(static_cast<char>(byte));
  }
  if (crc32c(std::as_bytes(std::span(payload))) != entry.payload_crc) return std::nullopt;
  return payload;
}

std::error_code JournalRing::erase_block(std::uint64_t position) {
  const std::array<std::byte, kBlockBytes> zeros{};
  return write_blocks(position, zeros);
}

std::error_code JournalRing::write_head(const JournalHead& head) {
  std::array<std::byte, kBlockBytes> block{};
  encode_head(head, block);
  return file_->write_at(head.generation % 2 == 0 ? 0 : file_bytes() - kBlockBytes, block);
}

std::vector<std::byte> JournalRing::read_blocks(std::uint64_t position, std::uint32_t count,
                                                bool& unreadable) {
  std::vector<std::byte> blocks(count * kBlockBytes);
  unreadable = false;
  if (!read_into(position, blocks)) return blocks;
  unreadable = true;  // one bad block is not to take its neighbours along
  for (std::uint32_t i = 0; i < count; ++i) {
    const BlockBytes block = block_in(std::span(blocks), i);
    if (read_into(position + i, block)) std::fill(block.begin(), block.end(), std::byte{0});
  }
  return blocks;
}

std::error_code JournalRing::write_blocks(std::uint64_t position, std::span<const std::byte> blocks) {
  const std::size_t before_end = (block_count_ - block_at(position)) * kBlockBytes;
  const auto first = blocks.first(std::min(before_end, blocks.size()));
  if (const std::error_code error = file_->write_at(offset_of(position), first)) return error;
  const auto second = blocks.subspan(first.size());
  return second.empty() ? std::error_code() : file_->write_at(offset_of(0), second);
}

std::error_code JournalRing::read_into(std::uint64_t position, std::span<std::byte> blocks) {
  const std::size_t before_end = (block_count_ - block_at(position)) * kBlockBytes;
  const auto first = blocks.first(std::min(before_end, blocks.size()));
  std::fill(blocks.begin(), blocks.end(), std::byte{0});  // past the end of a file that was cut
  if (const auto read = file_->read_at(offset_of(position), first); !read.ok()) return read.error;
  const auto second = blocks.subspan(first.size());
  return second.empty() ? std::error_code() : file_->read_at(offset_of(0), second).error;
}

}  // namespace traygauge
