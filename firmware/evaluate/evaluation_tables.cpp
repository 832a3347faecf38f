// The terminal report: captures, stages, items, angles, then the figures over all, so that these stand next
// to the prompt.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "firmware/base/text.hpp"
#include "firmware/evaluate/evaluation.hpp"
#include "firmware/evaluate/table_cells.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kFigureWidth = 28;  // names of the figures over all
constexpr std::size_t kGroupWidth = 18;   // four groups fit 100 columns
constexpr std::size_t kMaxItemRows = 40;

std::string capture_row(const CaptureEvaluation& capture) {
  const SetFigures& foods = capture.foods;
  return table_row(capture.capture, kNameWidth,
                   {std::to_string(foods.items_tried), std::to_string(foods.estimates),
                    std::to_string(foods.refused), cell(foods.mape, 2), signed_cell(foods.bias, 2),
                    cell(foods.cv, 2), cell(foods.cv_seeds, 2), signed_cell(foods.worst, 1)},
                   kCellWidth);
}

std::string capture_table(const Evaluation& evaluation) {
  std::string text = table_row(
      "height-field foods", kNameWidth,
      {"items", "volumes", "refused", "MAPE %", "bias %", "CV %", "seeds CV", "worst %"}, kCellWidth);
  for (const CaptureEvaluation& capture : evaluation.captures) text += capture_row(capture);
  return text + capture_row(evaluation.all) + "\n";
}

std::string stage_row(const CaptureEvaluation& capture) {
  const StageFigures& stages = capture.stages;
  return table_row(
      capture.capture, kNameWidth,
      {cell(stages.rotation_deg, 3), cell(stages.direction_deg, 3), cell(stages.scale_percent, 2),
       cell(stages.table_tilt_deg, 3), signed_cell(stages.table_offset_mm, 2),
       cell(stages.bottom_tilt_deg, 3), signed_cell(stages.bottom_offset_mm, 2), cell(stages.time_ms, 0)},
      kCellWidth);
}

std::string stage_table(const Evaluation& evaluation) {
  if (std::isnan(evaluation.all.stages.rotation_deg)) return "";
  std::string text =
      table_row("median errors", kNameWidth,
                {"rotation", "motion", "scale", "table", "table", "bottom", "bottom", "time"}, kCellWidth);
  text += table_row("", kNameWidth, {"deg", "deg", "%", "deg", "mm", "deg", "mm", "ms"}, kCellWidth);
  for (const CaptureEvaluation& capture : evaluation.captures) text += stage_row(capture);
  return text + stage_row(evaluation.all) + "\n";
}

std::string item_row(const ItemEvaluation& item) {
  const ItemFigures& figures = item.figures;
  constexpr std::size_t food_width = 16;
  const std::string food = item.series.name + (item.series.overhangs ? " *" : "");
  std::string text = pad_right(shorten(item.series.capture, kNameWidth - 1), kNameWidth);
  return text +
         table_row(food, food_width,
                   {cell(item.series.truth_ml, 1), cell(figures.mean_ml, 1), std::to_string(figures.refused),
                    cell(figures.mape, 2), signed_cell(figures.bias, 2), cell(figures.cv, 2),
                    cell(item.sigma.median_relative_sigma, 2)},
                   kCellWidth);
}

// Every item, or the worst where there are many.
std::string item_table(const Evaluation& evaluation) {
  std::vector<ItemEvaluation> items = evaluation.items;
  if (items.empty()) return "";
  const bool is_cut = items.size() > kMaxItemRows;
  if (is_cut) {
    std::stable_sort(items.begin(), items.end(), [](const ItemEvaluation& a, const ItemEvaluation& b) {
      const auto badness = [](const ItemEvaluation& item) {
        return std::isnan(item.figures.mape) ? HUGE_VAL : item.figures.mape;
      };
      return badness(a) > badness(b);
    });
    items.resize(kMaxItemRows);
  }
  std::string text =
      pad_right("capture", kNameWidth) +
      table_row("item", 16, {"true ml", "mean ml", "refused", "MAPE %", "bias %", "CV %", "sigma %"},
                kCellWidth);
  bool has_fruit = false;
  for (const ItemEvaluation& item : items) {
    text += item_row(item);
    has_fruit = has_fruit || item.series.overhangs;
  }
  if (has_fruit) text += "* scanned fruit: closed volume\n";
  if (is_cut)
    text += "the " + std::to_string(kMaxItemRows) + " worst of " + std::to_string(evaluation.items.size()) +
            " items; all of them: items.csv (--out)\n";
  return text + "\n";
}

