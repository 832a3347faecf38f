// An evaluation in a folder: CSV for a spreadsheet, JSON for scripts, plots for reports.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/evaluate/evaluation.hpp"
#include "firmware/evaluate/gnuplot.hpp"

namespace traygauge {

// Throws OutputError.
void write_text_file(const std::filesystem::path& file, const std::string& text);

// Makes the folder where there is none. Throws OutputError.
void create_folder(const std::filesystem::path& folder);

// estimates.csv, pairs.csv, runs.csv, items.csv, captures.csv, summary.json, and outlines.csv where the
// segmentation drew outlines. Throws OutputError.
void write_evaluation_files(const std::filesystem::path& folder, const Evaluation& evaluation,
                            const std::vector<PairRuns>& runs);

// signed_errors.svg (the paper's Fig. 8 (a)), variation.svg (Fig. 8 (b)), error_by_angle.svg and volumes.svg,
// from the files in `folder`, by the scripts in `scripts`.
std::vector<Plot> plots_of_evaluation(const std::filesystem::path& scripts,
                                      const std::filesystem::path& folder);

}  // namespace traygauge
