// What run_stages() found, for the terminal and for spreadsheets.
#include <sstream>

#include "firmware/base/csv_fields.hpp"
#include "firmware/base/text.hpp"
#include "firmware/evaluate/stage_analysis.hpp"
#include "firmware/evaluate/table_cells.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kFoodWidth = 16;

std::string losses_row(const StageLosses& losses) {
  std::vector<std::string> cells;
  for (const double mape : losses.mape) cells.push_back(cell(mape, 2));
  return table_row(losses.capture, kNameWidth, cells, kCellWidth);
}

std::string bias_row(const StageLosses& losses) {
  std::vector<std::string> cells;
  for (const double bias : losses.bias) cells.push_back(signed_cell(bias, 2));
  return table_row("all, bias", kNameWidth, cells, kCellWidth);
}

}  // namespace

std::string compose_stage_tables(const StageAnalysis& analysis) {
  std::string text = pad_right("heights", kNameWidth) +
                     table_row("item", kFoodWidth, {"matched %", "median mm", "95 % mm", "bias mm"}, 11);
  for (const LabelHeights& heights : analysis.heights) {
    text += pad_right(shorten(heights.capture, kNameWidth - 1), kNameWidth) +
            table_row(heights.name, kFoodWidth,
                      {cell(heights.matched_percent, 1), cell(heights.median_mm, 2), cell(heights.p95_mm, 2),
                       signed_cell(heights.bias_mm, 2)},
                      11);
  }
  std::vector<std::string> titles;
  for (const StageVariant& variant : stage_variants()) titles.emplace_back(variant.title);
  text += '\n';
  text += table_row("MAPE %, with true", kNameWidth, titles, kCellWidth);
  for (const StageLosses& losses : analysis.losses) text += losses_row(losses);
  text += losses_row(analysis.all) + bias_row(analysis.all);
  return text + "surface: as far as view 0 of the capture sees it; seed 1\n\n";
}

std::string compose_stages_csv(const StageRuns& runs) {
  std::ostringstream csv;
  csv << "capture,first,second,label,name,kind,truth_ml";
  for (const StageVariant& variant : stage_variants()) csv << ',' << variant.key << "_ml";
  csv << '\n';
  const std::vector<PairRuns>& pairs = runs.variants.front();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (const TruthItem& item : pairs[i].truth.items) {
      csv << csv_field(pairs[i].capture) << ',' << pairs[i].pair[0] << ',' << pairs[i].pair[1] << ','
          << item.label << ',' << csv_field(item.name) << ',' << csv_field(item.kind) << ','
          << fixed(item.volume_ml, 3);
      for (const std::vector<PairRuns>& variant : runs.variants) {
        const ItemEstimate* estimate =
            variant[i].runs.empty() ? nullptr : estimate_of(variant[i].runs.front(), item.label);
        csv << ',' << (estimate != nullptr ? fixed(estimate->volume_ml, 3) : "");
      }
      csv << '\n';
    }
  }
  return csv.str();
}

std::string compose_heights_csv(const StageAnalysis& analysis) {
  std::ostringstream csv;
  csv << "capture,label,name,matched_percent,median_mm,p95_mm,bias_mm\n";
  for (const LabelHeights& heights : analysis.heights) {
    csv << csv_field(heights.capture) << ',' << heights.label << ',' << csv_field(heights.name) << ','
        << csv_number(heights.matched_percent, 1) << ',' << csv_number(heights.median_mm, 3) << ','
        << csv_number(heights.p95_mm, 3) << ',' << csv_number(heights.bias_mm, 3) << '\n';
  }
  return csv.str();
}

}  // namespace traygauge
