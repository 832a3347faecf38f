#include "firmware/check/drift_check.hpp"

#include "firmware/base/text.hpp"
#include "firmware/handover/told_drift.hpp"

namespace traygauge {
namespace {

constexpr Milliseconds kHubAnswersWithin{1000};

std::string figures(const ToldTrend& trend) {
  return trend.check + " " + fixed(trend.median, 2) + " ± " + fixed(trend.sigma, 2) + " over " +
         std::to_string(trend.scans) + " trays";
}

}  // namespace

CheckResult check_drift(const HandoverConfig& handover) {
  CheckResult result{"drift of " + handover.name, true, {}};
  const Expected<std::vector<ToldTrend>> trends =
      ask_drift(handover.socket, handover.name, kHubAnswersWithin);
  if (!trends.ok()) {
    result.text = "not known, because no hub answers (" + trends.failure() + ")";
    return result;
  }
  std::string drifts;
  std::string medians;
  for (const ToldTrend& trend : *trends) {
    if (!trend.drift.empty()) drifts.append(drifts.empty() ? "" : " ").append(trend.drift);
    medians.append(medians.empty() ? "" : ", ").append(figures(trend));
  }
  result.is_good = drifts.empty();
  if (trends->empty()) medians = "not known, because the hub has stored no tray that says it";
  result.text = drifts.empty() ? medians : drifts;
  return result;
}

}  // namespace traygauge
