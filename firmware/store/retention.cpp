#include "firmware/store/retention.hpp"

#include <sys/statvfs.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include "firmware/base/text.hpp"

namespace traygauge {

struct RetentionCandidate {
  std::int64_t seq = 0;
  std::int64_t received_ms = 0;
  bool has_trusted_time = false;
  bool is_pending = false;
  ScanCounts counts;  // of this one
};

struct RetentionPlan {
  std::vector<RetentionCandidate> doomed;  // those of age come first
  std::size_t by_age = 0;
  std::int64_t examined = 0;  // up to this scan
  bool was_last_candidate = false;
  bool was_cut_short = false;  // by a limit on the work of a call
};

namespace {

constexpr const char* kDeletingScans = "old scans cannot be deleted";
constexpr std::size_t kExaminedACall = 1000;
constexpr double kPace = 4.0;
constexpr double kMinBurst = 1.0;  // scans
// What a document occupies beside its bytes: its row in `scans`, its entries in indices, the rest of its
// pages.
constexpr std::int64_t kOverheadBytes = 1024;

using Hours = std::chrono::duration<double, std::ratio<3600>>;
constexpr Hours kDay{24.0};

std::string scans_text(std::int64_t count) {
  return std::to_string(count) + (count == 1 ? " scan" : " scans");
}

std::string describe(const RetentionRules& rules, const RetentionReport& report) {
  std::string text;
  if (report.deleted_by_age > 0 && rules.max_age) {
    text += scans_text(report.deleted_by_age) + " older than " + std::to_string(rules.max_age->count() / 24) +
            " days deleted. ";
  }
  if (report.deleted_for_space > 0) {
    text += scans_text(report.deleted_for_space) + " deleted, the oldest, to free space. ";
  }
  if (report.missing_bytes > 0 && !report.has_more) {
    text += "The disk has " + mebibytes(static_cast<std::size_t>(report.missing_bytes)) +
            " MiB less free than it should, and no further scan may be deleted: the others are among the "
            "newest or"
            " wait for delivery. ";
  }
  if (!text.empty()) text.pop_back();
  return text;
}

// The first so many are older than max_age. A scan of unknown time is as old as the next one of known time.
std::size_t count_too_old(const std::vector<RetentionCandidate>& candidates, const RetentionRules& rules,
                          const WallTime& now) {
  if (!rules.max_age || !now.synchronised) return 0;
  const std::int64_t oldest_kept_ms = now.unix_ms - std::chrono::milliseconds(*rules.max_age).count();
  std::size_t count = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!candidates[i].has_trusted_time) continue;
    if (candidates[i].received_ms >= oldest_kept_ms) break;
    count = i + 1;
  }
  return count;
}

RetentionPlan make_plan(const std::vector<RetentionCandidate>& candidates, std::size_t too_old,
                        std::int64_t missing_bytes, double allowed_by_age, int max_deleted) {
  RetentionPlan plan;
  std::int64_t freed = 0;
  std::size_t next = 0;
  for (; next < candidates.size(); ++next) {
    const RetentionCandidate& candidate = candidates[next];
    const bool goes_by_age = next < too_old && static_cast<double>(plan.by_age) + 1.0 <= allowed_by_age;
    if (!goes_by_age && freed >= missing_bytes) break;
    if (plan.doomed.size() >= static_cast<std::size_t>(max_deleted)) {
      plan.was_cut_short = true;
      break;
    }
    plan.examined = candidate.seq;
    if (candidate.is_pending) continue;
    plan.doomed.push_back(candidate);
    freed += candidate.counts.document_bytes + kOverheadBytes;
    if (goes_by_age) ++plan.by_age;
  }
  plan.was_last_candidate = next == candidates.size();
  if (plan.was_last_candidate && candidates.size() == kExaminedACall) plan.was_cut_short = true;
  return plan;
}

}  // namespace

Expected<std::int64_t> free_bytes_of(const std::filesystem::path& folder) {
  struct statvfs state {};
  if (::statvfs(folder.c_str(), &state) != 0) {
    return Failure{folder.string() + ": its free space cannot be read: " + std::strerror(errno)};
  }
  return static_cast<std::int64_t>(state.f_bavail) * static_cast<std::int64_t>(state.f_frsize);
}

Expected<RetentionReport> Retention::run(const RetentionRules& rules, const WallTime& now,
                                         std::chrono::steady_clock::time_point steady_now) {
  const Expected<std::int64_t> missing = missing_bytes(rules);
  if (!missing.ok()) return Failure{missing.failure()};
  const Expected<double> allowed = allow_by_age(rules, steady_now);
  if (!allowed.ok()) return Failure{allowed.failure()};
  const Expected<std::vector<RetentionCandidate>> candidates = next_candidates(rules);
  if (!candidates.ok()) return Failure{candidates.failure()};
  const RetentionPlan plan = make_plan(*candidates, count_too_old(*candidates, rules, now), *missing,
                                       *allowed, rules.max_deleted_a_call);
  return carry_out(plan, rules);
}

