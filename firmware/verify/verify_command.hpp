// `traygauge verify`: the acceptance test of a station, with bodies of known volume.
#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <string>

#include "firmware/verify/verify_plan.hpp"

namespace traygauge {

class Program;

struct VerifyPlanOptions {
  std::filesystem::path out = "plan.toml";
  std::string dish = "dinner";
  double length_sigma_mm = kFoldedSigmaMm;
};

struct VerifyRunOptions {
  std::filesystem::path plan;
  std::filesystem::path out;
  std::filesystem::path station;   // a station file; or
  std::filesystem::path captures;  // a folder of captures
  std::string labels;              // of captures: given, auto, or empty
  std::string temperature;         // as the tester states it; empty: not
  std::string tester;
  std::string config;
};

struct VerifyReportOptions {
  std::filesystem::path record;
  std::filesystem::path out = "certificate";
  std::string wanted = "C";  // the class that decides
  std::string config;
};

struct VerifyOptions {
  VerifyPlanOptions plan;
  VerifyRunOptions run;
  VerifyReportOptions report;
};

void add_verify_command(Program& program, VerifyOptions& options);

// Exit statuses: `plan` 0; `run` 0 where all steps are done, else 1; `report` 0 where the wanted class is
// reached, else 1. Throws UsageError, InputError, OutputError.
int run_verify_plan(const VerifyPlanOptions& options, std::ostream& out);
int run_verify(const VerifyRunOptions& options, const std::atomic<bool>& stop, std::ostream& out,
               std::ostream& log);
int run_verify_report(const VerifyReportOptions& options, std::ostream& out, std::ostream& log);

}  // namespace traygauge
