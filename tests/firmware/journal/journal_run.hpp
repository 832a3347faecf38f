// A journal and a counter of scans in use, at random, and what must be found of it after a crash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "firmware/journal/journal.hpp"
#include "firmware/journal/scan_counter.hpp"
#include "tests/support/recorded_file_system.hpp"

namespace traygauge::test {

// Times are counts of operations that the disk had recorded. A cut at a moment comes after what ended by
// then.
struct AppendedRecord {
  std::string payload;
  std::size_t begun_at = 0;
  std::optional<std::size_t> stored_at;   // none where the append failed
  std::optional<std::size_t> removed_at;  // it may be found later, too
};

struct GivenNumber {
  std::uint64_t number = 0;
  std::size_t given_at = 0;
};

struct RunHistory {
  std::vector<AppendedRecord> records;  // in order of their appends
  std::vector<GivenNumber> numbers;
  // After a sync that failed the kernel shows an append as whole that is not on the disk, and that nobody was
  // promised; a restart believes in it, and a power cut then shows a gap.
  bool has_failed_sync = false;
};

class JournalRun {
 public:
  // Goes on with what `disk` holds; `history` says what that is.
  JournalRun(RecordedFileSystem& disk, std::mt19937& random, RunHistory history = {});

  // Appends, removals, restarts with and without kill -9, other sizes. Failures of the disk are met and
  // passed.
  void take_steps(std::size_t count);
  void stop() { close(false); }
  void kill() { close(true); }
  const RunHistory& history() const { return history_; }
  std::size_t acknowledged_count() const;

 private:
  void take_step();
  void append();
  void remove();
  void count_scan();
  void open();
  void close(bool by_kill);
  void note_failed_syncs();
  std::string make_payload();
  std::size_t below(std::size_t end);

  RecordedFileSystem& disk_;
  std::mt19937& random_;
  RunHistory history_;
  std::unique_ptr<Journal> journal_;
  std::unique_ptr<ScanCounter> counter_;
  std::uint64_t file_bytes_ = 0;
};

// What a journal on this disk holds; a failure of the test where it cannot be opened or tells of damage.
std::vector<std::string> read_all(Journal& journal);

// Opens what a cut at `moment` left: each record that was stored and not removed by then is found exactly
// once, in order; nothing is found that was never appended; no number that was given is given again; no
// damage is told on a disk on which no sync failed. Returns what waits, for going on from there.
RunHistory check_after_cut(RecordedFileSystem& disk, const RunHistory& history, std::size_t moment);

}  // namespace traygauge::test