Expected<RetentionReport> Retention::carry_out(const RetentionPlan& plan, const RetentionRules& rules) {
  RetentionReport report;
  const Expected<std::size_t> erased = erase(plan.doomed);
  if (!erased.ok()) {
    examined_ = 0;
    return Failure{erased.failure()};
  }
  report.deleted_by_age = static_cast<std::int64_t>(std::min(*erased, plan.by_age));
  report.deleted_for_space = static_cast<std::int64_t>(*erased) - report.deleted_by_age;
  allowed_by_age_ -= static_cast<double>(report.deleted_by_age);
  const Expected<std::int64_t> still_missing = missing_bytes(rules);
  if (!still_missing.ok()) return Failure{still_missing.failure()};
  report.missing_bytes = *still_missing;
  const bool freed_too_little = *still_missing > 0 && *erased > 0;
  report.has_more =
      plan.was_cut_short || *erased < plan.doomed.size() || (freed_too_little && !plan.was_last_candidate);
  examined_ = report.has_more ? plan.examined : 0;
  if (*erased < plan.doomed.size()) examined_ = 0;
  report.text = describe(rules, report);
  return report;
}

// Pages that are free in the store's own file count: the next scans use them, and the file never shrinks.
Expected<std::int64_t> Retention::missing_bytes(const RetentionRules& rules) {
  if (rules.min_free_bytes <= 0) return std::int64_t{0};
  Expected<std::int64_t> outside = free_space_(database_.file().parent_path());
  if (!outside.ok()) return outside;
  auto inside = database_.integer(
      kDeletingScans, "SELECT freelist_count * page_size FROM pragma_freelist_count, pragma_page_size");
  if (!inside.ok()) return inside;
  return std::max(std::int64_t{0}, rules.min_free_bytes - *outside - *inside);
}

Expected<double> Retention::allow_by_age(const RetentionRules& rules,
                                         std::chrono::steady_clock::time_point steady_now) {
  if (!rules.max_age || rules.max_age->count() <= 0) return 0.0;
  const Expected<StoreTotals> totals = scans_.totals();
  if (!totals.ok()) return Failure{totals.failure()};
  const double scans_an_hour =
      kPace * static_cast<double>(totals->counts.scans) / static_cast<double>(rules.max_age->count());
  const Hours elapsed = last_run_ ? Hours(steady_now - *last_run_) : Hours(0.0);
  last_run_ = steady_now;
  const double burst = std::max(kMinBurst, scans_an_hour * kDay.count());
  allowed_by_age_ = std::min(burst, allowed_by_age_ + scans_an_hour * elapsed.count());
  return allowed_by_age_;
}

Expected<std::vector<RetentionCandidate>> Retention::next_candidates(const RetentionRules& rules) {
  std::vector<RetentionCandidate> candidates;
  const Expected<void> read = database_.each(
      kDeletingScans,
      "SELECT seq, received_ms, received_synchronised, EXISTS (SELECT 1 FROM destinations"
      " CROSS JOIN deliveries ON deliveries.destination = key AND place = scans.seq AND turn = 0)"
      " OR EXISTS (SELECT 1 FROM deliveries WHERE correction > 0 AND deliveries.seq = scans.seq),"
      " superseded_by IS NOT NULL, is_corrected, is_wrong, document_bytes FROM scans WHERE seq > ?1"
      " AND seq < (SELECT seq FROM scans ORDER BY seq DESC LIMIT 1 OFFSET ?2) ORDER BY seq LIMIT ?3",
      [&](const Statement& row) {
        candidates.push_back({row.integer(0),
                              row.integer(1),
                              row.integer(2) != 0,
                              row.integer(3) != 0,
                              {1, row.integer(4), row.integer(5), row.integer(6), 0, row.integer(7)}});
      },
      examined_, std::max<std::int64_t>(1, rules.keep_newest) - 1, static_cast<std::int64_t>(kExaminedACall));
  if (!read.ok()) return Failure{read.failure()};
  return candidates;
}

// Gives how many of them, the first, were deleted: a full disk may have room for the journal of a smaller
// change.
Expected<std::size_t> Retention::erase(const std::vector<RetentionCandidate>& doomed) {
  for (std::size_t count = doomed.size(); count > 0;) {
    ScanCounts change;
    const Expected<void> done = database_.transaction(kDeletingScans, [&]() -> Expected<void> {
      Expected<void> deleted;
      for (std::size_t i = 0; i < count && deleted.ok(); ++i) {
        deleted = database_.execute(kDeletingScans, "DELETE FROM scans WHERE seq = ?1", doomed[i].seq);
        change -= doomed[i].counts;
      }
      return deleted;
    });
    scans_.note_change(done, change);
    if (done.ok()) return count;
    if (!database_.was_full() || count == 1) return Failure{done.failure()};
    count = (count + 3) / 4;
  }
  return std::size_t{0};
}

}  // namespace traygauge
