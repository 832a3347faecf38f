#include "firmware/evaluate/outline_figures.hpp"

#include <cmath>

#include "firmware/base/csv_fields.hpp"
#include "firmware/base/percent.hpp"
#include "firmware/base/text.hpp"
#include "firmware/evaluate/protocol.hpp"
#include "firmware/evaluate/statistics.hpp"
#include "firmware/evaluate/table_cells.hpp"

namespace traygauge {
namespace {

struct CollectedOutlines {
  std::vector<double> food_iou;
  std::vector<double> item_iou;
  std::vector<double> card_iou;
  std::vector<double> axes_error_percent;
  std::vector<double> right_count_percent;
  std::vector<double> all_food_percent;
  std::vector<double> time_ms;
  int pairs = 0;

  void add(const PairRuns& pair) {
    if (!pair.outlines) return;
    ++pairs;
    time_ms.push_back(pair.outlines->time_ms);
    for (const LabelScores& view : pair.outlines->views) {
      food_iou.push_back(view.food_iou);
      card_iou.push_back(view.card_iou);
      right_count_percent.push_back(view.has_right_count() ? kPercent : 0.0);
      for (const ItemScore& item : view.items) item_iou.push_back(item.iou);
      for (const DishScore& dish : view.dishes) axes_error_percent.push_back(kPercent * dish.axes_error);
    }
    double true_ml = 0.0;
    for (const TruthItem& item : pair.truth.items) true_ml += item.column_volume_ml.value_or(item.volume_ml);
    for (const Run& run : pair.runs) {
      if (true_ml > 0.0) all_food_percent.push_back(kPercent * std::abs(run.all_food_ml / true_ml - 1.0));
    }
  }

  OutlineFigures figures(const std::string& name) const {
    return {name,
            pairs,
            mean(food_iou),
            mean(item_iou),
            mean(card_iou),
            median(axes_error_percent),
            mean(right_count_percent),
            mean(all_food_percent),
            median(time_ms)};
  }
};

}  // namespace

std::vector<OutlineFigures> summarise_outlines(const std::vector<PairRuns>& runs) {
  std::vector<OutlineFigures> figures;
  CollectedOutlines all;
  for (std::size_t i = 0; i < runs.size();) {
    CollectedOutlines capture;
    const std::string& name = runs[i].capture;
    for (; i < runs.size() && runs[i].capture == name; ++i) {
      capture.add(runs[i]);
      all.add(runs[i]);
    }
    if (capture.pairs > 0) figures.push_back(capture.figures(name));
  }
  if (!figures.empty()) figures.push_back(all.figures("all"));
  return figures;
}

std::string compose_outline_table(const std::vector<OutlineFigures>& figures) {
  if (figures.empty()) return "";
  std::string text = table_row(
      "outlines", kNameWidth,
      {"pairs", "food IoU", "item IoU", "card IoU", "axes %", "count %", "all ml %", "ms"}, kCellWidth);
  for (const OutlineFigures& row : figures) {
    text += table_row(row.capture, kNameWidth,
                      {std::to_string(row.pairs), cell(row.food_iou, 3), cell(row.item_iou, 3),
                       cell(row.card_iou, 3), cell(row.axes_error_percent, 2),
                       cell(row.right_count_percent, 0), cell(row.all_food_percent, 1), cell(row.time_ms, 0)},
                      kCellWidth);
  }
  return text +
         "food and item IoU: intersection over union with the given labels, items with the best each; axes: "
         "of\n"
         "the dishes' ellipses, median error; count: views with the right number of items; all ml: error of "
         "all\n"
         "food together\n\n";
}

std::string compose_outlines_csv(const std::vector<PairRuns>& runs) {
  std::string text = "capture,view,status,kind,label,found,iou,axes_error\n";
  for (const PairRuns& pair : runs) {
    if (!pair.outlines) continue;
    for (std::size_t v = 0; v < 2; ++v) {
      const LabelScores& scores = pair.outlines->views[v];
      const std::string begin =
          csv_field(pair.capture) + ',' + std::to_string(pair.pair[v]) + ',' + pair.outlines->status + ',';
      text += begin + "food,,," + fixed(scores.food_iou, 4) + ",\n";
      text += begin + "card,255,," + fixed(scores.card_iou, 4) + ",\n";
      for (const ItemScore& item : scores.items) {
        text += begin + "item," + std::to_string(item.label) + ',' + std::to_string(item.found) + ',' +
                fixed(item.iou, 4) + ",\n";
      }
      for (const DishScore& dish : scores.dishes)
        text += begin + "dish," + std::to_string(dish.label) + ",,," + fixed(dish.axes_error, 5) + "\n";
    }
  }
  return text;
}

}  // namespace traygauge
