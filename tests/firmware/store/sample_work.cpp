#include "tests/firmware/store/sample_work.hpp"

#include <chrono>

#include "tests/firmware/store/sample_scan.hpp"

namespace traygauge::test {
namespace {

constexpr std::int64_t kScanEveryMs = 60'000;

std::int64_t time_of(const WorkStep& step) {
  return kMorningMs + static_cast<std::int64_t>(step.number) * kScanEveryMs;
}

std::string document_of(const WorkStep& step) {
  SampleScan scan;
  scan.id.number = step.number;
  scan.taken_ms = time_of(step);
  // Of few and of many pages.
  scan.foods.resize(step.number % 5, "bread");
  if (step.number > 1 && step.number % 3 == 0) scan.supersedes = ScanId{"kitchen", step.number - 1};
  if (step.kind == WorkStep::Kind::put_other) scan.status = "another";
  return sample_document(scan);
}

Expected<void> as_nothing(const std::string& failure) {
  return failure.empty() ? Expected<void>() : Failure{failure};
}

Expected<void> correct(Store& store, const WorkStep& step) {
  CorrectionAction action = MarkScanWrong{};
  if (step.chance % 3 == 1) action = RenameItem{2, "soup"};
  if (step.chance % 3 == 2) action = SplitItem{2, 10.0, "peas"};
  const auto booked =
      store.corrections().add({"kitchen", step.number}, action, "chef", "seen", at(time_of(step)));
  return as_nothing(booked.ok() ? "" : booked.failure());
}

Expected<void> retain(Store& store, const WorkStep&) {
  RetentionRules rules;
  rules.keep_newest = 3;
  rules.max_deleted_a_call = 4;
  rules.min_free_bytes = 1;
  Retention retention(store.database(), store.scans(),
                      [](const std::filesystem::path&) -> Expected<std::int64_t> { return -200'000; });
  const auto done = retention.run(rules, at(kMorningMs), std::chrono::steady_clock::time_point());
  if (!done.ok()) return Failure{done.failure()};
  return done->deleted_for_space > 0 ? Expected<void>() : change_nothing(store);
}

}  // namespace

std::vector<WorkStep> sample_work(std::size_t steps, std::mt19937_64& random) {
  using Kind = WorkStep::Kind;
  std::vector<WorkStep> work;
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < steps; ++i) {
    const std::uint64_t dice = random() % 12;
    if (last == 0 || dice < 6) {
      work.push_back({Kind::put, ++last, random()});
      continue;
    }
    const std::uint64_t earlier = last - random() % std::min<std::uint64_t>(last, 4);
    constexpr Kind kOthers[] = {Kind::put_again, Kind::put_other, Kind::correct,
                                Kind::deliver,   Kind::deliver,   Kind::retain};
    const Kind kind = dice == 6 && random() % 2 == 0 ? Kind::fail_delivery : kOthers[dice - 6];
    work.push_back({kind, earlier, random()});
  }
  return work;
}

Expected<void> change_nothing(Store& store) {
  constexpr std::int64_t kNoSuchNumber = 1'000'000;
  const Expected<bool> discarded = store.scans().discard_set_aside(kNoSuchNumber);
  return as_nothing(discarded.ok() ? "" : discarded.failure());
}

Expected<void> do_step(Store& store, const WorkStep& step) {
  const std::string destination = step.chance % 2 == 0 ? "webhook" : "broker";
  switch (step.kind) {
    case WorkStep::Kind::put:
    case WorkStep::Kind::put_again:
    case WorkStep::Kind::put_other: {
      const auto put = store.scans().put(document_of(step), at(time_of(step)));
      return as_nothing(put.ok() ? "" : put.failure());
    }
    case WorkStep::Kind::correct:
      return correct(store, step);
    case WorkStep::Kind::deliver: {
      const auto due = store.deliveries().due(destination, time_of(step), 2);
      if (!due.ok()) return Failure{due.failure()};
      std::vector<DeliveryKey> keys;
      for (const PendingDelivery& delivery : *due) keys.push_back(delivery.key);
      return store.deliveries().mark_delivered(destination, keys);
    }
    case WorkStep::Kind::fail_delivery: {
      const auto due = store.deliveries().due(destination, time_of(step), 1);
      if (!due.ok()) return Failure{due.failure()};
      if (due->empty()) return change_nothing(store);
      return store.deliveries().mark_failed(destination, due->front().key, time_of(step),
                                            std::chrono::seconds(30), "no answer");
    }
    case WorkStep::Kind::retain:
      return retain(store, step);
  }
  return {};
}

std::string content_of(Store& store) {
  std::string content;
  for (const char* const sql :
       {"SELECT concat FROM (SELECT seq, seq || station || number || ' ' || taken_ms || ' ' || received_ms ||"
        " status || ifnull(supersedes, '-') || ' ' || ifnull(superseded_by, '-') || is_corrected || is_wrong "
        "||"
        " foods || body AS concat FROM scans JOIN documents USING (seq) ORDER BY seq)",
        "SELECT seq || ' ' || number || ' ' || author || action FROM corrections ORDER BY seq, number",
        "SELECT name || ' ' || place || ' ' || turn || ' ' || seq || ' ' || correction || ' ' || attempts || "
        "' '"
        " || next_ms || last_failure FROM deliveries JOIN destinations ON key = destination"
        " ORDER BY name, place, turn",
        "SELECT why || ' ' || CAST(document AS TEXT) FROM set_aside ORDER BY number",
        "SELECT 'documents: ' || count(*) FROM documents",
        "SELECT 'quick check: ' || quick_check"
        " FROM pragma_quick_check"}) {
    const Expected<void> read = store.database().each(
        "the test cannot read", sql, [&](const Statement& row) { content += row.text(0) + "\n"; });
    if (!read.ok()) content += read.failure() + "\n";
  }
  return content;
}

StoreOptions options_for_work(const std::filesystem::path& folder) {
  StoreOptions options;
  options.file = folder / "results.db";
  options.destinations = {"webhook", "broker"};
  return options;
}

}  // namespace traygauge::test
