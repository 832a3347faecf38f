#include "core/pipeline/lens_doubt.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

constexpr auto kContradictions = std::to_array<StatusCode>(
    {StatusCode::pose_contradicts_card, StatusCode::dish_moved, StatusCode::scale_disagrees,
     StatusCode::card_lifted, StatusCode::dish_differs, StatusCode::labels_inconsistent,
     StatusCode::dish_unknown, StatusCode::item_moved});
constexpr auto kDoubts =
    std::to_array<Warning>({Warning::dish_moved, Warning::scale_disagrees, Warning::card_lifted,
                            Warning::dish_differs, Warning::item_moved});

bool is_contradiction(StatusCode code) {
  return std::ranges::find(kContradictions, code) != kContradictions.end();
}

bool is_doubted(const Measurement& measurement) {
  return std::ranges::any_of(kDoubts, [&](Warning warning) { return measurement.warnings.holds(warning); });
}

}  // namespace

LensModel LensChange::of(LensModel lens) const {
  lens.pinhole.fx_px *= focal_ratio;
  lens.pinhole.fy_px *= focal_ratio;
  lens.k1 += k1;
  return lens;
}

bool may_be_the_lens(const Measurement& measurement) {
  return is_contradiction(measurement.status.code()) || is_doubted(measurement) ||
         std::ranges::any_of(measurement.items,
                             [](const ItemResult& item) { return is_contradiction(item.status); });
}

std::optional<double> scale_if_all_agrees(const Measurement& measurement) {
  if (!measurement.status.ok() || is_doubted(measurement) ||
      measurement.warnings.holds(Warning::dish_not_found) ||
      measurement.warnings.holds(Warning::unknown_object))
    return std::nullopt;
  std::optional<double> worst;
  for (const Check& check : measurement.checks.items()) {
    if (check.kind != CheckKind::scale_percent) continue;
    worst = std::max(worst.value_or(0.0), std::abs(check.value));
  }
  return worst;
}

void blame_lens(const LensChange& change, const LensDoubtParams& params, std::span<ItemResult> items,
                Measurement& measurement) {
  constexpr double kPercent = 100.0;
  if (change.focal_ratio != 1.0) {
    // Between two of those that were tried, any is as likely.
    const double sigma = params.focal_step / std::sqrt(12.0);
    measurement.checks.add({CheckKind::focal_percent, kBackgroundLabel, kPercent * (change.focal_ratio - 1.0),
                            kPercent * sigma, kPercent * params.focal_step / 2.0, Verdict::refused});
  }
  for (ItemResult& item : items) item.status = StatusCode::lens_does_not_fit;
  measurement.status = StatusCode::lens_does_not_fit;
}

}  // namespace traygauge
