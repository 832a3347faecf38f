#include "firmware/evaluate/bootstrap.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "core/base/random.hpp"
#include "firmware/evaluate/accuracy.hpp"
#include "firmware/evaluate/statistics.hpp"
#include "firmware/evaluate/uncertainty.hpp"

namespace traygauge {
namespace {

// `part_of(item)` summed by capture.
template <class PartOfItem>
std::vector<RatioPart> parts_by_capture(const std::vector<ItemSeries>& items, PartOfItem part_of) {
  std::map<std::string, RatioPart> by_capture;
  for (const ItemSeries& item : items) {
    const RatioPart own = part_of(item);
    RatioPart& sum = by_capture[item.capture];
    sum.numerator += own.numerator;
    sum.denominator += own.denominator;
  }
  std::vector<RatioPart> parts;
  parts.reserve(by_capture.size());
  for (const auto& [capture, part] : by_capture) parts.push_back(part);
  return parts;
}

}  // namespace

std::optional<ConfidenceInterval> bootstrap_ratio(const std::vector<RatioPart>& parts,
                                                  const BootstrapParams& params) {
  std::vector<RatioPart> filled = parts;
  std::erase_if(filled, [](const RatioPart& part) { return !(part.denominator > 0.0); });
  if (filled.size() < 2) return {};
  Random random(params.seed);
  std::vector<double> ratios;
  ratios.reserve(static_cast<std::size_t>(std::max(params.resamples, 0)));
  for (int resample = 0; resample < params.resamples; ++resample) {
    RatioPart sum;
    for (std::size_t i = 0; i < filled.size(); ++i) {
      const RatioPart& part = filled[random.below(static_cast<std::uint32_t>(filled.size()))];
      sum.numerator += part.numerator;
      sum.denominator += part.denominator;
    }
    ratios.push_back(sum.numerator / sum.denominator);
  }
  const double tail = 0.5 * (1.0 - params.level);
  return ConfidenceInterval{quantile(ratios, tail), quantile(ratios, 1.0 - tail)};
}

std::optional<ConfidenceInterval> mape_interval(const std::vector<ItemSeries>& items,
                                                const BootstrapParams& params) {
  const auto part_of = [](const ItemSeries& item) {
    const ItemFigures figures = item_figures(item);
    return figures.estimates > 0 ? RatioPart{figures.mape, 1.0} : RatioPart{};
  };
  return bootstrap_ratio(parts_by_capture(items, part_of), params);
}

std::optional<ConfidenceInterval> bias_interval(const std::vector<ItemSeries>& items,
                                                const BootstrapParams& params) {
  const auto part_of = [](const ItemSeries& item) {
    const ItemFigures figures = item_figures(item);
    if (figures.estimates == 0) return RatioPart{};
    return RatioPart{figures.bias * figures.estimates, static_cast<double>(figures.estimates)};
  };
  return bootstrap_ratio(parts_by_capture(items, part_of), params);
}

std::optional<ConfidenceInterval> coverage_interval(const std::vector<ItemSeries>& items,
                                                    const BootstrapParams& params) {
  if (!sigma_figures(items).is_estimated) return {};
  const auto part_of = [](const ItemSeries& item) {
    RatioPart part;
    for (const Attempt& attempt : item.attempts) {
      if (!attempt.is_measured) continue;
      part.numerator += is_covered(attempt, item.truth_ml) ? 100.0 : 0.0;
      part.denominator += 1.0;
    }
    return part;
  };
  return bootstrap_ratio(parts_by_capture(items, part_of), params);
}

}  // namespace traygauge
