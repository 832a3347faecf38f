#include "tests/evaluation/tables/row_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/base/text.hpp"
#include "firmware/evaluate/item_series.hpp"
#include "firmware/evaluate/profile_abilities.hpp"
#include "firmware/evaluate/statistics.hpp"
#include "firmware/evaluate/table_cells.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge::tables {
namespace {

constexpr double kAngleToleranceDeg = 2.5;  // the paper's angles lie 5 degrees apart
constexpr std::size_t kTitleWidth = 38;
constexpr std::size_t kColumnWidth = 8;
constexpr std::size_t kCells = 9;

bool belongs(const Row& row, const std::filesystem::path& set, const PairRuns& pair) {
  if (row.angle_deg) {
    if (pair.pair[0] != 0 || !pair.true_angle_deg) return false;
    if (!(std::abs(*pair.true_angle_deg - *row.angle_deg) < kAngleToleranceDeg)) return false;
  }
  if (row.dish_style.empty()) return true;
  const bool is_the_set = std::filesystem::exists(set / "capture.json");
  const Capture capture = read_capture(is_the_set ? set : set / pair.capture);
  return !capture.dishes.empty() && capture.dishes.front().style == row.dish_style;
}

double mean_time_s(const std::vector<PairRuns>& runs) {
  std::vector<double> times;
  for (const PairRuns& pair : runs) {
    for (const Run& run : pair.runs) {
      if (run.status == StatusCode::ok || run.status == StatusCode::partial)
        times.push_back(1e-3 * run.total_ms);
    }
  }
  return mean(times);
}

std::string optional_cell(const std::optional<double>& value, int decimals) {
  return cell(value.value_or(kUndefined), decimals);
}

std::array<std::string, kCells> cells_of(const MeasuredRow& row) {
  const SetFigures& foods = row.figures.foods;
  return {optional_cell(row.row.paper_mape, 1),
          optional_cell(row.row.paper_time_s, 1),
          cell(foods.mape, 2),
          signed_cell(foods.bias, 2),
          cell(row.figures.time_s, 3),
          cell(foods.refused_share, 1),
          cell(foods.mape_refusals_as_100, 2),
          std::to_string(foods.items_tried),
          std::to_string(row.figures.pairs)};
}

constexpr std::array<const char*, kCells> kHeadings = {"paper %", "paper s", "MAPE %", "bias %", "time s",
                                                       "refused", "as 100",  "items",  "pairs"};

}  // namespace

RowFigures figures_of(const Row& row, const std::filesystem::path& set, const std::vector<PairRuns>& runs) {
  std::vector<PairRuns> own;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(own),
               [&](const PairRuns& pair) { return belongs(row, set, pair); });
  const bool is_flat = abilities_of(row.variant.profile).takes_dish_for_flat;
  std::vector<ItemSeries> series;
  if (is_flat) series = collect_series(own, TruthVolume::above_bottom_plane, false);
  if (series.empty()) series = collect_series(own, TruthVolume::above_dish, false);
  return {set_figures(series), mean_time_s(own), static_cast<int>(own.size())};
}

std::string compose_text(const Table& table, const std::vector<MeasuredRow>& rows) {
  std::string text = table.title + "\n";
  text += table_row("", kTitleWidth, {kHeadings.begin(), kHeadings.end()}, kColumnWidth);
  for (const MeasuredRow& row : rows) {
    const auto cells = cells_of(row);
    text += table_row(row.row.title, kTitleWidth, {cells.begin(), cells.end()}, kColumnWidth);
  }
  return text;
}

std::string compose_markdown(const Table& table, const std::vector<MeasuredRow>& rows) {
  std::string text = "## " + table.title + "\n\n| |";
  for (const char* heading : kHeadings) text += std::string(" ") + heading + " |";
  text += "\n| --- |";
  for (std::size_t i = 0; i < kCells; ++i) text += " ---: |";
  text += "\n";
  for (const MeasuredRow& row : rows) {
    text += "| " + row.row.title + " |";
    for (const std::string& own : cells_of(row)) text += " " + own + " |";
    text += "\n";
  }
  return text + "\n";
}

}  // namespace traygauge::tables
