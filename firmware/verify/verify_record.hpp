// What an acceptance test has seen so far: a file of JSON lines that only grows.
//
// The first line says everything about the test but its scans, so that a certificate needs no other file;
// each further line is a scan. A line is on disk before the next scan begins.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/file_descriptor.hpp"
#include "firmware/verify/verify_plan.hpp"

namespace traygauge {

struct VerifyCondition {
  std::string name;
  std::string value;
};

struct VerifyHeader {
  std::string program;  // its version
  std::string started;  // UTC
  std::vector<VerifyCondition> conditions;
  VerifyPlan plan;
};

// One attempt at a step.
struct VerifyScan {
  std::string step;
  int attempt = 1;
  std::string time;  // UTC
  std::string status;
  std::string message;  // why it was refused; empty where it was measured
  bool is_measured = false;
  bool is_last = false;    // no further attempt can be made at this step
  double volume_ml = 0.0;  // these hold only when it was measured
  double sigma_ml = 0.0;
  std::vector<std::string> warnings;  // codes
};

struct VerifyRecord {
  VerifyHeader header;
  std::vector<VerifyScan> scans;
  bool was_torn = false;  // the last line was not whole, and does not count

  int attempts_at(const std::string& step) const;
  const VerifyScan* measured(const std::string& step) const;  // null: not yet, or refused
  bool is_done(const VerifyStep& step) const;                 // measured, or refused as often as may be
};

// Throws InputError: absent, or a damaged line that is not the last one.
VerifyRecord read_verify_record(const std::filesystem::path& file);

// The record while the test runs.
class VerifyLog {
 public:
  // Begins a file, or goes on with one of the same plan, program and conditions; a last line that is not
  // whole is removed. Throws InputError, UsageError for a file of another test or one that is in use,
  // OutputError.
  VerifyLog(std::filesystem::path file, const VerifyHeader& header);

  const VerifyRecord& record() const { return record_; }
  // The first step that is not done; null: all are.
  const VerifyStep* next() const;
  // Returns when the scan is on disk. Throws OutputError.
  void append(const VerifyScan& scan);

 private:
  void write_line(const std::string& line);

  std::filesystem::path file_;
  FileDescriptor descriptor_;
  VerifyRecord record_;
};

}  // namespace traygauge
