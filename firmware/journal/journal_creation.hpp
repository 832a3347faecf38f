// A new journal's file, empty or with the records of another one.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/journal/file_system.hpp"
#include "firmware/journal/journal_ring.hpp"

namespace traygauge {

struct NewJournal {
  std::uint64_t file_bytes = 0;
  std::uint64_t next_sequence = 1;
  std::vector<RecordEntry> records;  // in order; sequences are kept, positions are given anew
  std::function<Expected<std::string>(const RecordEntry&)> read_payload;
};

// Where a new file is written before it takes its name.
std::string unfinished_path(const std::string& path);

// Writes every block once, so that a full disk strikes here and not at an append, then replaces what has the
// name. The content is durable, the name only after sync_folder_of(). After a failure the old file is as it
// was.
Expected<void> create_journal(FileSystem& file_system, const std::string& path, const NewJournal& journal);

}  // namespace traygauge
