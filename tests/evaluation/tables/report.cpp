#include "tests/evaluation/tables/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "firmware/base/text.hpp"
#include "firmware/evaluate/evaluation.hpp"
#include "firmware/evaluate/evaluation_plots.hpp"
#include "firmware/evaluate/table_cells.hpp"
#include "firmware/plot/chart.hpp"
#include "simulator/capture/output_file.hpp"
#include "tests/evaluation/tables/provenance.hpp"

namespace traygauge::tables {
namespace {

constexpr double kMaxMapeShown = 60.0;

struct Curve {
  std::vector<DataPoint> paper;
  std::vector<DataPoint> ours;
  std::vector<DataPoint> best;
};

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw OutputError(file, "it could not be written");
}

Curve curve_of(const MeasuredTable& table) {
  Curve curve;
  double place = 0.0;
  for (const MeasuredRow& row : table.rows) {
    place += 1.0;
    const double x = row.row.number.value_or(place);
    if (row.row.paper_mape) curve.paper.push_back({x, *row.row.paper_mape});
    if (std::isnan(row.figures.foods.mape)) continue;
    auto& ours = row.row.variant.profile == Profile::best ? curve.best : curve.ours;
    ours.push_back({x, row.figures.foods.mape});
  }
  return curve;
}

// Numbered rows are joined; others have no order.
void draw(Chart& chart, const std::vector<DataPoint>& points, const MarkerStyle& style, bool is_joined,
          const std::string& legend) {
  if (points.empty()) return;
  if (is_joined) chart.line(points, {style.colour, 1.6, ""}, "");
  chart.markers(points, style, legend);
}

struct ProfileErrors {
  Profile profile;
  Evaluation evaluation;
};

ProfileErrors evaluate(Profile profile, const std::filesystem::path& set, const RunnerOptions& options,
                       const WorkResult& result) {
  ProtocolOptions protocol;
  protocol.runs = options.runs;
  protocol.parameters.profile = profile;
  protocol.profile = abilities_of(profile);
  return {profile, evaluate_runs(set.string(), protocol, result.runs, result.skipped)};
}

// What the profile's volumes are compared with, as in the tables.
const SetFigures& figures_of(const Evaluation& evaluation) {
  for (const GroupEvaluation& group : evaluation.groups) {
    if (group.key == "foods_above_bottom_plane") return group.figures;
  }
  return evaluation.groups.front().figures;
}

void compose_errors(const std::vector<ProfileErrors>& profiles, std::ostream& text) {
  text << "## Distribution of the errors (V-D-1, Fig. 8)\n\n"
          "| | MAPE % | bias % | within 10 % | within 20 % | mean CV % | CV below 10 % | refused % |\n"
          "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n"
          "| paper | 8.2 | about 0 | 69 | 91.5 | 7.1 | 81.8 | – |\n";
  for (const ProfileErrors& own : profiles) {
    const SetFigures& f = figures_of(own.evaluation);
    text << "| profile " << own.evaluation.profile;
    for (const std::string& value :
         {cell(f.mape, 2), signed_cell(f.bias, 2), cell(f.within_10, 1), cell(f.within_20, 1), cell(f.cv, 2),
          cell(f.cv_below_10, 1), cell(f.refused_share, 1)})
      text << " | " << value;
    text << " |\n";
  }
  text << "\n";
  for (const ProfileErrors& own : profiles) {
    for (const char* plot : {"signed_errors", "variation", "error_by_angle", "volumes"})
      text << "![" << plot << ", profile " << own.evaluation.profile << "](" << plot << "_"
           << own.evaluation.profile << ".svg)\n";
  }
  text << "\n";
}

void write_error_plots(const std::filesystem::path& folder, const Evaluation& evaluation) {
  const std::string end = "_" + evaluation.profile + ".svg";
  write_text(folder / ("signed_errors" + end), plot_signed_errors(evaluation));
  write_text(folder / ("variation" + end), plot_variation(evaluation));
  write_text(folder / ("error_by_angle" + end), plot_error_by_angle(evaluation));
  write_text(folder / ("volumes" + end), plot_volumes(evaluation));
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

}  // namespace

std::string plot_table(const MeasuredTable& table) {
  const Curve curve = curve_of(table);
  if (curve.ours.empty() && curve.best.empty())
    return compose_empty_chart(table.table.title, "Nothing was measured.");
  double largest = 0.0;
  double low = HUGE_VAL;
  double high = 0.0;
  for (const auto* points : {&curve.paper, &curve.ours, &curve.best}) {
    for (const DataPoint& point : *points) {
      largest = std::max(largest, point.y);
      low = std::min(low, point.x);
      high = std::max(high, point.x);
    }
  }
  const bool is_joined = !table.table.axis.empty();
  const Axis x = make_axis(is_joined ? table.table.axis : "row of the table", low, high, 8);
  Chart chart(table.table.title, "the paper's figures and ours", x,
              make_axis("MAPE (%)", 0.0, std::min(largest, kMaxMapeShown), 6));
  draw(chart, curve.paper, {Marker::square, kOrange, 4.0, 1.0}, is_joined, "paper");
  draw(chart, curve.ours, {Marker::dot, kBlue, 4.0, 1.0}, is_joined, "ours");
  draw(chart, curve.best, {Marker::dot, kGreen, 4.0, 1.0}, is_joined, "profile best");
  return chart.str();
}

void write_report(const std::filesystem::path& folder, const SetFolders& sets, const RunnerOptions& options,
                  std::ostream& error) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (!std::filesystem::is_directory(folder)) throw OutputError(folder, "it is no folder");
  std::set<std::string> skipped;
  const auto tables =
      measure_tables(measurable_tables(paper_tables(), sets, error), sets, options, error, skipped);
  std::ostringstream text;
  compose_head(text);
  text << compose_provenance(sets, options, skipped);
  for (const MeasuredTable& table : tables) {
    text << compose_markdown(table.table, table.rows);
    text << "![" << table.table.title << "](" << table.table.command << ".svg)\n\n";
    write_text(folder / (table.table.command + ".svg"), plot_table(table));
  }
  if (const auto meals = sets.find(PaperSet::meals); meals != sets.end()) {
    const std::array<Profile, 2> profiles = {Profile::paper, Profile::best};
    std::vector<Work> works;
    for (const Profile profile : profiles) works.push_back({meals->second, {Method::ours, profile, {}}});
    const std::vector<WorkResult> results = run_with_progress(works, options, error, skipped);
    std::vector<ProfileErrors> errors;
    for (std::size_t i = 0; i < profiles.size(); ++i) {
      errors.push_back(evaluate(profiles[i], meals->second, options, results[i]));
      write_error_plots(folder, errors.back().evaluation);
    }
    compose_errors(errors, text);
  }
  write_text(folder / "report.md", text.str());
}

}  // namespace traygauge::tables
