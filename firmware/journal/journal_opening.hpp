// From a file on disk, in whatever state, to a journal that can be written.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/journal/file_system.hpp"
#include "firmware/journal/journal_block.hpp"
#include "firmware/journal/journal_notice.hpp"
#include "firmware/journal/journal_ring.hpp"
#include "firmware/journal/ring_scan.hpp"

namespace traygauge {

struct OpenedJournal {
  std::unique_ptr<JournalRing> ring;
  RingContent content;
  JournalHead head;  // the newer one
};

// Makes the file where there is none, keeps damaged records aside and gives the file its configured size.
// Fails on a file that is none of this program's, and leaves it as it is. Adds to `notices`.
Expected<OpenedJournal> open_journal_file(FileSystem& file_system, const std::string& path,
                                          std::uint64_t file_bytes, std::vector<JournalNotice>& notices);

// Keeps the remains in a file beside the journal; a notice says what was lost.
JournalNotice keep_remains(FileSystem& file_system, const std::string& path, JournalRing& ring,
                           JournalNotice::Kind kind, const MissingRecords& remains);

}  // namespace traygauge
