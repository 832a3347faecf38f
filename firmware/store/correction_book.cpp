#include "firmware/store/correction_book.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "firmware/store/scan_document.hpp"
#include "firmware/store/search_text.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxAuthorBytes = 200;
constexpr std::size_t kMaxReasonBytes = 1000;
constexpr std::size_t kMaxCorrections = 1000;  // of a scan

constexpr const char* kReadingCorrections = "the corrections cannot be read";
constexpr const char* kWritingCorrection = "the correction cannot be stored";

std::string foods_of(const CorrectedScan& scan) {
  std::string foods = "\n";
  for (const CorrectedItem& item : scan.items) {
    if (!item.food.empty()) foods += fold_case(item.food) + "\n";
  }
  return foods;
}

bool holds_wrong(const CorrectedScan& scan) {
  return scan.is_wrong || std::any_of(scan.items.begin(), scan.items.end(),
                                      [](const CorrectedItem& item) { return item.is_wrong; });
}

// By how much a count of what holds changes.
std::int64_t step_between(bool before, bool after) {
  if (before == after) return 0;
  return after ? 1 : -1;
}

std::string refuse_texts(const Correction& correction) {
  if (correction.author.empty() || !is_plain_text(correction.author, kMaxAuthorBytes)) {
    return "The author is plain text of 1 to 200 bytes.";
  }
  if (!is_plain_text(correction.reason, kMaxReasonBytes)) {
    return "The reason is plain text of at most 1000 bytes.";
  }
  return {};
}

}  // namespace

Expected<BookedCorrection> CorrectionBook::add(const ScanId& id, const CorrectionAction& action,
                                               std::string_view author, std::string_view reason,
                                               const WallTime& now) {
  const auto stored = scans_.find(id);
  if (!stored.ok()) return Failure{stored.failure()};
  BookedCorrection booked;
  if (!*stored) {
    booked.refusal = "No scan " + scan_id_text(id) + " is stored.";
    return booked;
  }
  const Expected<ScanDocument> document = read_scan_document((*stored)->document);
  if (!document.ok()) return Failure{scan_id_text(id) + ": " + document.failure()};
  const Correction correction{0, now, std::string(author), std::string(reason), action};
  const Expected<void> done = database_.transaction(kWritingCorrection, [&]() -> Expected<void> {
    Expected<std::string> refusal = add_checked(**stored, *document, correction, booked);
    if (!refusal.ok()) return Failure{refusal.failure()};
    booked.refusal = std::move(*refusal);
    return {};
  });
  ScanCounts change;
  if (booked.refusal.empty()) {
    change.corrected = step_between((*stored)->is_corrected, booked.scan.is_corrected);
    change.wrong = step_between((*stored)->is_wrong, holds_wrong(booked.scan));
  }
  scans_.note_change(done, change);
  if (!done.ok()) return Failure{done.failure()};
  return booked;
}

// Gives the refusal, empty where the correction was written.
Expected<std::string> CorrectionBook::add_checked(const StoredScan& stored, const ScanDocument& document,
                                                  const Correction& correction, BookedCorrection& booked) {
  Expected<std::vector<Correction>> earlier = list(stored.seq);
  if (!earlier.ok()) return Failure{earlier.failure()};
  booked.scan = correct_scan(document.items, *earlier);
  std::string refusal = refuse_texts(correction);
  if (refusal.empty()) refusal = refuse_correction(booked.scan, correction.action);
  if (refusal.empty() && earlier->size() >= kMaxCorrections) {
    refusal = "The scan has 1000 corrections and takes no more.";
  }
  if (!refusal.empty()) return refusal;
  earlier->push_back(correction);
  earlier->back().number = earlier->size() == 1 ? 1 : (earlier->end() - 2)->number + 1;
  booked.number = earlier->back().number;
  booked.scan = correct_scan(document.items, *earlier);
  const Expected<void> written = write(stored.seq, earlier->back(), booked.scan);
  if (!written.ok()) return Failure{written.failure()};
  return std::string();
}

Expected<void> CorrectionBook::write(std::int64_t seq, const Correction& correction,
                                     const CorrectedScan& after) {
  Expected<void> done = database_.execute(
      kWritingCorrection,
      "INSERT INTO corrections (seq, number, made_ms, made_synchronised, author, reason, action)"
      " VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)",
      seq, std::int64_t{correction.number}, correction.made.unix_ms, correction.made.synchronised,
      correction.author, correction.reason, correction_json(correction.action));
  if (!done.ok()) return done;
  done = database_.execute(kWritingCorrection,
                           "UPDATE scans SET foods = ?2, is_corrected = ?3, is_wrong = ?4 WHERE seq = ?1",
                           seq, foods_of(after), after.is_corrected, holds_wrong(after));
  if (!done.ok()) return done;
  return database_.execute(
      kWritingCorrection,
      "INSERT INTO deliveries (destination, place, turn, seq, correction)"
      " SELECT key, newest, 1 + coalesce((SELECT max(turn) FROM deliveries"
      "  WHERE destination = key AND place = newest), 0), ?1, ?2"
      " FROM destinations CROSS JOIN (SELECT max(seq) AS newest FROM scans) WHERE is_configured",
      seq, std::int64_t{correction.number});
}

Expected<std::vector<Correction>> CorrectionBook::list(const ScanId& id) {
  const auto stored = scans_.find(id);
  if (!stored.ok()) return Failure{stored.failure()};
  return *stored ? list((*stored)->seq) : Expected<std::vector<Correction>>(std::vector<Correction>());
}

Expected<std::vector<Correction>> CorrectionBook::list(std::int64_t seq) {
  std::vector<Correction> corrections;
  std::string unreadable;
  const Expected<void> read = database_.each(
      kReadingCorrections,
      "SELECT number, made_ms, made_synchronised, author, reason, action FROM corrections WHERE seq = ?1"
      " ORDER BY number",
      [&](const Statement& row) {
        const Expected<CorrectionAction> action = parse_correction(row.text(5));
        if (!action.ok()) {
          unreadable = action.failure();
          return;
        }
        corrections.push_back({static_cast<int>(row.integer(0)),
                               {row.integer(1), row.integer(2) != 0},
                               row.text(3),
                               row.text(4),
                               *action});
      },
      seq);
  if (!read.ok()) return Failure{read.failure()};
  if (!unreadable.empty()) {
    return Failure{database_.file().string() + ": " + kReadingCorrections + ": " + unreadable};
  }
  return corrections;
}

Expected<std::optional<CorrectedScan>> CorrectionBook::corrected(const ScanId& id) {
  const auto stored = scans_.find(id);
  if (!stored.ok()) return Failure{stored.failure()};
  if (!*stored) return std::optional<CorrectedScan>();
  Expected<CorrectedScan> scan = corrected(**stored);
  if (!scan.ok()) return Failure{scan.failure()};
  return std::optional(std::move(*scan));
}

Expected<CorrectedScan> CorrectionBook::corrected(const StoredScan& stored) {
  const Expected<ScanDocument> document = read_scan_document(stored.document);
  if (!document.ok()) return Failure{scan_id_text(stored.id) + ": " + document.failure()};
  const Expected<std::vector<Correction>> corrections = list(stored.seq);
  if (!corrections.ok()) return Failure{corrections.failure()};
  return correct_scan(document->items, *corrections);
}

}  // namespace traygauge
