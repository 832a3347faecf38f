#include "firmware/store/scan_store.hpp"

#include "firmware/store/search_text.hpp"

namespace traygauge {
namespace {

constexpr const char* kReadingScans = "the scans cannot be read";

std::string attempt_to_store(const ScanDocument& document) {
  return "scan " + scan_id_text(document.id) + " cannot be stored";
}

// FNV-1a: finds documents again, proves nothing.
std::int64_t digest_of(std::string_view bytes) {
  std::uint64_t digest = 0xcbf29ce484222325U;
  for (const char byte : bytes) digest = (digest ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  return static_cast<std::int64_t>(digest);
}

// What a search for text looks into.
std::string words_of(const ScanDocument& document) {
  std::string words = scan_id_text(document.id) + "\n" + document.tray + "\n" + document.message + "\n";
  for (const MeasuredItem& item : document.items) words += item.food + "\n";
  return fold_case(words);
}

}  // namespace

Expected<PutResult> ScanStore::put(std::string_view document, const WallTime& now) {
  const Expected<ScanDocument> read = read_scan_document(document);
  if (read.ok()) return put_readable(document, *read, now);
  const Expected<void> kept = set_aside(document, read.failure(), now);
  if (!kept.ok()) return Failure{kept.failure()};
  return PutResult{PutOutcome::set_aside, 0, read.failure()};
}

Expected<PutResult> ScanStore::put_readable(std::string_view text, const ScanDocument& document,
                                            const WallTime& now) {
  PutResult result;
  ScanCounts change;
  const Expected<void> done = database_.transaction(attempt_to_store(document), [&]() -> Expected<void> {
    const Expected<PutResult> put = put_once(text, document, now, change);
    if (!put.ok()) return Failure{put.failure()};
    result = *put;
    return {};
  });
  note_change(done, change);
  if (!done.ok()) return Failure{done.failure()};
  if (result.outcome == PutOutcome::stored) ++new_scans_;
  return result;
}

Expected<PutResult> ScanStore::put_once(std::string_view text, const ScanDocument& document,
                                        const WallTime& now, ScanCounts& change) {
  const auto there = database_.integer(attempt_to_store(document),
                                       "SELECT seq FROM scans WHERE station = ?1 AND number = ?2",
                                       document.id.station, stored_number(document.id.number));
  if (!there.ok()) return Failure{there.failure()};
  if (*there != 0) {
    Expected<PutResult> compared = compare(*there, text, document);
    if (!compared.ok() || compared->outcome != PutOutcome::set_aside) return compared;
    const Expected<void> kept = insert_set_aside(text, compared->why, now, change);
    return kept.ok() ? compared : Failure{kept.failure()};
  }
  const Expected<std::int64_t> seq = insert(text, document, now);
  if (!seq.ok()) return Failure{seq.failure()};
  change.scans = 1;
  change.document_bytes = static_cast<std::int64_t>(text.size());
  const Expected<void> booked = book_one(document, change);
  if (!booked.ok()) return Failure{booked.failure()};
  return PutResult{PutOutcome::stored, *seq, {}};
}

Expected<PutResult> ScanStore::compare(std::int64_t seq, std::string_view text,
                                       const ScanDocument& document) {
  std::string stored;
  const Expected<void> read = database_.each(
      kReadingScans, "SELECT body FROM documents WHERE seq = ?1",
      [&](const Statement& row) { stored = row.text(0); }, seq);
  if (!read.ok()) return Failure{read.failure()};
  if (is_same_document(stored, text)) return PutResult{PutOutcome::already_stored, seq, {}};
  return PutResult{PutOutcome::set_aside, 0,
                   "another document is stored as scan " + scan_id_text(document.id)};
}

Expected<std::int64_t> ScanStore::insert(std::string_view text, const ScanDocument& document,
                                         const WallTime& now) {
  const std::string attempted = attempt_to_store(document);
  std::string foods = "\n";
  for (const MeasuredItem& item : document.items) {
    if (!item.food.empty()) foods += fold_case(item.food) + "\n";
  }
  std::optional<std::int64_t> supersedes;
  if (document.supersedes) supersedes = stored_number(document.supersedes->number);
  Expected<void> done = database_.execute(
      attempted,
      "INSERT INTO scans (station, number, taken_ms, taken_synchronised, received_ms, received_synchronised,"
      " status, supersedes, foods, words, document_bytes) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, "
      "?11)",
      document.id.station, stored_number(document.id.number), document.taken_ms, document.clock_synchronised,
      now.unix_ms, now.synchronised, document.status, supersedes, foods, words_of(document),
      static_cast<std::int64_t>(text.size()));
  if (!done.ok()) return Failure{done.failure()};
  const std::int64_t seq = database_.last_row();
  done = database_.execute(attempted, "INSERT INTO documents (seq, body) VALUES (?1, ?2)", seq, text);
  if (!done.ok()) return Failure{done.failure()};
  done = database_.execute(
      attempted,
      "INSERT INTO deliveries (destination, place, seq) SELECT key, ?1, ?1 FROM destinations"
      " WHERE is_configured",
      seq);
  if (!done.ok()) return Failure{done.failure()};
  return seq;
}

// Whichever of the two arrives first.
Expected<void> ScanStore::book_one(const ScanDocument& document, ScanCounts& change) {
  const std::string attempted = attempt_to_store(document);
  const std::int64_t number = stored_number(document.id.number);
  Expected<void> done = database_.execute(
      attempted,
      "UPDATE scans SET superseded_by = later.number FROM (SELECT max(number) AS number FROM"
      " scans WHERE station = ?1 AND supersedes = ?2) AS later WHERE station = ?1 AND"
      " scans.number = ?2 AND later.number IS NOT NULL",
      document.id.station, number);
  change.superseded += database_.changed_rows();
  if (!done.ok() || !document.supersedes) return done;
  const std::int64_t earlier = stored_number(document.supersedes->number);
  done = database_.execute(attempted,
                           "UPDATE scans SET superseded_by = max(superseded_by, ?3)"
                           " WHERE station = ?1 AND number = ?2 AND superseded_by IS NOT NULL",
                           document.id.station, earlier, number);
  if (!done.ok()) return done;
  done = database_.execute(attempted,
                           "UPDATE scans SET superseded_by = ?3"
                           " WHERE station = ?1 AND number = ?2 AND superseded_by IS NULL",
                           document.id.station, earlier, number);
  change.superseded += database_.changed_rows();
  return done;
}

Expected<void> ScanStore::set_aside(std::string_view document, std::string_view why, const WallTime& now) {
  ScanCounts change;
  Expected<void> done = database_.transaction("a document cannot be set aside",
                                              [&] { return insert_set_aside(document, why, now, change); });
  note_change(done, change);
  return done;
}

Expected<void> ScanStore::insert_set_aside(std::string_view document, std::string_view why,
                                           const WallTime& now, ScanCounts& change) {
  Expected<Statement> insert =
      database_.prepare("a document cannot be set aside",
                        "INSERT INTO set_aside (received_ms, received_synchronised, why, digest, document)"
                        " SELECT ?1, ?2, ?3, ?4, ?5"
                        " WHERE NOT EXISTS (SELECT 1 FROM set_aside WHERE digest = ?4 AND document = ?5)");
  if (!insert.ok()) return Failure{insert.failure()};
  insert->bind(1, now.unix_ms);
  insert->bind(2, now.synchronised);
  insert->bind(3, why);
  insert->bind(4, digest_of(document));
  insert->bind_bytes(5, document);
  Expected<void> done = Database::for_each_row(*insert, [](const Statement&) {});
  change.set_aside += database_.changed_rows();
  return done;
}

Expected<std::optional<StoredScan>> ScanStore::find(const ScanId& id) {
  static const std::string sql = std::string("SELECT ") + kStoredScanColumns +
                                 " FROM scans JOIN documents USING (seq) WHERE station = ?1 AND number = ?2";
  std::optional<StoredScan> scan;
  const Expected<void> read = database_.each(
      kReadingScans, sql.c_str(), [&](const Statement& row) { scan = read_stored_scan(row); }, id.station,
      stored_number(id.number));
  if (!read.ok()) return Failure{read.failure()};
  return scan;
}

Expected<std::optional<StoredScan>> ScanStore::latest() {
  static const std::string sql = std::string("SELECT ") + kStoredScanColumns +
                                 " FROM scans JOIN documents USING (seq)"
                                 " WHERE scans.seq = (SELECT max(seq) FROM scans)";
  std::optional<StoredScan> scan;
  const Expected<void> read =
      database_.each(kReadingScans, sql.c_str(), [&](const Statement& row) { scan = read_stored_scan(row); });
  if (!read.ok()) return Failure{read.failure()};
  return scan;
}

Expected<std::vector<SetAsideDocument>> ScanStore::set_aside_documents(std::int64_t after, std::size_t max) {
  std::vector<SetAsideDocument> documents;
  const Expected<void> read = database_.each(
      "the documents set aside cannot be read",
      "SELECT number, received_ms, received_synchronised, why, document FROM set_aside WHERE number > ?1"
      " ORDER BY number LIMIT ?2",
      [&](const Statement& row) {
        documents.push_back(
            {row.integer(0), {row.integer(1), row.integer(2) != 0}, row.text(3), row.text(4)});
      },
      after, static_cast<std::int64_t>(max));
  if (!read.ok()) return Failure{read.failure()};
  return documents;
}

Expected<bool> ScanStore::discard_set_aside(std::int64_t number) {
  constexpr const char* kAttempted = "a document set aside cannot be discarded";
  bool was_there = false;
  const Expected<void> done = database_.transaction(kAttempted, [&]() -> Expected<void> {
    Expected<void> deleted = database_.execute(kAttempted, "DELETE FROM set_aside WHERE number = ?1", number);
    was_there = database_.changed_rows() > 0;
    return deleted;
  });
  ScanCounts change;
  change.set_aside = was_there ? -1 : 0;
  note_change(done, change);
  if (!done.ok()) return Failure{done.failure()};
  return was_there;
}

ScanCounts& ScanCounts::operator+=(const ScanCounts& other) {
  scans += other.scans;
  superseded += other.superseded;
  corrected += other.corrected;
  wrong += other.wrong;
  set_aside += other.set_aside;
  document_bytes += other.document_bytes;
  return *this;
}

ScanCounts& ScanCounts::operator-=(const ScanCounts& other) {
  scans -= other.scans;
  superseded -= other.superseded;
  corrected -= other.corrected;
  wrong -= other.wrong;
  set_aside -= other.set_aside;
  document_bytes -= other.document_bytes;
  return *this;
}

// What failed may have been done all the same.
void ScanStore::note_change(const Expected<void>& done, const ScanCounts& change) {
  if (!done.ok()) counts_.reset();
  if (counts_) *counts_ += change;
}

Expected<ScanCounts> ScanStore::count_all() {
  ScanCounts counts;
  const Expected<void> read =
      database_.each(kReadingScans,
                     "SELECT count(*), count(superseded_by), total(is_corrected), total(is_wrong),"
                     " (SELECT count(*) FROM set_aside), total(document_bytes) FROM scans",
                     [&](const Statement& row) {
                       counts = {row.integer(0), row.integer(1), row.integer(2),
                                 row.integer(3), row.integer(4), row.integer(5)};
                     });
  if (!read.ok()) return Failure{read.failure()};
  return counts;
}

Expected<StoreTotals> ScanStore::totals() {
  if (!counts_) {
    const Expected<ScanCounts> counted = count_all();
    if (!counted.ok()) return Failure{counted.failure()};
    counts_ = *counted;
  }
  StoreTotals totals;
  totals.counts = *counts_;
  const Expected<void> read =
      database_.each(kReadingScans,
                     "SELECT page_count * page_size, freelist_count * page_size,"
                     " (SELECT received_ms FROM scans ORDER BY seq LIMIT 1),"
                     " (SELECT received_ms FROM scans ORDER BY seq DESC LIMIT 1)"
                     " FROM pragma_page_count, pragma_page_size, pragma_freelist_count",
                     [&](const Statement& row) {
                       totals.file_bytes = row.integer(0);
                       totals.free_bytes = row.integer(1);
                       totals.oldest_received_ms = row.optional_integer(2);
                       totals.newest_received_ms = row.optional_integer(3);
                     });
  if (!read.ok()) return Failure{read.failure()};
  return totals;
}

}  // namespace traygauge
