// What the ring of a journal holds, found after any crash.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "firmware/journal/journal_block.hpp"
#include "firmware/journal/journal_ring.hpp"

namespace traygauge {

// Records that once were whole, and the blocks where their remains lie.
struct MissingRecords {
  std::uint64_t first_sequence = 0;
  std::uint64_t last_sequence = 0;
  std::uint64_t position = 0;
  std::uint32_t blocks = 0;
};

struct RingContent {
  std::deque<RecordEntry> records;      // whole, in order
  std::vector<MissingRecords> missing;  // damaged by the medium, because a crash leaves none of these
  // What lies where the next record comes: an append that a power cut interrupted, or the newest record if
  // the medium damaged it since; nobody can tell them apart.
  std::optional<MissingRecords> interrupted;
  std::uint64_t next_sequence = 1;
  std::uint64_t next_position = 0;
};

// `newest_head`: the intact one of the greater generation. Blocks that cannot be read count as damaged.
RingContent scan_ring(JournalRing& ring, const JournalHead& newest_head);

}  // namespace traygauge
