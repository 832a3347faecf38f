// The certificate of an acceptance test: Markdown, a table of all scans, plots.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "firmware/verify/verify_classes.hpp"

namespace traygauge {

// A few lines for the terminal.
std::string compose_summary(const VerifyFigures& figures, const VerifyClass& wanted);

// What people read.
std::string compose_certificate(const VerifyRecord& record, const VerifyFigures& figures,
                                const VerifyClass& wanted);

// Each attempt a row.
std::string compose_scans_csv(const VerifyRecord& record);

// certificate.md, scans.csv, errors.svg and repeats.svg; without gnuplot no plots, which `log` says. Throws
// InputError, OutputError, PlotError.
void write_certificate(const std::filesystem::path& folder, const VerifyRecord& record,
                       const VerifyFigures& figures, const VerifyClass& wanted, const std::string& config,
                       std::ostream& log);

}  // namespace traygauge
