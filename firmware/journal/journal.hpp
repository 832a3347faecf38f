// The bounded journal in which a station's results wait until the hub has stored them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/journal/file_system.hpp"
#include "firmware/journal/journal_block.hpp"
#include "firmware/journal/journal_notice.hpp"
#include "firmware/journal/journal_opening.hpp"
#include "firmware/journal/journal_ring.hpp"

namespace traygauge {

struct JournalOptions {
  std::string path;
  // Of the file, two blocks of 4,096 bytes for heads included; from kMinJournalBytes to kMaxJournalBytes, cut
  // to whole blocks. A record takes a block for each 4,048 bytes: 16 MiB hold some 4,000 results.
  std::uint64_t file_bytes = std::uint64_t{16} << 20;
};

struct JournalRecord {
  std::uint64_t sequence = 0;
  std::string payload;
};

// For one thread. Records have consecutive numbers from 1, which go on over restarts.
//
// An append is written and synced in blocks that no waiting record has, and that none will claim after a
// power cut. So a crash at any moment leaves every record whose append returned; one whose append failed or
// did not return may be found, too. A removal becomes durable with the next append, and a record may come
// back before: the hub knows its id and drops it.
class Journal {
 public:
  // Makes, repairs, and resizes the file; take_notices() says what was met. Fails where another process has
  // the journal open, the disk refuses, or the file is not this program's.
  static Expected<std::unique_ptr<Journal>> open(FileSystem& file_system, const JournalOptions& options);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();  // makes removals durable; without it nothing is lost

  // Returns the record's number once it is durable: blocks of 4,096 bytes and one sync; a second sync and
  // block only where the ring was full and no append followed. Fails where there is no room (see has_room())
  // or the disk refuses; the journal is then as before, and the next append may succeed.
  Expected<std::uint64_t> append(std::string_view payload);
  // Whether a payload of so many bytes fits now.
  bool has_room(std::size_t payload_bytes) const;

  // None where nothing waits. A record that the medium damaged since is kept aside, told and passed over.
  // Fails where the disk refuses; nothing has changed then.
  Expected<std::optional<JournalRecord>> oldest() { return next_after(0); }
  // The first record with a greater number, for reading on without removing.
  Expected<std::optional<JournalRecord>> next_after(std::uint64_t sequence);
  // After the hub confirmed: no disk access. A number below the oldest one is no error. Fails for any other
  // number than the oldest one.
  Expected<void> remove_oldest(std::uint64_t sequence);

  std::size_t waiting_count() const { return waiting_.size(); }
  std::uint64_t waiting_bytes() const { return waiting_bytes_; }  // of payload
  std::uint64_t free_blocks() const;                              // of kBlockPayloadBytes
  std::uint64_t file_bytes() const { return ring_->file_bytes(); }
  std::uint64_t next_sequence() const { return next_sequence_; }

  // Since the last call.
  std::vector<JournalNotice> take_notices();

 private:
  Journal(FileSystem& file_system, std::string path, std::unique_ptr<File> lock, OpenedJournal opened,
          std::vector<JournalNotice> notices);

  std::uint64_t waiting_from() const;  // position
  OldestRecord oldest_place() const;
  std::error_code make_found_durable(const JournalHead& found);
  std::error_code make_removals_durable();
  std::error_code write(const RecordEntry& entry, std::string_view payload);
  Failure no_room(std::size_t payload_bytes) const;
  void forget(const std::deque<RecordEntry>::iterator& entry);

  FileSystem& file_system_;
  std::string path_;
  std::unique_ptr<File> lock_;
  std::unique_ptr<JournalRing> ring_;
  std::deque<RecordEntry> waiting_;
  std::uint64_t waiting_bytes_ = 0;
  std::uint64_t next_sequence_ = 1;
  std::uint64_t next_position_ = 0;
  // After a power cut records from here on count as waiting: no append may touch them.
  std::uint64_t protected_from_ = 0;
  std::uint64_t generation_ = 0;
  bool is_head_current_ = false;
  std::vector<JournalNotice> notices_;
};

}  // namespace traygauge
