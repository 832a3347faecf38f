// What a station keeps on its own disk: results that wait for the hub, and the number of its next scan.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/journal/journal.hpp"
#include "firmware/journal/scan_counter.hpp"

namespace traygauge {

struct KeptResult {
  std::uint64_t sequence = 0;  // its place in the journal
  std::string id;
  std::string document;
};

// Used by one thread.
class KeptResults {
 public:
  struct Params {
    std::filesystem::path folder;  // exists; nobody else's
    std::string station;
    std::uint64_t journal_bytes = JournalOptions().file_bytes;
  };
  // Its two files in that folder.
  static std::filesystem::path journal_file(const std::filesystem::path& folder) {
    return folder / "waiting";
  }
  static std::filesystem::path counter_file(const std::filesystem::path& folder) {
    return folder / "last_scan";
  }
  static Expected<KeptResults> open(FileSystem& file_system, const Params& params);

  Expected<ScanId> next_id();

  // On disk when this returns.
  Expected<void> keep(std::string_view id, std::string_view document);
  Expected<std::optional<KeptResult>> oldest();
  Expected<void> remove_oldest(const KeptResult& result) { return journal_->remove_oldest(result.sequence); }

  std::size_t waiting_count() const { return journal_->waiting_count(); }
  // Whether the largest result that is ever made fits.
  bool has_room() const { return journal_->has_room(kLargestResultBytes); }
  // What was met since the last call, in sentences.
  std::vector<std::string> take_notices();

 private:
  // A tray with as many items as can be labelled: 198, of some 220 bytes each, 90 checks of 130 bytes, and
  // warnings.
  static constexpr std::size_t kLargestResultBytes = kMaxPayloadBytes;

  KeptResults(std::string station, std::unique_ptr<Journal> journal, std::unique_ptr<ScanCounter> counter)
      : station_(std::move(station)), journal_(std::move(journal)), counter_(std::move(counter)) {}

  std::string station_;
  std::unique_ptr<Journal> journal_;
  std::unique_ptr<ScanCounter> counter_;
  std::vector<std::string> notices_;
};

}  // namespace traygauge
