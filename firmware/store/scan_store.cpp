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

Expected<PutResult> ScanStore::put(std::string_view text, const WallTime& now) {
  const Expected<ScanDocument> document = read_scan_document(text);
  if (document.ok()) return put_readable(text, *document, now);
  const Expected<void> kept = set_aside(text, document.failure(), now);
  if (!kept.ok()) return Failure{kept.failure()};
  return PutResult{PutOutcome::set_aside, 0, document.failure()};
}

Expected<PutResult> ScanStore::put_readable(std::string_view text, const ScanDocument& document,
                                            const WallTime& now) {
  const std::string attempted = attempt_to_store(document);
  PutResult result;
  const Expected<void> done = database_.transaction(attempted, [&]() -> Expected<void> {
    const auto there =
        database_.integer(attempted, "SELECT seq FROM scans WHERE station = ?1 AND number = ?2",
                          document.id.station, stored_number(document.id.number));
    if (!there.ok()) return Failure{there.failure()};
    if (*there != 0) {
      const Expected<PutResult> compared = compare(*there, text, document);
      if (!compared.ok()) return Failure{compared.failure()};
      result = *compared;
      return result.outcome == PutOutcome::set_aside ? insert_set_aside(text, result.why, now)
                                                     : Expected<void>();
    }
    const Expected<std::int64_t> seq = insert(text, document, now);
    if (!seq.ok()) return Failure{seq.failure()};
    result.seq = *seq;
    return book_one(document);
  });
  const bool counts_hold = done.ok() && result.outcome != PutOutcome::set_aside && !document.supersedes;
  if (!counts_hold) counts_.reset();
  if (!done.ok()) return Failure{done.failure()};
  if (counts_ && result.outcome == PutOutcome::stored) {
    ++counts_->scans;
    counts_->document_bytes += static_cast<std::int64_t>(text.size());
  }
  return result;
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
      document.id.station, stored_number(document.id.number), document.taken_ms,
      std::int64_t{document.clock_synchronised}, now.unix_ms, std::int64_t{now.synchronised}, document.status,
      supersedes, foods, words_of(document), static_cast<std::int64_t>(text.size()));
  if (!done.ok()) return Failure{done.failure()};
  const std::int64_t seq = database_.last_row();
  done = database_.execute(attempted, "INSERT INTO documents (seq, body) VALUES (?1, ?2)", seq, text);
  if (!done.ok()) return Failure{done.failure()};
  done = database_.execute(attempted,
                           "INSERT INTO deliveries (destination, seq) SELECT key, ?1 FROM destinations"
                           " WHERE is_configured",
                           seq);
  if (!done.ok()) return Failure{done.failure()};
  return seq;
}

// Whichever of the two arrives first.
Expected<void> ScanStore::book_one(const ScanDocument& document) {
  const std::string attempted = attempt_to_store(document);
  const std::int64_t number = stored_number(document.id.number);
  Expected<void> done =
      database_.execute(attempted,
                        "UPDATE scans SET superseded_by = (SELECT max(later.number) FROM scans AS later WHERE"
                        " later.station = ?1 AND later.supersedes = ?2) WHERE station = ?1 AND number = ?2"
                        " AND EXISTS (SELECT 1 FROM scans AS later WHERE later.station = ?1 AND"
                        " later.supersedes = ?2)",
                        document.id.station, number);
  if (database_.changed_rows() > 0) counts_.reset();
  if (!done.ok() || !document.supersedes) return done;
  return database_.execute(attempted,
                           "UPDATE scans SET superseded_by = max(?3, ifnull(superseded_by, ?3))"
                           " WHERE station = ?1 AND number = ?2",
                           document.id.station, stored_number(document.supersedes->number), number);
}

Expected<void> ScanStore::set_aside(std::string_view document, std::string_view why, const WallTime& now) {
  counts_.reset();
  return database_.transaction("a document cannot be set aside",
                               [&] { return insert_set_aside(document, why, now); });
}

Expected<void> ScanStore::insert_set_aside(std::string_view document, std::string_view why,
                                           const WallTime& now) {
  Expected<Statement> insert =
      database_.prepare("a document cannot be set aside",
                        "INSERT INTO set_aside (received_ms, received_synchronised, why, digest, document)"
                        " SELECT ?1, ?2, ?3, ?4, ?5"
                        " WHERE NOT EXISTS (SELECT 1 FROM set_aside WHERE digest = ?4 AND document = ?5)");
  if (!insert.ok()) return Failure{insert.failure()};
  insert->bind(1, now.unix_ms);
  insert->bind(2, std::int64_t{now.synchronised});
  insert->bind(3, why);
  insert->bind(4, digest_of(document));
  insert->bind_bytes(5, document);
  return Database::for_each_row(*insert, [](const Statement&) {});
}

Expected<std::optional<StoredScan>> ScanStore::find(const ScanId& id) {
  static const std::string kSql = std::string("SELECT ") + kStoredScanColumns +
                                  " FROM scans JOIN documents USING (seq) WHERE station = ?1 AND number = ?2";
  std::optional<StoredScan> scan;
  const Expected<void> read = database_.each(
      kReadingScans, kSql.c_str(), [&](const Statement& row) { scan = read_stored_scan(row); }, id.station,
      stored_number(id.number));
  if (!read.ok()) return Failure{read.failure()};
  return scan;
}

Expected<std::optional<StoredScan>> ScanStore::latest() {
  static const std::string kSql = std::string("SELECT ") + kStoredScanColumns +
                                  " FROM scans JOIN documents USING (seq)"
                                  " WHERE scans.seq = (SELECT max(seq) FROM scans)";
  std::optional<StoredScan> scan;
  const Expected<void> read = database_.each(kReadingScans, kSql.c_str(),
                                             [&](const Statement& row) { scan = read_stored_scan(row); });
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
  counts_.reset();
  if (!done.ok()) return Failure{done.failure()};
  return was_there;
}

Expected<StoreTotals> ScanStore::totals() {
  if (!counts_) {
    Counts counts;
    Expected<void> read = database_.each(
        kReadingScans,
        "SELECT count(*), count(superseded_by), total(is_corrected), total(is_wrong), total(document_bytes)"
        " FROM scans",
        [&](const Statement& row) {
          counts = {row.integer(0), row.integer(1), row.integer(2), row.integer(3), 0, row.integer(4)};
        });
    if (!read.ok()) return Failure{read.failure()};
    const auto aside = database_.integer(kReadingScans, "SELECT count(*) FROM set_aside");
    if (!aside.ok()) return Failure{aside.failure()};
    counts.set_aside = *aside;
    counts_ = counts;
  }
  StoreTotals totals;
  totals.scans = counts_->scans;
  totals.superseded = counts_->superseded;
  totals.corrected = counts_->corrected;
  totals.wrong = counts_->wrong;
  totals.set_aside = counts_->set_aside;
  totals.document_bytes = counts_->document_bytes;
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
