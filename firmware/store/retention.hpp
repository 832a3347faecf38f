// Old scans make room for new ones; never those that somebody still has to be told of.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/store/database.hpp"
#include "firmware/store/scan_store.hpp"

namespace traygauge {

struct RetentionRules {
  std::optional<std::chrono::hours> max_age;  // since the hub received it
  std::int64_t min_free_bytes = 0;            // of the file system, with what is free in the store's own file
  // However old they are: what a station's journal may deliver once more has to be known by its id.
  std::int64_t keep_newest = 4096;
  int max_deleted_a_call = 200;
};

struct RetentionReport {
  std::int64_t deleted_by_age = 0;
  std::int64_t deleted_for_space = 0;
  std::int64_t missing_bytes = 0;  // to min_free_bytes, after this call
  bool has_more = false;           // another call at once would do more
  std::string text;  // what it did or could not do, for people; empty where there is nothing to say
};

// Bytes that a user may still write there.
using FreeSpace = std::function<Expected<std::int64_t>(const std::filesystem::path& folder)>;
Expected<std::int64_t> free_bytes_of(const std::filesystem::path& folder);

struct RetentionCandidate;
struct RetentionPlan;

class Retention {
 public:
  Retention(Database& database, ScanStore& scans, FreeSpace free_space = free_bytes_of)
      : database_(database), scans_(scans), free_space_(std::move(free_space)) {}

  // One short step: looks at no more than 1,000 scans, oldest first. To be called every minute or so.
  //
  // By age it deletes only when the clock is synchronised, and in a day at most four times the share of the
  // store that a day makes of max_age: a clock that is ten years ahead costs little before somebody sees it.
  // Scans that were received under a clock that was not synchronised are as old as the next one that was not.
  Expected<RetentionReport> run(const RetentionRules& rules, const WallTime& now,
                                std::chrono::steady_clock::time_point steady_now);

 private:
  Expected<std::int64_t> missing_bytes(const RetentionRules& rules);
  Expected<std::vector<RetentionCandidate>> next_candidates(const RetentionRules& rules);
  Expected<double> allow_by_age(const RetentionRules& rules,
                                std::chrono::steady_clock::time_point steady_now);
  Expected<RetentionReport> carry_out(const RetentionPlan& plan, const RetentionRules& rules);
  Expected<std::size_t> erase(const std::vector<RetentionCandidate>& doomed);

  Database& database_;
  ScanStore& scans_;
  FreeSpace free_space_;
  std::int64_t examined_ = 0;  // scans up to this one were looked at in this round
  std::optional<std::chrono::steady_clock::time_point> last_run_;
  double allowed_by_age_ = 0.0;  // scans
};

}  // namespace traygauge
