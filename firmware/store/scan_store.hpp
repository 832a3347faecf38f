// Scans on disk: each once, whatever is delivered how often.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/store/database.hpp"
#include "firmware/store/scan_document.hpp"
#include "firmware/store/stored_scan.hpp"

namespace traygauge {

enum class PutOutcome {
  stored,
  already_stored,  // this very document came before
  set_aside,       // unreadable, or another document has its id: kept in a table of its own
};

struct PutResult {
  PutOutcome outcome = PutOutcome::stored;
  std::int64_t seq = 0;  // of the stored scan; 0 where it was set aside
  std::string why;       // where it was set aside
};

struct SetAsideDocument {
  std::int64_t number = 0;
  WallTime received;
  std::string why;
  std::string document;  // any bytes
};

struct ScanCounts {
  std::int64_t scans = 0;
  std::int64_t superseded = 0;
  std::int64_t corrected = 0;
  std::int64_t wrong = 0;
  std::int64_t set_aside = 0;
  std::int64_t document_bytes = 0;  // of the scans

  ScanCounts& operator+=(const ScanCounts& other);
  ScanCounts& operator-=(const ScanCounts& other);
  friend bool operator==(const ScanCounts&, const ScanCounts&) = default;
};

struct StoreTotals {
  ScanCounts counts;
  std::int64_t file_bytes = 0;  // without the journal
  std::int64_t free_bytes = 0;  // of the file, for the next scans
  std::optional<std::int64_t> oldest_received_ms;
  std::optional<std::int64_t> newest_received_ms;
};

class ScanStore {
 public:
  explicit ScanStore(Database& database) : database_(database) {}

  // When it returns a result, whatever its outcome, the document is on disk and a power cut does not take it
  // away. A stored scan waits for each configured destination from the same moment on. The same document may
  // be put again as often as one likes.
  Expected<PutResult> put(std::string_view document, const WallTime& now);
  // Keeps what put() cannot be given, once however often it comes.
  Expected<void> set_aside(std::string_view document, std::string_view why, const WallTime& now);

  // None where there is none. `latest` is the one that arrived last.
  Expected<std::optional<StoredScan>> find(const ScanId& id);
  Expected<std::optional<StoredScan>> latest();

  // Oldest first, with a larger number than `after`.
  Expected<std::vector<SetAsideDocument>> set_aside_documents(std::int64_t after, std::size_t max);
  // For who has looked at it. False where there is none of this number.
  Expected<bool> discard_set_aside(std::int64_t number);

  // Since this was opened: what is written in that time is their cost.
  std::uint64_t new_scans() const { return new_scans_; }
  // The counts come from memory; at first and after a failed change all scans are counted.
  Expected<StoreTotals> totals();
  // Whoever changes scans by other ways has to tell how that ended, and what it changed.
  void note_change(const Expected<void>& done, const ScanCounts& change);

 private:
  Expected<PutResult> put_readable(std::string_view text, const ScanDocument& document, const WallTime& now);
  Expected<PutResult> put_once(std::string_view text, const ScanDocument& document, const WallTime& now,
                               ScanCounts& change);
  Expected<PutResult> compare(std::int64_t seq, std::string_view text, const ScanDocument& document);
  Expected<std::int64_t> insert(std::string_view text, const ScanDocument& document, const WallTime& now);
  Expected<void> book_one(const ScanDocument& document, ScanCounts& change);
  Expected<void> insert_set_aside(std::string_view document, std::string_view why, const WallTime& now,
                                  ScanCounts& change);
  Expected<ScanCounts> count_all();

  Database& database_;
  std::optional<ScanCounts> counts_;
  std::uint64_t new_scans_ = 0;
};

}  // namespace traygauge
