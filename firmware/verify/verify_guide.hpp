// Leads through an acceptance test: says what to lay where, and keeps what came of it.
#pragma once

#include <iosfwd>
#include <string>

#include "core/pipeline/measurement.hpp"
#include "firmware/verify/verify_record.hpp"

namespace traygauge {

// What a measurement of a step's tray says. A test tray carries one body: several items are a refusal.
VerifyScan scan_of(const Measurement& measurement);

class VerifyGuide {
 public:
  // Both outlive the guide.
  VerifyGuide(VerifyLog& log, std::ostream& out) : log_(log), out_(out) {}

  const VerifyStep* next() const { return log_.next(); }
  // What to lay where, for `next()`; nothing where all is done.
  void prompt();
  // Keeps an attempt at `next()`, which there has to be, and says what it measured. Throws OutputError.
  void take(VerifyScan scan);

 private:
  const VerifyPlan& plan() const { return log_.record().header.plan; }

  VerifyLog& log_;
  std::ostream& out_;
};

// "30 of 40 steps are done, 1 of them refused for good."
std::string describe_progress(const VerifyRecord& record);

}  // namespace traygauge
