#include "firmware/evaluate/evaluation_plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "firmware/base/text.hpp"
#include "firmware/evaluate/statistics.hpp"
#include "firmware/plot/chart.hpp"

namespace traygauge {
namespace {

constexpr double kMaxErrorShown = 50.0;  // per cent; what lies beyond is drawn at the edge and counted
constexpr double kMinErrorShown = 5.0;
constexpr double kOutlierFactor = 1.5;
constexpr double kMinVariationShown = 2.0;
constexpr double kMaxVariationShown = 30.0;
constexpr std::size_t kManyMarks = 500;
constexpr double kBinsWanted = 40.0;
constexpr double kMaxFactorShown = 1.15;  // beyond the range of the true volumes
constexpr const char* kNoData = "No data: no volume was measured.";
constexpr Stroke kZeroLine{kBlack, 1.2, ""};
constexpr Stroke kMeanLine{kOrange, 2.0, "7 4"};
constexpr Stroke kLimitLine{kOrange, 1.2, "2 3"};

const std::vector<ItemSeries>& foods(const Evaluation& evaluation) {
  return evaluation.groups.front().items;
}

std::vector<double> signed_errors(const std::vector<ItemSeries>& items) {
  std::vector<double> errors;
  for (const ItemSeries& item : items) {
    for (const Attempt& attempt : item.attempts) {
      if (attempt.is_measured) errors.push_back(signed_error_percent(attempt.volume_ml, item.truth_ml));
    }
  }
  return errors;
}

// The largest absolute value, but not far beyond that of 99 % of the values: a few outliers would squeeze
// everything else into the middle. Between `least` and `most`.
double span_of(const std::vector<double>& values, double least, double most) {
  std::vector<double> sizes;
  sizes.reserve(values.size());
  for (const double value : values) sizes.push_back(std::abs(value));
  const double largest = quantile(sizes, 1.0);
  return std::clamp(std::min(largest, kOutlierFactor * quantile(sizes, 0.99)), least, most);
}

std::string signed_text(double value, int decimals) {
  std::string text = value < 0.0 ? "\u2212" : "+";
  text += fixed(std::abs(value), decimals);
  return text;
}

std::string count(std::size_t number, const char* what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

// Behind the title of the axis that cannot hold them.
std::string note_beyond(std::int64_t number, const char* what, double limit) {
  if (number == 0) return "";
  return "; " + count(static_cast<std::size_t>(number), what) + " beyond " + fixed(limit, 0) +
         " %, drawn at the edge";
}

// Mean over the seeds of one pair.
struct PairMean {
  double angle_deg = 0.0;
  double volume_ml = 0.0;
};

std::vector<PairMean> means_by_pair(const ItemSeries& item) {
  std::map<int, std::vector<double>> volumes;
  std::map<int, double> angles;
  for (const Attempt& attempt : item.attempts) {
    if (!attempt.is_measured) continue;
    volumes[attempt.pair].push_back(attempt.volume_ml);
    angles[attempt.pair] = attempt.angle_deg;
  }
  std::vector<PairMean> means;
  means.reserve(volumes.size());
  for (const auto& [pair, own] : volumes) means.push_back({angles[pair], mean(own)});
  return means;
}

std::vector<DataPoint> errors_by_angle(const std::vector<ItemSeries>& items) {
  std::vector<DataPoint> points;
  for (const ItemSeries& item : items) {
    for (const PairMean& pair : means_by_pair(item)) {
      if (std::isnan(pair.angle_deg)) continue;
      points.push_back({pair.angle_deg, signed_error_percent(pair.volume_ml, item.truth_ml)});
    }
  }
  return points;
}

std::vector<DataPoint> volumes_by_truth(const Evaluation& evaluation, bool overhanging) {
  std::vector<DataPoint> points;
  for (const ItemEvaluation& item : evaluation.items) {
    if (item.series.overhangs != overhanging) continue;
    for (const PairMean& pair : means_by_pair(item.series))
      points.push_back({item.series.truth_ml, pair.volume_ml});
  }
  return points;
}

// Means of the bins of relative angle, at the middle of the bin.
std::vector<DataPoint> bin_means(const Evaluation& evaluation, double SetFigures::*figure) {
  std::vector<DataPoint> points;
  for (const AngleEvaluation& bin : evaluation.angles) {
    const double value = bin.foods.*figure;
    if (!std::isnan(value)) points.push_back({0.5 * (bin.low_deg + bin.high_deg), value});
  }
  return points;
}

Axis symmetric_axis(const std::string& title, double span) {
  const Axis half = make_axis(title, 0.0, span, 5);
  return make_axis(title, -half.high, half.high, 10);
}

// Shares of all values; those beyond the axis are counted again in the bins at its ends.
Histogram bin_shares(const std::vector<double>& values, const Axis& x) {
  Histogram histogram = make_histogram(values, x.low, x.high, round_step((x.high - x.low) / kBinsWanted));
  histogram.counts.front() += histogram.below;
  histogram.counts.back() += histogram.above;
  return histogram;
}

// Many marks show where they lie dense.
double opacity_of(std::size_t marks) {
  return marks > kManyMarks ? 0.2 : 0.5;
}

}  // namespace

std::string plot_signed_errors(const Evaluation& evaluation) {
  const std::string title = "Signed error of the volumes";
  const std::vector<double> errors = signed_errors(foods(evaluation));
  if (errors.empty()) return compose_empty_chart(title, kNoData);
  const SetFigures& figures = evaluation.groups.front().figures;
  Axis x = symmetric_axis("signed error (%)", span_of(errors, kMinErrorShown, kMaxErrorShown));
  const Histogram histogram = bin_shares(errors, x);
  x.title += note_beyond(histogram.below + histogram.above, "volume", x.high);
  Chart chart(title,
              count(errors.size(), "volume") + " of " +
                  count(static_cast<std::size_t>(figures.items), "item") + ": bias " +
                  signed_text(figures.bias, 2) + " %, MAPE " + fixed(figures.mape, 2) + " %, " +
                  fixed(figures.within_10, 1) + " % within ±10 %",
              x, make_axis("share of the volumes (%)", 0.0, histogram.largest_share_percent(), 5));
  if (x.high > 10.0) chart.shade_x(-10.0, 10.0, "within ±10 %");
  chart.bars(histogram, kBlue);
  chart.vertical(0.0, kZeroLine, "");
  chart.vertical(figures.bias, kMeanLine, "bias");
  chart.vertical(figures.limit_low, kLimitLine, "95 % limits of agreement");
  chart.vertical(figures.limit_high, kLimitLine, "");
  return chart.str();
}

std::string plot_variation(const Evaluation& evaluation) {
  const std::string title = "Repeatability: coefficient of variation of each item";
  std::vector<double> variations;
  for (const ItemSeries& item : foods(evaluation)) {
    const double cv = item_figures(item).cv;
    if (!std::isnan(cv)) variations.push_back(cv);
  }
  if (variations.empty()) return compose_empty_chart(title, "No data: no item has two volumes to compare.");
  const SetFigures& figures = evaluation.groups.front().figures;
  Axis x = make_axis("coefficient of variation over pairs and seeds (%)", 0.0,
                     span_of(variations, kMinVariationShown, kMaxVariationShown), 8);
  const Histogram histogram = bin_shares(variations, x);
  x.title += note_beyond(histogram.above, "item", x.high);
  Chart chart(title,
              count(variations.size(), "item") + ": mean " + fixed(figures.cv, 2) + " %, " +
                  fixed(figures.cv_below_1_5, 1) + " % below 1.5 %, " + fixed(figures.cv_below_10, 1) +
                  " % below 10 %",
              x, make_axis("share of the items (%)", 0.0, histogram.largest_share_percent(), 5));
  chart.bars(histogram, kBlue);
  chart.vertical(figures.cv, kMeanLine, "mean");
  return chart.str();
}

std::string plot_error_by_angle(const Evaluation& evaluation) {
  const std::string title = "Error against the relative angle between the views";
  const std::vector<DataPoint> points = errors_by_angle(foods(evaluation));
  if (points.empty()) return compose_empty_chart(title, kNoData);
  std::vector<double> errors;
  double largest_angle = 0.0;
  for (const DataPoint& point : points) {
    errors.push_back(point.y);
    largest_angle = std::max(largest_angle, point.x);
  }
  const Axis y = symmetric_axis("error (%)", span_of(errors, kMinErrorShown, kMaxErrorShown));
  Axis x = make_axis("relative angle (degrees)", 0.0, largest_angle + 1.0, 8);
  x.title +=
      note_beyond(std::count_if(errors.begin(), errors.end(), [&](double e) { return std::abs(e) > y.high; }),
                  "dot", y.high);
  Chart chart(title, count(points.size(), "dot") + ": an item of a pair, mean over seeds; lines: bins of 5°",
              x, y);
  if (y.high > 10.0) chart.shade_y(-10.0, 10.0, "within ±10 %");
  chart.horizontal(0.0, kZeroLine, "");
  chart.markers(points, {Marker::dot, kBlue, 3.5, opacity_of(points.size())}, "signed error of an item");
  const std::vector<DataPoint> mape = bin_means(evaluation, &SetFigures::mape);
  const std::vector<DataPoint> bias = bin_means(evaluation, &SetFigures::bias);
  chart.line(mape, {kOrange, 2.2, ""}, "MAPE");
  chart.markers(mape, {Marker::square, kOrange, 3.5, 1.0}, "");
  chart.line(bias, {kBlack, 1.8, "7 4"}, "bias");
  return chart.str();
}

std::string plot_volumes(const Evaluation& evaluation) {
  const std::string title = "Estimated against true volume";
  const std::vector<DataPoint> items = volumes_by_truth(evaluation, false);
  const std::vector<DataPoint> fruit = volumes_by_truth(evaluation, true);
  if (items.empty() && fruit.empty()) return compose_empty_chart(title, kNoData);
  double smallest = HUGE_VAL;
  double largest = 0.0;
  for (const auto* points : {&items, &fruit}) {
    for (const DataPoint& point : *points) {
      smallest = std::min(smallest, point.x / kMaxFactorShown);
      largest = std::max(largest, point.x * kMaxFactorShown);
    }
  }
  // Logarithmic: the same share of the volume is the same distance everywhere.
  const Axis axis = make_logarithmic_axis("true volume (ml)", smallest, largest);
  Axis estimated = axis;
  estimated.title = "estimated volume (ml)";
  Chart chart(title, count(items.size() + fruit.size(), "mark") + ": an item of a pair, mean over seeds",
              axis, estimated);
  const Stroke ten_percent{kGrey, 1.2, "5 4"};
  chart.line({{axis.low, axis.low}, {axis.high, axis.high}}, kZeroLine, "equal");
  chart.line({{axis.low, 1.1 * axis.low}, {axis.high / 1.1, axis.high}}, ten_percent, "±10 %");
  chart.line({{axis.low / 0.9, axis.low}, {axis.high, 0.9 * axis.high}}, ten_percent, "");
  chart.markers(items, {Marker::dot, kBlue, 4.0, opacity_of(items.size())}, "foods");
  chart.markers(fruit, {Marker::square, kOrange, 4.0, opacity_of(fruit.size())},
                "scanned fruit, closed volume");
  return chart.str();
}

}  // namespace traygauge