std::string angle_row(const AngleEvaluation& angle) {
  const SetFigures& foods = angle.foods;
  return table_row(angle.title, kNameWidth,
                   {std::to_string(angle.pairs), std::to_string(foods.estimates),
                    std::to_string(foods.refused), cell(foods.mape, 2), signed_cell(foods.bias, 2),
                    cell(foods.cv_seeds, 2), cell(foods.within_10, 1), signed_cell(foods.worst, 1)},
                   kCellWidth);
}

std::string angle_table(const Evaluation& evaluation) {
  if (evaluation.angles.empty()) return "";
  std::string text = table_row(
      "relative angle", kNameWidth,
      {"pairs", "volumes", "refused", "MAPE %", "bias %", "seeds CV", "in 10 %", "worst %"}, kCellWidth);
  for (const AngleEvaluation& angle : evaluation.angles) text += angle_row(angle);
  if (evaluation.optimal_angles) text += angle_row(*evaluation.optimal_angles);
  return text + "\n";
}

std::string percent(double value, int decimals) {
  return std::isnan(value) ? kNoValue : fixed(value, decimals) + " %";
}

std::string signed_percent(double value, int decimals) {
  return std::isnan(value) ? kNoValue : signed_cell(value, decimals) + " %";
}

std::string signed_range(double low, double high, int decimals) {
  return std::isnan(low) ? kNoValue : signed_cell(low, decimals) + " to " + signed_percent(high, decimals);
}

std::string range(const std::optional<ConfidenceInterval>& interval, int decimals) {
  return interval ? fixed(interval->low, decimals) + " to " + percent(interval->high, decimals) : kNoValue;
}

std::string thirds(const std::array<double, 3>& shares) {
  return cell(shares[0], 0) + ", " + cell(shares[1], 0) + ", " + percent(shares[2], 0);
}

// One figure over all, a column a group.
using FigureCell = std::function<std::string(const GroupEvaluation&)>;
using FigureRow = std::function<std::string(const char*, const FigureCell&)>;

std::string accuracy_rows(const FigureRow& line) {
  using Group = const GroupEvaluation&;
  std::string text;
  text += line("items", [](Group g) {
    const SetFigures& f = g.figures;
    return std::to_string(f.items) + (f.items < f.items_tried ? " of " + std::to_string(f.items_tried) : "");
  });
  text += line("volumes", [](Group g) { return std::to_string(g.figures.estimates); });
  text += line("refused", [](Group g) {
    return std::to_string(g.figures.refused) + " (" + percent(g.figures.refused_fraction, 1) + ")";
  });
  text += line("MAPE", [](Group g) { return percent(g.figures.mape, 2); });
  text += line("  95 % interval", [](Group g) { return range(g.mape_interval, 2); });
  text +=
      line("  a refusal as 100 % error", [](Group g) { return percent(g.figures.mape_refusals_as_100, 2); });
  text += line("PMAE", [](Group g) { return percent(g.figures.pmae, 2); });
  text += line("bias", [](Group g) { return signed_percent(g.figures.bias, 2); });
  text += line("  95 % interval", [](Group g) {
    return g.bias_interval ? signed_range(g.bias_interval->low, g.bias_interval->high, 2) : kNoValue;
  });
  text += line("95 % limits of agreement",
               [](Group g) { return signed_range(g.figures.limit_low, g.figures.limit_high, 1); });
  text += line("within 10 %", [](Group g) { return percent(g.figures.within_10, 1); });
  text += line("within 20 %", [](Group g) { return percent(g.figures.within_20, 1); });
  text += line("  beyond, without a warning", [](Group g) {
    return std::to_string(g.figures.beyond_20_unwarned) + " of " + std::to_string(g.figures.beyond_20);
  });
  text += line("worst", [](Group g) { return signed_percent(g.figures.worst, 1); });
  text += line("CV over pairs and seeds", [](Group g) { return percent(g.figures.cv, 2); });
  text += line("  items below 1.5 %", [](Group g) { return percent(g.figures.cv_below_1_5, 1); });
  text += line("  items below 10 %", [](Group g) { return percent(g.figures.cv_below_10, 1); });
  text += line("CV over the seeds of a pair", [](Group g) { return percent(g.figures.cv_seeds, 2); });
  return text;
}

