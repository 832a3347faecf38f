#include "firmware/journal/journal.hpp"

#include <algorithm>
#include <span>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/base/crc32c.hpp"
#include "firmware/journal/io_failure.hpp"
#include "firmware/journal/journal_block.hpp"
#include "firmware/journal/lock_file.hpp"

namespace traygauge {

Expected<std::unique_ptr<Journal>> Journal::open(FileSystem& file_system, const JournalOptions& options) {
  if (options.file_bytes < kMinJournalBytes || options.file_bytes > kMaxJournalBytes) {
    return Failure{options.path + ": a journal has " + std::to_string(kMinJournalBytes) + " to " +
                   std::to_string(kMaxJournalBytes) + " bytes, not " + std::to_string(options.file_bytes) +
                   "."};
  }
  auto lock = lock_file(file_system, options.path);
  if (!lock.ok()) return Failure{lock.failure()};
  std::vector<JournalNotice> notices;
  auto opened =
      open_journal_file(file_system, options.path, options.file_bytes / kBlockBytes * kBlockBytes, notices);
  if (!opened.ok()) return Failure{opened.failure()};
  const JournalHead found = opened->head;
  std::unique_ptr<Journal> journal(
      new Journal(file_system, options.path, std::move(*lock), std::move(*opened), std::move(notices)));
  if (const std::error_code error = journal->make_found_durable(found)) {
    return io_failure(options.path, "the journal could not be written", error);
  }
  return journal;
}

std::error_code Journal::make_found_durable(const JournalHead& found) {
  // The newer head may be in the kernel's memory alone, if a sync failed: it is written anew before the other
  // one, which may be the only one on the disk.
  if (const std::error_code error = ring_->write_head(found)) return error;
  // So may the newest record, if the program was killed in its append: it has to be durable before a head
  // speaks of it.
  if (const std::error_code error = ring_->sync()) return error;
  return make_removals_durable();
}

Journal::Journal(FileSystem& file_system, std::string path, std::unique_ptr<File> lock, OpenedJournal opened,
                 std::vector<JournalNotice> notices)
    : file_system_(file_system),
      path_(std::move(path)),
      lock_(std::move(lock)),
      ring_(std::move(opened.ring)),
      waiting_(std::move(opened.content.records)),
      next_sequence_(opened.content.next_sequence),
      next_position_(opened.content.next_position),
      generation_(opened.head.generation),
      notices_(std::move(notices)) {
  for (const RecordEntry& entry : waiting_) waiting_bytes_ += entry.payload_bytes;
  protected_from_ = waiting_from();
}

Journal::~Journal() {
  if (!is_head_current_) std::ignore = make_removals_durable();
}

std::uint64_t Journal::waiting_from() const {
  return waiting_.empty() ? next_position_ : waiting_.front().position;
}

OldestRecord Journal::oldest_place() const {
  return {waiting_.empty() ? next_sequence_ : waiting_.front().sequence, ring_->block_at(waiting_from())};
}

std::error_code Journal::make_removals_durable() {
  const JournalHead head{ring_->id(),    ring_->file_bytes(), generation_ + 1,
                         oldest_place(), next_sequence_,      ring_->block_at(next_position_)};
  if (const std::error_code error = ring_->write_head(head)) return error;
  if (const std::error_code error = ring_->sync()) return error;
  // Only now: the other head must not be written before this one is durable.
  ++generation_;
  protected_from_ = waiting_from();
  is_head_current_ = true;
  return {};
}

Expected<std::uint64_t> Journal::append(std::string_view payload) {
  if (!has_room(payload.size())) return no_room(payload.size());
  const RecordEntry entry{next_sequence_, next_position_, static_cast<std::uint32_t>(payload.size()),
                          crc32c(std::as_bytes(std::span(payload)))};
  if (const std::error_code error = write(entry, payload)) {
    return io_failure(path_, "the result could not be stored in the journal", error);
  }
  waiting_.push_back(entry);
  waiting_bytes_ += entry.payload_bytes;
  ++next_sequence_;
  next_position_ += entry.blocks();
  return entry.sequence;
}

std::error_code Journal::write(const RecordEntry& entry, std::string_view payload) {
  if (entry.blocks() > ring_->block_count() - (next_position_ - protected_from_)) {
    if (const std::error_code error = make_removals_durable()) return error;
  }
  const OldestRecord oldest = oldest_place();
  const std::uint64_t oldest_position = waiting_from();
  is_head_current_ = false;
  std::error_code error = ring_->write_record(entry, oldest, payload);
  if (!error) error = ring_->sync();
  if (error) {
    // The next start is not to find what was refused; after a power cut it still may.
    std::ignore = ring_->erase_block(entry.position);
    return error;
  }
  protected_from_ = oldest_position;
  return {};
}

std::uint64_t Journal::free_blocks() const {
  return ring_->block_count() - (next_position_ - waiting_from());
}

bool Journal::has_room(std::size_t payload_bytes) const {
  return payload_bytes <= kMaxPayloadBytes && blocks_of(payload_bytes) <= free_blocks() &&
         next_sequence_ <= kLastSequence;
}

Failure Journal::no_room(std::size_t payload_bytes) const {
  const std::size_t most = std::min<std::size_t>(kMaxPayloadBytes, ring_->block_count() * kBlockPayloadBytes);
  if (payload_bytes > most) {
    return {path_ + ": a result of " + std::to_string(payload_bytes) +
            " bytes is too large for this journal, which takes up to " + std::to_string(most) + "."};
  }
  return {path_ + ": the journal is full: " + std::to_string(waiting_.size()) +
          " results wait for the hub. Start the hub, or give the journal more room."};
}

Expected<std::optional<JournalRecord>> Journal::next_after(std::uint64_t sequence) {
  for (;;) {
    const auto entry = std::upper_bound(
        waiting_.begin(), waiting_.end(), sequence,
        [](std::uint64_t number, const RecordEntry& record) { return number < record.sequence; });
    if (entry == waiting_.end()) return std::optional<JournalRecord>();
    ReadRecord read = ring_->read_record(*entry);
    if (read.payload) return std::optional(JournalRecord{entry->sequence, *std::move(read.payload)});
    JournalNotice notice = keep_remains(file_system_, path_, *ring_, JournalNotice::Kind::damaged,
                                        {entry->sequence, entry->sequence, entry->position, entry->blocks()});
    // A disk that can write what is left of the record has lost the record; any other may come back.
    if (read.error && notice.kept_in.empty()) {
      return io_failure(path_, "a result could not be read from the journal", read.error);
    }
    notices_.push_back(std::move(notice));
    forget(entry);
  }
}

Expected<void> Journal::remove_oldest(std::uint64_t sequence) {
  const std::uint64_t oldest = oldest_place().sequence;
  if (sequence < oldest) return {};
  if (waiting_.empty() || sequence > oldest) {
    return Failure{path_ + ": record " + std::to_string(sequence) + " is not the oldest one, which is " +
                   std::to_string(oldest) + "; nothing was removed."};
  }
  forget(waiting_.begin());
  return {};
}

void Journal::forget(const std::deque<RecordEntry>::iterator& entry) {
  waiting_bytes_ -= entry->payload_bytes;
  waiting_.erase(entry);
  is_head_current_ = false;
}

std::vector<JournalNotice> Journal::take_notices() {
  return std::exchange(notices_, {});
}

}  // namespace traygauge
