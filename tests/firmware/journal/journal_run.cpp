#include "tests/firmware/journal/journal_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

namespace traygauge::test {
namespace {

constexpr const char* kJournalPath = "state/results.journal";
constexpr const char* kCounterPath = "counter/scans.counter";
constexpr auto kFileBytes = std::to_array<std::uint64_t>({32768, 36864, 49152, 65536});

bool is_damage(const JournalNotice& notice) {
  return notice.kind == JournalNotice::Kind::damaged || notice.kind == JournalNotice::Kind::cut_off;
}

// Ends in a text that tells it from every other one.
std::string filled_payload(std::size_t bytes, std::uint32_t seed) {
  std::string payload(bytes, ' ');
  std::minstd_rand filler(seed + 1);
  for (char& character : payload) character = static_cast<char>(filler());
  return payload + "#" + std::to_string(seed);
}

void expect_in_history(const std::vector<std::string>& found, const RunHistory& history, std::size_t moment) {
  std::size_t next = 0;  // in `found`
  for (const AppendedRecord& record : history.records) {
    const bool is_found = next < found.size() && found[next] == record.payload;
    if (is_found) ++next;
    const bool was_stored = record.stored_at && *record.stored_at <= moment;
    const bool was_removed = record.removed_at && *record.removed_at <= moment;
    if (!is_found) {
      EXPECT_FALSE(was_stored && !was_removed) << "lost: " << record.payload.size() << " bytes";
    } else {
      EXPECT_LE(record.begun_at, moment) << "found before its append";
    }
  }
  EXPECT_EQ(next, found.size()) << "found twice, out of order, or never appended";
}

}  // namespace

std::vector<std::string> read_all(Journal& journal) {
  std::vector<std::string> found;
  std::uint64_t sequence = 0;
  for (;;) {
    auto record = journal.next_after(sequence);
    if (!record.ok()) {
      ADD_FAILURE() << record.failure();
      return found;
    }
    if (!record->has_value()) break;
    EXPECT_GT((*record)->sequence, sequence);
    sequence = (*record)->sequence;
    found.push_back((*record)->payload);
  }
  EXPECT_EQ(found.size(), journal.waiting_count());
  EXPECT_LT(sequence, journal.next_sequence());
  return found;
}

RunHistory check_after_cut(RecordedFileSystem& disk, const RunHistory& history, std::size_t moment) {
  RunHistory left;
  left.has_failed_sync = history.has_failed_sync;
  auto journal = Journal::open(disk, {kJournalPath, kFileBytes.back()});
  if (!journal.ok()) {
    ADD_FAILURE() << journal.failure();
    return left;
  }
  const std::vector<std::string> found = read_all(**journal);
  for (const JournalNotice& notice : (*journal)->take_notices()) {
    EXPECT_TRUE(history.has_failed_sync || !is_damage(notice)) << notice.text;
  }
  expect_in_history(found, history, moment);
  for (const std::string& payload : found) left.records.push_back({payload, 0, 0, std::nullopt});

  auto counter = ScanCounter::open(disk, kCounterPath, 0);
  if (!counter.ok()) {
    ADD_FAILURE() << counter.failure();
    return left;
  }
  EXPECT_EQ((*counter)->notice().find("million"), std::string::npos)
      << "both blocks of the counter were lost";
  const auto number = (*counter)->next();
  EXPECT_TRUE(number.ok());
  for (const GivenNumber& given : history.numbers) {
    if (given.given_at <= moment && number.ok()) {
      EXPECT_GT(*number, given.number);
    }
  }
  return left;
}

JournalRun::JournalRun(RecordedFileSystem& disk, std::mt19937& random, RunHistory history)
    : disk_(disk), random_(random), history_(std::move(history)), file_bytes_(kFileBytes.back()) {}

std::size_t JournalRun::below(std::size_t end) {
  return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_);
}

void JournalRun::take_steps(std::size_t count) {
  for (std::size_t step = 0; step < count; ++step) take_step();
}

