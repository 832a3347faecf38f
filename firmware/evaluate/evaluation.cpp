#include "firmware/evaluate/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kNameWidth = 20;
constexpr std::size_t kColumnWidth = 9;

std::optional<double> truth_volume(const TruthItem& item, TruthVolume kind) {
  if (kind == TruthVolume::above_bottom_plane) return item.volume_above_bottom_plane_ml;
  if (kind == TruthVolume::column) return item.column_volume_ml;
  return item.volume_ml;
}

template <class Value>
double median_error(const std::vector<PairRuns>& runs, Value&& value) {
  std::vector<double> values;
  for (const PairRuns& pair : runs) {
    for (const Run& run : pair.runs) {
      if (run.errors) values.push_back(value(*run.errors));
    }
  }
  return median(std::move(values));
}

double median_time_ms(const std::vector<PairRuns>& runs) {
  std::vector<double> times;
  for (const PairRuns& pair : runs) {
    for (const Run& run : pair.runs) times.push_back(run.total_ms);
  }
  return median(std::move(times));
}

std::string header() {
  std::string text = pad_right("capture", kNameWidth);
  for (const char* column : {"items", "runs", "refused", "MAPE", "bias", "CV", "MAPE*", "bias*", "rot deg",
                             "dir deg", "scale %", "tilt deg", "bottom mm", "ms"}) {
    text += pad_left(column, kColumnWidth);
  }
  return text + "\n";
}

std::string row(const std::string& name, const std::vector<PairRuns>& runs) {
  const SetFigures plane = set_figures(collect_series(runs, TruthVolume::above_bottom_plane, false));
  const SetFigures dish = set_figures(collect_series(runs, TruthVolume::above_dish, false));
  const auto absolute = [&](double StageErrors::*member) {
    return median_error(runs, [&](const StageErrors& errors) { return std::abs(errors.*member); });
  };
  std::string text = pad_right(name, kNameWidth);
  const auto cell = [&](const std::string& value) { text += pad_left(value, kColumnWidth); };
  cell(std::to_string(plane.items));
  cell(std::to_string(plane.estimates));
  cell(std::to_string(plane.refused));
  cell(fixed(plane.mape, 2));
  cell(fixed(plane.bias, 2));
  cell(fixed(plane.cv, 2));
  cell(fixed(dish.mape, 2));
  cell(fixed(dish.bias, 2));
  cell(fixed(absolute(&StageErrors::rotation_deg), 3));
  cell(fixed(absolute(&StageErrors::direction_deg), 3));
  cell(fixed(absolute(&StageErrors::scale_percent), 2));
  cell(fixed(absolute(&StageErrors::bottom_tilt_deg), 3));
  cell(fixed(median_error(runs, [](const StageErrors& errors) { return errors.bottom_offset_mm; }), 2));
  cell(fixed(median_time_ms(runs), 0));
  return text + "\n";
}

std::string summary(const std::string& title, const SetFigures& figures) {
  std::ostringstream text;
  text << title << "\n  MAPE " << fixed(figures.mape, 2) << " %, with refusals as 100 % "
       << fixed(figures.mape_refusals_as_100, 2) << " %; PMAE " << fixed(figures.pmae, 2) << " %; bias "
       << fixed(figures.bias, 2) << " %, 95 % limits of agreement " << fixed(figures.limit_low, 1) << " to "
       << fixed(figures.limit_high, 1) << " %\n  CV " << fixed(figures.cv, 2) << " %; within 10 % "
       << fixed(figures.within_10, 1) << " %, within 20 % " << fixed(figures.within_20, 1) << " %, worst "
       << fixed(figures.worst, 1) << " %; " << figures.items << " items, " << figures.estimates
       << " estimates, " << figures.refused << " refused\n";
  return text.str();
}

std::string refusals(const std::vector<PairRuns>& runs) {
  std::map<std::string, int> causes;
  for (const PairRuns& pair : runs) {
    for (const Run& run : pair.runs) {
      if (run.status != StatusCode::ok && run.status != StatusCode::partial)
        ++causes[pair.capture + ": " + name(run.status)];
      for (const ItemEstimate& item : run.items) {
        if (item.status != StatusCode::ok) {
          ++causes[pair.capture + ": item " + std::to_string(item.label) + " " + name(item.status)];
        }
      }
    }
  }
  std::string text;
  for (const auto& [cause, count] : causes) text += "  " + cause + " in " + std::to_string(count) + " runs\n";
  return text.empty() ? text : "refused\n" + text;
}

}  // namespace

std::vector<ItemSeries> collect_series(const std::vector<PairRuns>& runs, TruthVolume truth,
                                       bool overhanging) {
  std::map<std::pair<std::string, int>, ItemSeries> series;
  for (const PairRuns& pair : runs) {
    for (const TruthItem& item : pair.truth.items) {
      const auto volume = truth_volume(item, truth);
      const bool overhangs = item.kind == "scan";
      if (!volume || overhangs != overhanging) continue;
      ItemSeries& own = series[{pair.capture, item.label}];
      own.capture = pair.capture;
      own.label = item.label;
      own.name = item.name;
      own.overhangs = overhangs;
      own.truth_ml = *volume;
      for (const Run& run : pair.runs) {
        if (const auto estimate = estimate_of(run, item.label)) {
          own.estimates_ml.push_back(*estimate);
        } else {
          ++own.refusals;
        }
      }
    }
  }
  std::vector<ItemSeries> list;
  list.reserve(series.size());
  for (auto& [key, own] : series) list.push_back(std::move(own));
  return list;
}

std::string compose_evaluation(const std::vector<PairRuns>& runs) {
  std::map<std::string, std::vector<PairRuns>> by_capture;
  for (const PairRuns& pair : runs) by_capture[pair.capture].push_back(pair);
  std::string text = header();
  for (const auto& [capture, own] : by_capture) text += row(capture, own);
  text += row("all", runs);
  text +=
      "MAPE, bias, CV: height-field foods against the volume above the bottom's plane; *: above the dish's "
      "own "
      "surface\n\n";
  text += summary("height-field foods, above the bottom's plane",
                  set_figures(collect_series(runs, TruthVolume::above_bottom_plane, false)));
  text += summary("height-field foods, above the dish",
                  set_figures(collect_series(runs, TruthVolume::above_dish, false)));
  const auto fruit = collect_series(runs, TruthVolume::column, true);
  if (!fruit.empty()) {
    text += summary("scanned fruit, what lies under its upper surface", set_figures(fruit));
    text += summary("scanned fruit, closed volume",
                    set_figures(collect_series(runs, TruthVolume::above_dish, true)));
  }
  return text + refusals(runs);
}

}  // namespace traygauge
