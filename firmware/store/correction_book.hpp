// Corrections on disk: each is added, none is changed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/store/corrected_scan.hpp"
#include "firmware/store/correction.hpp"
#include "firmware/store/database.hpp"
#include "firmware/store/scan_store.hpp"

namespace traygauge {

struct BookedCorrection {
  std::string refusal;  // why nothing was booked, for who asked; empty where it was
  int number = 0;       // of the correction, within its scan
  CorrectedScan scan;   // as it is now
};

class CorrectionBook {
 public:
  CorrectionBook(Database& database, ScanStore& scans) : database_(database), scans_(scans) {}

  // Author and reason are plain text of at most 200 and 1,000 bytes; the reason may be empty.
  Expected<BookedCorrection> add(const ScanId& id, const CorrectionAction& action, std::string_view author,
                                 std::string_view reason, const WallTime& now);
  // All of a scan, oldest first, with those that were undone.
  Expected<std::vector<Correction>> list(const ScanId& id);
  // None where there is no such scan.
  Expected<std::optional<CorrectedScan>> corrected(const ScanId& id);
  // The same two of a scan that was read.
  Expected<std::vector<Correction>> list(const StoredScan& stored) { return list(stored.seq); }
  Expected<CorrectedScan> corrected(const StoredScan& stored);

 private:
  Expected<std::vector<Correction>> list(std::int64_t seq);
  Expected<std::string> add_checked(const StoredScan& stored, const ScanDocument& document,
                                    const Correction& correction, BookedCorrection& booked);
  Expected<void> write(std::int64_t seq, const Correction& correction, const CorrectedScan& after);

  Database& database_;
  ScanStore& scans_;
};

}  // namespace traygauge