void JournalRun::take_step() {
  if (journal_ == nullptr || counter_ == nullptr) {
    open();
    return;
  }
  const std::size_t draw = below(100);
  if (draw < 50) {
    append();
  } else if (draw < 80) {
    remove();
  } else if (draw < 90) {
    for (std::size_t scans = below(40); scans > 0; --scans) count_scan();
  } else {
    close(draw < 95);
  }
}

std::string JournalRun::make_payload() {
  constexpr std::size_t kOneBlock = kBlockPayloadBytes;
  const std::array<std::size_t, 5> bytes = {below(20), kOneBlock - 8 + below(8), 2000 + below(6000),
                                            2 * kOneBlock + below(9), below(20000)};
  return filled_payload(bytes[below(bytes.size())], static_cast<std::uint32_t>(random_()));
}

void JournalRun::append() {
  AppendedRecord record{make_payload(), disk_.operations().size(), std::nullopt, std::nullopt};
  const bool has_room = journal_->has_room(record.payload.size());
  const auto stored = journal_->append(record.payload);
  if (stored.ok()) {
    EXPECT_TRUE(has_room);
    record.stored_at = disk_.operations().size();
  } else {
    EXPECT_TRUE(!has_room || disk_.fault_has_struck()) << stored.failure();
  }
  history_.records.push_back(std::move(record));
}

void JournalRun::remove() {
  const auto oldest = journal_->oldest();
  if (!oldest.ok()) {
    EXPECT_TRUE(disk_.fault_has_struck()) << oldest.failure();
    return;
  }
  if (!oldest->has_value()) return;
  const auto known = std::find_if(history_.records.begin(), history_.records.end(),
                                  [&](const auto& record) { return record.payload == (*oldest)->payload; });
  ASSERT_NE(known, history_.records.end()) << "never appended";
  if (!known->removed_at) known->removed_at = disk_.operations().size();
  EXPECT_TRUE(journal_->remove_oldest((*oldest)->sequence).ok());
}

void JournalRun::count_scan() {
  const auto number = counter_->next();
  if (!number.ok()) {
    EXPECT_TRUE(disk_.fault_has_struck()) << number.failure();
    return;
  }
  if (!history_.numbers.empty()) {
    EXPECT_GT(*number, history_.numbers.back().number);
  }
  history_.numbers.push_back({*number, disk_.operations().size()});
}

void JournalRun::open() {
  if (below(4) == 0) file_bytes_ = kFileBytes[below(kFileBytes.size())];
  if (journal_ == nullptr) {
    auto opened = Journal::open(disk_, {kJournalPath, file_bytes_});
    if (!opened.ok()) {
      EXPECT_TRUE(disk_.fault_has_struck()) << opened.failure();
      return;
    }
    journal_ = std::move(*opened);
    if (!disk_.has_fault()) {
      note_failed_syncs();
      for (const JournalNotice& notice : journal_->take_notices()) {
        EXPECT_TRUE(history_.has_failed_sync || !is_damage(notice)) << notice.text;
      }
      expect_in_history(read_all(*journal_), history_, disk_.operations().size());
    }
  }
  auto counter = ScanCounter::open(disk_, kCounterPath, 0);
  if (!counter.ok()) {
    EXPECT_TRUE(disk_.fault_has_struck()) << counter.failure();
    return;
  }
  counter_ = std::move(*counter);
}

void JournalRun::note_failed_syncs() {
  history_.has_failed_sync |= std::any_of(
      disk_.operations().begin(), disk_.operations().end(), [](const RecordedOperation& operation) {
        return operation.kind == RecordedOperation::Kind::sync_file && operation.failed;
      });
}

void JournalRun::close(bool by_kill) {
  if (by_kill) disk_.kill_process();
  journal_.reset();
  counter_.reset();
  note_failed_syncs();
}

std::size_t JournalRun::acknowledged_count() const {
  return static_cast<std::size_t>(
      std::count_if(history_.records.begin(), history_.records.end(),
                    [](const auto& record) { return record.stored_at.has_value(); }));
}

}  // namespace traygauge::test
