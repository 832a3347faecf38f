#include "firmware/journal/ring_scan.hpp"

#include <algorithm>
#include <span>

namespace traygauge {
namespace {

struct ScannedBlock {
  std::optional<BlockHeader> header;
  bool is_blank = false;  // zeros: never written
};

std::vector<ScannedBlock> scan_blocks(JournalRing& ring) {
  constexpr std::uint32_t kBlocksAtOnce = 16;
  std::vector<ScannedBlock> scanned(ring.block_count());
  for (std::uint32_t begin = 0; begin < ring.block_count(); begin += kBlocksAtOnce) {
    const std::uint32_t count = std::min(kBlocksAtOnce, ring.block_count() - begin);
    bool unreadable = false;
    const std::vector<std::byte> bytes = ring.read_blocks(begin, count, unreadable);
    for (std::uint32_t i = 0; i < count; ++i) {
      const ConstBlockBytes block = std::span(bytes).subspan(i * kBlockBytes).first<kBlockBytes>();
      scanned[begin + i].header = decode_block(block, ring.id());
      scanned[begin + i].is_blank = !unreadable && std::all_of(block.begin(), block.end(),
                                                               [](std::byte b) { return b == std::byte{0}; });
    }
  }
  return scanned;
}

// Every block says which record was the oldest when it was written. Removals only go on, so the greatest
// holds.
OldestRecord latest_oldest(const std::vector<ScannedBlock>& blocks, OldestRecord oldest) {
  for (const ScannedBlock& block : blocks) {
    if (block.header && block.header->oldest.sequence > oldest.sequence &&
        block.header->oldest.block < blocks.size()) {
      oldest = block.header->oldest;
    }
  }
  return oldest;
}

class RingWalk {
 public:
  RingWalk(const std::vector<ScannedBlock>& blocks, const OldestRecord& oldest)
      : blocks_(blocks), begin_(oldest.block) {
    content_.next_sequence = oldest.sequence;
    content_.next_position = oldest.block;
  }

  RingContent walk(const JournalHead& head) {
    for (std::uint64_t position = begin_; position < end();) {
      const auto entry = record_at(position);
      if (entry && entry->sequence >= content_.next_sequence) {
        add_missing(entry->sequence, position);
        content_.records.push_back(*entry);
        content_.next_sequence = entry->sequence + 1;
        position += entry->blocks();
        content_.next_position = position;
      } else {
        ++position;  // free, or a record that was removed, or damaged
      }
    }
    if (head.next_sequence > content_.next_sequence) add_missing_at_end(head);
    find_interrupted();
    return std::move(content_);
  }

 private:
  std::uint64_t end() const { return begin_ + blocks_.size(); }
  const ScannedBlock& block_at(std::uint64_t position) const { return blocks_[position % blocks_.size()]; }

  // Where all parts of a whole record begin at `position`.
  std::optional<RecordEntry> record_at(std::uint64_t position) const {
    const auto& first = block_at(position).header;
    if (!first || first->part != 0) return std::nullopt;
    const std::uint32_t count = blocks_of(first->payload_bytes);
    if (count > end() - position) return std::nullopt;
    for (std::uint32_t part = 1; part < count; ++part) {
      const auto& other = block_at(position + part).header;
      if (!other || other->part != part || other->sequence != first->sequence ||
          other->payload_bytes != first->payload_bytes || other->payload_crc != first->payload_crc) {
        return std::nullopt;
      }
    }
    return RecordEntry{first->sequence, position, first->payload_bytes, first->payload_crc};
  }

  // A record is written only after the one before it is durable: a number that is passed over is a loss.
  void add_missing(std::uint64_t sequence, std::uint64_t position) {
    if (sequence == content_.next_sequence) return;
    content_.missing.push_back({content_.next_sequence, sequence - 1, content_.next_position,
                                static_cast<std::uint32_t>(position - content_.next_position)});
  }

  void add_missing_at_end(const JournalHead& head) {
    const std::uint64_t size = blocks_.size();
    std::uint64_t blocks = (head.next_block + size - content_.next_position % size) % size;
    if (blocks == 0) blocks = size;  // every record takes room: they filled the ring
    const std::uint64_t position = std::min(content_.next_position + blocks, end());
    add_missing(head.next_sequence, position);
    content_.next_sequence = head.next_sequence;
    content_.next_position = position;
  }

  void find_interrupted() {
    const std::uint64_t position = content_.next_position;
    if (position == end()) return;
    const ScannedBlock& block = block_at(position);
    if (block.is_blank) return;
    std::uint64_t blocks = 1;
    if (block.header) {
      if (block.header->sequence != content_.next_sequence || block.header->part != 0) return;
      blocks = std::min<std::uint64_t>(blocks_of(block.header->payload_bytes), end() - position);
    }
    content_.interrupted = MissingRecords{content_.next_sequence, content_.next_sequence, position,
                                          static_cast<std::uint32_t>(blocks)};
  }

  const std::vector<ScannedBlock>& blocks_;
  std::uint64_t begin_ = 0;
  RingContent content_;
};

}  // namespace

RingContent scan_ring(JournalRing& ring, const JournalHead& newest_head) {
  const std::vector<ScannedBlock> blocks = scan_blocks(ring);
  return RingWalk(blocks, latest_oldest(blocks, newest_head.oldest)).walk(newest_head);
}

}  // namespace traygauge