std::string sigma_rows(const FigureRow& line, bool is_estimated) {
  using Group = const GroupEvaluation&;
  std::string text = line("truth within two sigma", [&](Group g) -> std::string {
    if (!is_estimated) return "not estimated";
    return percent(g.sigma.coverage, 1);
  });
  if (!is_estimated) return text;
  const auto stated = [&](const char* title, const std::function<std::string(const SigmaFigures&)>& value) {
    return line(title, [&](Group g) { return g.sigma.is_estimated ? value(g.sigma) : kNoValue; });
  };
  using Sigma = const SigmaFigures&;
  text += line("  95 % interval", [](Group g) { return range(g.coverage_interval, 1); });
  text += stated("  by thirds of sigma", [](Sigma s) { return thirds(s.coverage_by_thirds); });
  text +=
      stated("  by thirds of sigma/volume", [](Sigma s) { return thirds(s.coverage_by_relative_thirds); });
  text += stated("  volumes without sigma", [](Sigma s) { return std::to_string(s.without_sigma); });
  text += stated("median sigma/volume", [](Sigma s) { return percent(s.median_relative_sigma, 2); });
  text += stated("rank correlation with error", [](Sigma s) { return cell(s.rank_correlation, 2); });
  text += stated("  both over the volume", [](Sigma s) { return cell(s.relative_rank_correlation, 2); });
  return text;
}

std::string summary_table(const Evaluation& evaluation) {
  bool is_sigma_estimated = false;
  const auto line = [&](const char* title, const FigureCell& value) {
    std::vector<std::string> cells;
    cells.reserve(evaluation.groups.size());
    for (const GroupEvaluation& group : evaluation.groups) cells.push_back(value(group));
    return table_row(title, kFigureWidth, cells, kGroupWidth);
  };
  for (const GroupEvaluation& group : evaluation.groups)
    is_sigma_estimated = is_sigma_estimated || group.sigma.is_estimated;
  std::string text = line("all captures", [](const GroupEvaluation& group) { return group.title; });
  return text + accuracy_rows(line) + sigma_rows(line, is_sigma_estimated);
}

std::string notes(const Evaluation& evaluation) {
  std::string text;
  for (const GroupEvaluation& group : evaluation.groups) {
    if (group.key == "foods_above_bottom_plane")
      text +=
          "flat dish: the truth is what lies above the plane of the dish's bottom, as this profile "
          "measures\n";
    if (group.key == "fruit_column")
      text += "closed: the whole fruit; column: what lies under its upper surface\n";
  }
  text += "intervals: bootstrap over " + std::to_string(evaluation.captures.size()) + " captures\n";
  if (evaluation.items_without_volume > 0)
    text +=
        "left out: " + std::to_string(evaluation.items_without_volume) + " items whose true volume is 0\n";
  return text;
}

std::string list(const std::string& title, const std::vector<std::string>& lines) {
  std::string text = lines.empty() ? "" : "\n" + title + "\n";
  for (const std::string& line : lines) text += "  " + printable(line) + "\n";
  return text;
}

}  // namespace

std::string compose_tables(const Evaluation& evaluation) {
  std::string text = "profile " + evaluation.profile + ", " + std::to_string(evaluation.captures.size()) +
                     " captures (" + std::to_string(evaluation.skipped.size()) + " skipped), " +
                     std::to_string(evaluation.pairs) + " pairs, " + std::to_string(evaluation.seeds) +
                     " seeds each, " + std::to_string(evaluation.measurements) + " measurements\n\n";
  if (evaluation.measurements > 0) {
    text += compose_outline_table(evaluation.outlines) + capture_table(evaluation) + stage_table(evaluation) +
            item_table(evaluation) + angle_table(evaluation) + summary_table(evaluation) + notes(evaluation);
  }
  std::vector<std::string> refusals;
  refusals.reserve(evaluation.refusals.size());
  for (const auto& [cause, count] : evaluation.refusals)
    refusals.push_back(cause + " in " + std::to_string(count) + " measurements");
  return text + list("refused", refusals) + list("skipped", evaluation.skipped);
}

}  // namespace traygauge
