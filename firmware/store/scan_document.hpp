// What the store reads of a scan's document. The document itself is kept as it came.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/base/scan_id.hpp"

namespace traygauge {

inline constexpr int kScanDocumentVersion = 2;
inline constexpr std::size_t kMaxScanDocumentBytes = 1'048'576;

struct MeasuredItem {
  int label = 0;  // unlike all others of its scan
  int dish = 0;
  std::string status;
  std::optional<double> volume_ml;  // none where it was not measured
  std::optional<double> sigma_ml;
  std::string food;  // empty where nothing names it
};

struct ScanDocument {
  ScanId id;
  std::int64_t taken_ms = 0;  // UTC, since 1970
  bool clock_synchronised = false;
  std::optional<ScanId> supersedes;  // an earlier scan of the same station
  std::string tray;                  // may be empty
  std::string status;
  std::string message;
  std::vector<MeasuredItem> items;
};

// Fails with a sentence that names key, expected and found. Keys that nobody here knows are passed over.
Expected<ScanDocument> read_scan_document(std::string_view text);

// Whether two documents say the same, however they are written.
bool is_same_document(std::string_view one, std::string_view other);

// UTF-8 without control characters, of at most `max_bytes`: what people may enter as a name or a reason.
bool is_plain_text(std::string_view text, std::size_t max_bytes);

}  // namespace traygauge
