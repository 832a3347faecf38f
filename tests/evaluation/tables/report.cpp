#include "tests/evaluation/tables/report.hpp"

#include <array>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "firmware/base/csv_fields.hpp"
#include "firmware/evaluate/evaluation.hpp"
#include "firmware/evaluate/evaluation_files.hpp"
#include "firmware/evaluate/table_cells.hpp"
#include "tests/evaluation/tables/provenance.hpp"

namespace traygauge::tables {
namespace {

constexpr const char* kScripts = TRAYGAUGE_SOURCE_DIR "/config/plots";

// Numbered rows are drawn as a curve; others have no order, and stand below each other.
Plot plot_of_table(const std::filesystem::path& folder, const Table& table) {
  const char* script = table.axis.empty() ? "paper_rows.gp" : "paper_curve.gp";
  return {std::filesystem::path(kScripts) / script,
          folder / (table.command + ".csv"),
          folder / (table.command + ".svg"),
          {table.title, table.axis}};
}

Evaluation evaluate(Profile profile, const std::filesystem::path& set, const RunnerOptions& options,
                    const WorkResult& result) {
  ProtocolOptions protocol;
  protocol.runs = options.runs;
  protocol.parameters.profile = profile;
  protocol.profile = abilities_of(profile);
  return evaluate_runs(set.string(), protocol, result.runs, result.skipped);
}

// What the profile's volumes are compared with, as in the tables.
const SetFigures& figures_of(const Evaluation& evaluation) {
  for (const GroupEvaluation& group : evaluation.groups) {
    if (group.key == "foods_above_bottom_plane") return group.figures;
  }
  return evaluation.groups.front().figures;
}

void compose_errors(const std::vector<Evaluation>& profiles, std::ostream& text) {
  text << "## Distribution of the errors (V-D-1, Fig. 8)\n\n"
          "| | MAPE % | bias % | within 10 % | within 20 % | mean CV % | CV below 10 % | refused % |\n"
          "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n"
          "| paper | 8.2 | about 0 | 69 | 91.5 | 7.1 | 81.8 | – |\n";
  for (const Evaluation& own : profiles) {
    const SetFigures& f = figures_of(own);
    text << "| profile " << own.profile;
    for (const std::string& value :
         {cell(f.mape, 2), signed_cell(f.bias, 2), cell(f.within_10, 1), cell(f.within_20, 1), cell(f.cv, 2),
          cell(f.cv_below_10, 1), cell(f.refused_fraction, 1)})
      text << " | " << value;
    text << " |\n";
  }
  text << "\n";
  for (const Evaluation& own : profiles) {
    for (const char* plot : {"signed_errors", "variation", "error_by_angle", "volumes"})
      text << "![" << plot << ", profile " << own.profile << "](" << own.profile << "/" << plot << ".svg)\n";
  }
  text << "\n";
}

void compose_head(std::ostream& text) {
  text << "# The paper's comparisons, run again\n\n"
          "The paper's MAPE and time (`paper %`, `paper s`: on its own photographs and processor) stand "
          "beside ours. "
          "Profile `paper` and the compared methods take a dish for flat and are compared with the volume "
          "above the "
          "plane of its bottom, as the paper's truth is formed; profile `best` with the volume above the "
          "dish's inner "
          "surface. `MAPE %`, `bias %` and `time s` are of what was measured; `as 100` counts each refusal "
          "as an error "
          "of 100 %. Below each table: the MAPE against both truths (`plane %`, `dish %`), and how much it "
          "differs from that of the row named `beside`, on the items that both measured (`shared`), in "
          "points; "
          "95 % intervals by bootstrap over captures.\n\n";
}

std::string compose_rows_csv(const MeasuredTable& table) {
  std::ostringstream csv;
  csv << "title,number,paper_mape_percent,ours_mape_percent,best_mape_percent\n";
  double place = 0.0;
  for (const MeasuredRow& measured : table.rows) {
    place += 1.0;
    const Row& row = measured.row;
    const std::string mape = csv_number(measured.figures.foods.mape, 3);
    const bool is_best = row.variant.profile == Profile::best;
    csv << csv_field(row.title) << ',' << csv_number(row.number.value_or(place), 3) << ','
        << csv_number(row.paper_mape, 3) << ',' << (is_best ? "" : mape) << ',' << (is_best ? mape : "")
        << '\n';
  }
  return csv.str();
}

// Both profiles on the meals; appends to the text and to what is to be drawn.
void write_errors(const std::filesystem::path& folder, const std::filesystem::path& meals,
                  const RunnerOptions& options, std::ostream& error, std::set<std::string>& skipped,
                  std::ostream& text, std::vector<Plot>& plots) {
  const std::array<Profile, 2> profiles = {Profile::paper, Profile::best};
  std::vector<Work> works;
  for (const Profile profile : profiles) works.push_back({meals, {Method::ours, profile, {}}});
  const std::vector<WorkResult> results = run_with_progress(works, options, error, skipped);
  std::vector<Evaluation> evaluations;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const Evaluation& own = evaluations.emplace_back(evaluate(profiles[i], meals, options, results[i]));
    create_folder(folder / own.profile);
    write_evaluation_files(folder / own.profile, own, results[i].runs);
    for (Plot& plot : plots_of_evaluation(kScripts, folder / own.profile)) plots.push_back(std::move(plot));
  }
  compose_errors(evaluations, text);
}

}  // namespace

void write_report(const std::filesystem::path& folder, const SetFolders& sets, const RunnerOptions& options,
                  std::ostream& error) {
  create_folder(folder);
  std::set<std::string> skipped;
  const auto tables =
      measure_tables(measurable_tables(paper_tables(), sets, error), sets, options, error, skipped);
  std::ostringstream text;
  compose_head(text);
  text << compose_provenance(sets, options, skipped);
  std::vector<Plot> plots;
  for (const MeasuredTable& table : tables) {
    text << compose_markdown(table.table, table.rows);
    text << "![" << table.table.title << "](" << table.table.command << ".svg)\n\n";
    plots.push_back(plot_of_table(folder, table.table));
    write_text_file(plots.back().data, compose_rows_csv(table));
  }
  if (const auto meals = sets.find(PaperSet::meals); meals != sets.end())
    write_errors(folder, meals->second, options, error, skipped, text, plots);
  write_text_file(folder / "report.md", text.str());
  draw_plots(plots, error);
}

}  // namespace traygauge::tables
