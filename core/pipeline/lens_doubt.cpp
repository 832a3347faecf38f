#include "core/pipeline/lens_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace traygauge {
namespace {

// Not card_not_flat: another focal length often makes a card that leans look flat. Not item_moved: a lens
// does not move one item alone.
constexpr auto kContradictions =
    std::to_array<StatusCode>({StatusCode::pose_contradicts_card, StatusCode::dish_moved,
                               StatusCode::scale_disagrees, StatusCode::card_lifted, StatusCode::dish_differs,
                               StatusCode::labels_inconsistent, StatusCode::dish_unknown});
constexpr auto kDoubts = std::to_array<Warning>(
    {Warning::dish_moved, Warning::scale_disagrees, Warning::card_lifted, Warning::dish_differs});
// What else is left to doubt through a lens that does not explain it all.
constexpr auto kOtherDoubts = std::to_array<Warning>(
    {Warning::card_not_flat, Warning::item_moved, Warning::dish_not_found, Warning::unknown_object});

bool is_contradiction(StatusCode code) {
  return std::ranges::find(kContradictions, code) != kContradictions.end();
}

template <std::size_t kCount>
bool holds_any(const WarningSet& warnings, const std::array<Warning, kCount>& doubts) {
  return std::ranges::any_of(doubts, [&](Warning warning) { return warnings.holds(warning); });
}

}  // namespace

LensModel LensChange::of(LensModel lens) const {
  lens.pinhole.fx_px *= focal_ratio;
  lens.pinhole.fy_px *= focal_ratio;
  lens.k1 += k1;
  return lens;
}

bool may_be_the_lens(const Measurement& measurement) {
  return is_contradiction(measurement.status.code()) || holds_any(measurement.warnings, kDoubts) ||
         std::ranges::any_of(measurement.items,
                             [](const ItemResult& item) { return is_contradiction(item.status); });
}

std::optional<double> scale_if_all_agrees(const Measurement& measurement) {
  if (!measurement.status.ok() || holds_any(measurement.warnings, kDoubts) ||
      holds_any(measurement.warnings, kOtherDoubts))
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
  const bool is_refused = !is_measured(measurement);
  if (change.focal_ratio != 1.0) {
    // Between two of those that were tried, any is as likely.
    const double sigma = params.focal_step / std::sqrt(12.0);
    measurement.checks.add({CheckKind::focal_percent, kBackgroundLabel, kPercent * (change.focal_ratio - 1.0),
                            kPercent * sigma, kPercent * params.focal_step / 2.0,
                            is_refused ? Verdict::refused : Verdict::warned});
  }
  if (!is_refused) {
    measurement.warnings.raise(Warning::lens_does_not_fit);
    return;
  }
  for (ItemResult& item : items) item.status = StatusCode::lens_does_not_fit;
  measurement.status = StatusCode::lens_does_not_fit;
}

}  // namespace traygauge
