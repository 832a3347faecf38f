#include "firmware/evaluate/evaluation_files.hpp"

#include <array>
#include <fstream>
#include <system_error>

#include "simulator/capture/output_file.hpp"

namespace traygauge {
namespace {

struct PlotFiles {
  const char* name;
  const char* data;
};

constexpr std::array<PlotFiles, 4> kPlots = {{{"signed_errors", "estimates.csv"},
                                              {"variation", "items.csv"},
                                              {"error_by_angle", "pairs.csv"},
                                              {"volumes", "pairs.csv"}}};

}  // namespace

void write_text_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw OutputError(file, "it could not be written");
}

void create_folder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (!std::filesystem::is_directory(folder, problem)) throw OutputError(folder, "it is no folder");
}

void write_evaluation_files(const std::filesystem::path& folder, const Evaluation& evaluation,
                            const std::vector<PairRuns>& runs) {
  write_text_file(folder / "estimates.csv", compose_estimates_csv(runs));
  write_text_file(folder / "pairs.csv", compose_pairs_csv(runs));
  write_text_file(folder / "runs.csv", compose_runs_csv(runs));
  write_text_file(folder / "items.csv", compose_items_csv(evaluation));
  write_text_file(folder / "captures.csv", compose_captures_csv(evaluation));
  write_text_file(folder / "summary.json", compose_summary_json(evaluation));
  if (!evaluation.outlines.empty()) write_text_file(folder / "outlines.csv", compose_outlines_csv(runs));
}

std::vector<Plot> plots_of_evaluation(const std::filesystem::path& scripts,
                                      const std::filesystem::path& folder) {
  std::vector<Plot> plots;
  for (const PlotFiles& own : kPlots) {
    const std::string name = own.name;
    plots.push_back({scripts / (name + ".gp"), folder / own.data, folder / (name + ".svg"), {}});
  }
  return plots;
}

}  // namespace traygauge
