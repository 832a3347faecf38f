#include "firmware/verify/verify_figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "firmware/base/percent.hpp"
#include "firmware/verify/intervals.hpp"

namespace traygauge {
namespace {

using Groups = std::vector<std::vector<double>>;

// Of one body's scans.
struct BodyErrors {
  std::vector<double> errors;
  std::vector<double> absolute;
  int within_one = 0;
  int within_two = 0;
  int warned = 0;
};

BodyErrors collect_errors(const VerifyRecord& record, std::size_t body_number) {
  const VerifyBody& body = record.header.plan.bodies[body_number];
  BodyErrors all;
  for (const VerifyStep& step : record.header.plan.steps) {
    if (step.body != body_number || step.is_repeat) continue;
    const VerifyScan* const scan = record.measured(step.id);
    if (scan == nullptr) continue;
    all.errors.push_back(verify_error(*scan, body));
    all.absolute.push_back(std::abs(all.errors.back()));
    const double sigma_ml = std::hypot(scan->sigma_ml, body.volume_sigma_ml);
    const double off_ml = std::abs(scan->volume_ml - body.volume_ml);
    if (off_ml <= sigma_ml) ++all.within_one;
    if (off_ml <= 2.0 * sigma_ml) ++all.within_two;
    if (!scan->warnings.empty()) ++all.warned;
  }
  return all;
}

// Two standard deviations of what a body's volume is said to be.
double uncertainty_percent(const VerifyBody& body) {
  return 2.0 * kPercent * body.volume_sigma_ml / body.volume_ml;
}

VerifyFigure mean_figure(const Groups& groups, double uncertainty) {
  VerifyFigure figure;
  std::vector<double> means;
  for (const std::vector<double>& group : groups) {
    if (!group.empty()) means.push_back(mean(group));
  }
  figure.value = mean(means);
  figure.interval = mean_interval(groups);
  if (figure.interval)
    figure.wide = ConfidenceInterval{figure.interval->low - uncertainty, figure.interval->high + uncertainty};
  return figure;
}

VerifyFigure share_figure(int hits, int trials) {
  VerifyFigure figure;
  if (trials < 1) return figure;
  figure.value = kPercent * hits / trials;
  figure.interval = share_interval(hits, trials);
  figure.interval->low *= kPercent;
  figure.interval->high *= kPercent;
  figure.wide = figure.interval;
  return figure;
}

VerifyFigure variation_of(const std::vector<double>& volumes_ml) {
  VerifyFigure figure;
  if (volumes_ml.size() < 2) return figure;
  figure.value = kPercent * sample_deviation(volumes_ml) / mean(volumes_ml);
  const auto factors = deviation_factors(static_cast<int>(volumes_ml.size()));
  figure.interval = ConfidenceInterval{factors->low * figure.value, factors->high * figure.value};
  figure.wide = figure.interval;
  return figure;
}

// No absolute error is below 0.
void clamp_at_zero(VerifyFigure& figure) {
  for (std::optional<ConfidenceInterval>* interval : {&figure.interval, &figure.wide}) {
    if (*interval) (*interval)->low = std::max(0.0, (*interval)->low);
  }
}

void count_attempts(const VerifyRecord& record, VerifyFigures& figures) {
  for (const VerifyStep& step : record.header.plan.steps) {
    ++figures.steps;
    if (!record.is_done(step)) continue;
    ++figures.steps_done;
    if (record.measured(step.id) == nullptr) ++figures.steps_refused;
  }
  figures.attempts = static_cast<int>(record.scans.size());
  figures.attempts_refused = static_cast<int>(
      std::ranges::count_if(record.scans, [](const VerifyScan& scan) { return !scan.is_measured; }));
  figures.refused = share_figure(figures.attempts_refused, figures.attempts);
}

std::vector<double> repeated_volumes(const VerifyRecord& record) {
  std::vector<double> volumes_ml;
  for (const VerifyStep& step : record.header.plan.steps) {
    if (!step.is_repeat) continue;
    if (const VerifyScan* const scan = record.measured(step.id)) volumes_ml.push_back(scan->volume_ml);
  }
  return volumes_ml;
}

BodyFigures figures_of(const VerifyBody& body, const BodyErrors& own) {
  BodyFigures figures;
  figures.body = body;
  figures.scans = static_cast<int>(own.errors.size());
  figures.warned = own.warned;
  const double uncertainty = uncertainty_percent(body);
  figures.bias = mean_figure({own.errors}, uncertainty);
  figures.mape = mean_figure({own.absolute}, uncertainty);
  clamp_at_zero(figures.mape);
  figures.within_one = share_figure(own.within_one, figures.scans);
  figures.within_two = share_figure(own.within_two, figures.scans);
  if (!own.errors.empty())
    figures.worst = *std::ranges::max_element(own.errors, {}, [](double e) { return std::abs(e); });
  return figures;
}

}  // namespace

double verify_error(const VerifyScan& scan, const VerifyBody& body) {
  return kPercent * (scan.volume_ml - body.volume_ml) / body.volume_ml;
}

double farthest(const ConfidenceInterval& interval) {
  return std::max(std::abs(interval.low), std::abs(interval.high));
}

const BodyFigures* VerifyFigures::worst_body() const {
  const BodyFigures* worst = nullptr;
  for (const BodyFigures& own : bodies) {
    if (!own.bias.wide) continue;
    if (worst == nullptr || farthest(*own.bias.wide) > farthest(*worst->bias.wide)) worst = &own;
  }
  return worst;
}

VerifyFigures verify_figures(const VerifyRecord& record) {
  VerifyFigures figures;
  count_attempts(record, figures);
  Groups errors;
  Groups absolute;
  std::vector<double> uncertainties;
  int scans = 0;
  int within_one = 0;
  int within_two = 0;
  const std::vector<VerifyBody>& bodies = record.header.plan.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyErrors own = collect_errors(record, i);
    figures.bodies.push_back(figures_of(bodies[i], own));
    errors.push_back(own.errors);
    absolute.push_back(own.absolute);
    uncertainties.push_back(uncertainty_percent(bodies[i]));
    scans += figures.bodies.back().scans;
    within_one += own.within_one;
    within_two += own.within_two;
  }
  // One caliper and one printer: the bodies' volumes may all be wrong to the same side.
  const double uncertainty = mean(uncertainties);
  figures.bias = mean_figure(errors, uncertainty);
  figures.mape = mean_figure(absolute, uncertainty);
  clamp_at_zero(figures.mape);
  figures.within_one = share_figure(within_one, scans);
  figures.within_two = share_figure(within_two, scans);
  const std::vector<double> repeats = repeated_volumes(record);
  figures.repeats = static_cast<int>(repeats.size());
  figures.cv = variation_of(repeats);
  return figures;
}

}  // namespace traygauge
