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
          cell(foods.refused_fraction, 1),
          cell(foods.mape_refusals_as_100, 2),
          std::to_string(foods.items_tried),
          std::to_string(row.figures.pairs)};
}

constexpr std::array<const char*, kCells> kHeadings = {"paper %", "paper s", "MAPE %", "bias %", "time s",
                                                       "refused", "as 100",  "items",  "pairs"};

using Cells = std::vector<std::string>;

constexpr std::array<const char*, 9> kTruthHeadings = {"plane %", "dish %", "d plane", "from",  "to",
                                                       "d dish",  "from",   "to",      "shared"};

Cells difference_cells(const PairedDifference& difference) {
  const auto& interval = difference.interval;
  return {signed_cell(difference.mape, 2), signed_cell(interval ? interval->low : kUndefined, 2),
          signed_cell(interval ? interval->high : kUndefined, 2)};
}

std::string shared_cell(const RowFigures& figures) {
  int shared = 0;
  for (const TruthFigures& own : figures.by_truth) shared = std::max(shared, own.difference.items);
  return shared > 0 ? std::to_string(shared) : kNoValue;
}

Cells truth_cells(const RowFigures& figures) {
  Cells cells;
  for (const TruthFigures& own : figures.by_truth) cells.push_back(cell(own.mape, 2));
  for (const TruthFigures& own : figures.by_truth) {
    for (std::string& value : difference_cells(own.difference)) cells.push_back(std::move(value));
  }
  cells.push_back(shared_cell(figures));
  return cells;
}

std::string with_interval(const std::string& value, const std::optional<ConfidenceInterval>& interval,
                          std::string (*write)(double, int)) {
  if (!interval) return value;
  return value + " (" + write(interval->low, 2) + " to " + write(interval->high, 2) + ")";
}

// By row: both truths, each with its interval, and the differences to the row's reference.
std::string compose_truths_markdown(const std::vector<MeasuredRow>& rows) {
  std::string text =
      "| | plane % (95 %) | dish % (95 %) | beside | d plane (95 %) | d dish (95 %) | shared |\n"
      "| --- | ---: | ---: | --- | ---: | ---: | ---: |\n";
  for (const MeasuredRow& row : rows) {
    const auto& [plane, dish] = row.figures.by_truth;
    text += "| " + row.row.title;
    for (const TruthFigures* own : {&plane, &dish})
      text += " | " + with_interval(cell(own->mape, 2), own->interval, cell);
    text += " | " + (row.row.reference.empty() ? kNoValue : row.row.reference);
    for (const TruthFigures* own : {&plane, &dish})
      text +=
          " | " + with_interval(signed_cell(own->difference.mape, 2), own->difference.interval, signed_cell);
    text += " | " + shared_cell(row.figures) + " |\n";
  }
  return text;
}

// The same for a terminal; rows with one reference stand together.
std::string compose_truths_text(const std::vector<MeasuredRow>& rows) {
  std::string text;
  const std::string* reference = nullptr;
  for (const MeasuredRow& row : rows) {
    if (reference == nullptr || *reference != row.row.reference) {
      reference = &row.row.reference;
      text += reference->empty() ? "Against both truths\n"
                                 : "Against both truths, and the difference (95 %) to \"" + *reference +
                                       "\" on the items that both measured\n";
      text += table_row("", kTitleWidth, {kTruthHeadings.begin(), kTruthHeadings.end()}, kColumnWidth);
    }
    text += table_row(row.row.title, kTitleWidth, truth_cells(row.figures), kColumnWidth);
  }
  return text;
}

}  // namespace

std::vector<PairRuns> runs_of(const Row& row, const std::filesystem::path& set,
                              const std::vector<PairRuns>& runs) {
  std::vector<PairRuns> own;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(own),
               [&](const PairRuns& pair) { return belongs(row, set, pair); });
  return own;
}

RowFigures figures_of(const Row& row, const std::vector<PairRuns>& runs,
                      const std::vector<PairRuns>& reference) {
  RowFigures figures;
  figures.time_s = mean_time_s(runs);
  figures.pairs = static_cast<int>(runs.size());
  std::array<std::vector<ItemSeries>, kRowTruths.size()> series;
  for (std::size_t i = 0; i < kRowTruths.size(); ++i) {
    series[i] = collect_series(runs, kRowTruths[i], false);
    figures.by_truth[i] = {set_figures(series[i]).mape, mape_interval(series[i]),
                           compare(runs, reference, kRowTruths[i])};
  }
  const bool is_flat = abilities_of(row.variant.profile).takes_dish_for_flat;
  figures.foods = set_figures(is_flat && !series[0].empty() ? series[0] : series[1]);
  return figures;
}

std::string compose_text(const Table& table, const std::vector<MeasuredRow>& rows) {
  std::string text = table.title + "\n";
  text += table_row("", kTitleWidth, {kHeadings.begin(), kHeadings.end()}, kColumnWidth);
  for (const MeasuredRow& row : rows) {
    const auto cells = cells_of(row);
    text += table_row(row.row.title, kTitleWidth, {cells.begin(), cells.end()}, kColumnWidth);
  }
  return text + compose_truths_text(rows);
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
  return text + "\n" + compose_truths_markdown(rows) + "\n";
}

}  // namespace traygauge::tables
