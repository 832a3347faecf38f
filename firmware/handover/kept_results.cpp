#include "firmware/handover/kept_results.hpp"

#include <algorithm>
#include <utility>

namespace traygauge {
namespace {

// A record: the scan's id, a line feed, its document.
KeptResult split(const JournalRecord& record) {
  const std::size_t end = record.payload.find('\n');
  if (end == std::string::npos) return {record.sequence, {}, record.payload};
  return {record.sequence, record.payload.substr(0, end), record.payload.substr(end + 1)};
}

// The counter must not give a number again that waits in the journal, whatever became of its own file.
Expected<std::uint64_t> largest_number(Journal& journal, std::string_view station) {
  std::uint64_t largest = 0;
  for (std::uint64_t after = 0;;) {
    const Expected<std::optional<JournalRecord>> record = journal.next_after(after);
    if (!record.ok()) return Failure{record.failure()};
    if (!*record) return largest;
    after = (*record)->sequence;
    const auto id = parse_scan_id(split(**record).id);
    if (id && id->station == station) largest = std::max(largest, id->number);
  }
}

}  // namespace

Expected<KeptResults> KeptResults::open(FileSystem& file_system, const Params& params) {
  JournalOptions options;
  options.path = journal_file(params.folder);
  options.file_bytes = params.journal_bytes;
  Expected<std::unique_ptr<Journal>> journal = Journal::open(file_system, options);
  if (!journal.ok()) return Failure{journal.failure()};
  const Expected<std::uint64_t> largest = largest_number(**journal, params.station);
  if (!largest.ok()) return Failure{largest.failure()};
  Expected<std::unique_ptr<ScanCounter>> counter =
      ScanCounter::open(file_system, counter_file(params.folder), *largest);
  if (!counter.ok()) return Failure{counter.failure()};
  KeptResults kept(params.station, std::move(*journal), std::move(*counter));
  if (!kept.counter_->notice().empty()) kept.notices_.push_back(kept.counter_->notice());
  return kept;
}

Expected<ScanId> KeptResults::next_id() {
  const Expected<std::uint64_t> number = counter_->next();
  if (!number.ok()) return Failure{number.failure()};
  return ScanId{station_, *number};
}

Expected<void> KeptResults::keep(std::string_view id, std::string_view document) {
  std::string record(id);
  record += '\n';
  record += document;
  const Expected<std::uint64_t> sequence = journal_->append(record);
  if (!sequence.ok()) return Failure{sequence.failure()};
  return {};
}

Expected<std::optional<KeptResult>> KeptResults::oldest() {
  const Expected<std::optional<JournalRecord>> record = journal_->oldest();
  if (!record.ok()) return Failure{record.failure()};
  if (!*record) return std::optional<KeptResult>();
  return std::optional(split(**record));
}

std::vector<std::string> KeptResults::take_notices() {
  for (const JournalNotice& notice : journal_->take_notices()) notices_.push_back(notice.text);
  return std::exchange(notices_, {});
}

}  // namespace traygauge
