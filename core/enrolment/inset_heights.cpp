#include "core/enrolment/inset_heights.hpp"

#include <algorithm>
#include <cmath>

#include "core/stereo/subpixel_refinement.hpp"

namespace traygauge {
namespace {

using Sample = InsetHeightWorkspace::Sample;
constexpr double kQuartilesToSigma = 0.7413;  // of normal errors
constexpr double kMedianToMean = 1.2533;      // error of a median over that of a mean

// Of the row at a place between its pixels, linear; false near its ends.
bool gradient_at(const std::uint8_t* row, int width, double place, double& gradient) {
  if (!(place >= 1.0 && place < width - 2.0)) return false;
  const int left = static_cast<int>(place);
  const double share = place - left;
  const auto at = [&](int x) { return 0.5 * (row[x + 1] - row[x - 1]); };
  gradient = (1.0 - share) * at(left) + share * at(left + 1);
  return true;
}

// Mean product of both pictures' gradients around a sample, less what noise alone may reach.
double common_gradient(const InsetView& view, int x, int y, int radius) {
  constexpr double kSigmas = 2.0;
  double product = 0.0;
  double own_square = 0.0;
  double other_square = 0.0;
  int count = 0;
  for (int v = std::max(0, y - radius); v <= std::min(view.gray.height - 1, y + radius); ++v) {
    for (int u = std::max(0, x - radius); u <= std::min(view.gray.width - 1, x + radius); ++u) {
      if (view.surface.labels.at(u, v) == kBackgroundLabel) continue;
      const double partner = u + view.sign * static_cast<double>(view.disparity.at(u, v));
      double own = 0.0;
      double other = 0.0;
      if (!gradient_at(view.gray.row(v), view.gray.width, u, own) ||
          !gradient_at(view.other_gray.row(v), view.other_gray.width, partner, other)) {
        continue;
      }
      product += own * other;
      own_square += own * own;
      other_square += other * other;
      ++count;
    }
  }
  if (count == 0) return 0.0;
  const double by_chance = kSigmas * std::sqrt(own_square * other_square / count);
  return std::max(0.0, (product - by_chance) / count);
}

// The height below which `share` of the weight lies.
double weighted_quantile(std::span<const Sample> sorted, double total, double share) {
  double below = 0.0;
  for (const Sample& sample : sorted) {
    below += static_cast<double>(sample.weight);
    if (below >= share * total) return static_cast<double>(sample.height_mm);
  }
  return sorted.empty() ? 0.0 : static_cast<double>(sorted.back().height_mm);
}

class RingSort {
 public:
  RingSort(const std::array<InsetView, 2>& views, const InnerSurface& edge, const InsetHeightParams& params,
           InsetHeightWorkspace& workspace)
      : views_(views), edge_(edge), params_(params), workspace_(workspace) {}

  // Counts every ring's samples, then puts them side by side.
  bool sort(std::size_t rings) {
    rings_ = rings;
    const std::span<std::uint32_t> ends = workspace_.ends.first(rings + 1);
    std::fill(ends.begin(), ends.end(), 0U);
    for_each_sample([&](std::size_t ring, const InsetView&, int, int) { ++ends[ring + 1]; });
    for (std::size_t i = 1; i <= rings; ++i) ends[i] += ends[i - 1];
    if (ends[rings] > workspace_.samples.size()) return false;
    for_each_sample([&](std::size_t ring, const InsetView& view, int x, int y) {
      workspace_.samples[ends[ring]++] = {view.surface.points.at(x, y).z_mm, weight(view, x, y)};
    });
    return true;
  }

  // After sort() the end of each ring's samples stands where its beginning was.
  std::span<Sample> samples_of(std::size_t ring) const {
    const std::size_t begin = ring == 0 ? 0 : workspace_.ends[ring - 1];
    return workspace_.samples.subspan(begin, workspace_.ends[ring] - begin);
  }

 private:
  bool is_beside_item(const InsetView& view, int x, int y) const {
    const ImageView<const std::uint8_t>& labels = view.surface.labels;
    const int reach = params_.item_margin;
    const auto has_item = [&](int u, int v) { return labels.contains(u, v) && is_item(labels.at(u, v)); };
    return has_item(x - reach, y) || has_item(x + reach, y) || has_item(x, y - reach) ||
           has_item(x, y + reach);
  }
  float weight(const InsetView& view, int x, int y) const {
    if (view.surface.evidence.at(x, y) != SurfaceEvidence::both ||
        view.gray.at(x, y) >= params_.burnt_level || is_beside_item(view, x, y))
      return 0.0F;
    const double gradient = common_gradient(view, x, y, kRefinementRadius);
    return static_cast<float>(gradient / (gradient + params_.half_weight_gradient));
  }

  template <class Action>
  void for_each_sample(Action action) const {
    for (const InsetView& view : views_) {
      for (int y = 0; y < view.surface.points.height; ++y) {
        for (int x = 0; x < view.surface.points.width; ++x) {
          if (view.surface.labels.at(x, y) != kDishLabel) continue;
          const SurfacePoint& point = view.surface.points.at(x, y);
          const double inset = edge_.profile.inset_mm(edge_.to_dish(Vec2(point.x_mm, point.y_mm)));
          const double ring = std::floor(inset / params_.ring_mm);
          if (ring >= 0.0 && ring < static_cast<double>(rings_) && std::isfinite(point.z_mm))
            action(static_cast<std::size_t>(ring), view, x, y);
        }
      }
    }
  }

  const std::array<InsetView, 2>& views_;
  const InnerSurface& edge_;
  const InsetHeightParams& params_;
  InsetHeightWorkspace& workspace_;
  std::size_t rings_ = 0;
};

InsetRing summarise(std::span<Sample> samples, double inset_mm, const InsetHeightParams& params) {
  InsetRing ring{.inset_mm = inset_mm};
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.height_mm < b.height_mm; });
  for (const Sample& sample : samples) ring.samples += static_cast<double>(sample.weight);
  ring.is_known = ring.samples >= params.min_samples &&
                  ring.samples >= params.min_weight * static_cast<double>(samples.size());
  if (!ring.is_known) return ring;
  ring.height_mm = weighted_quantile(samples, ring.samples, 0.5);
  ring.spread_mm = kQuartilesToSigma * (weighted_quantile(samples, ring.samples, 0.75) -
                                        weighted_quantile(samples, ring.samples, 0.25));
  // The samples of a window err together.
  const double window = 2.0 * kRefinementRadius + 1.0;
  ring.sigma_mm = kMedianToMean * ring.spread_mm * window / std::sqrt(ring.samples);
  return ring;
}

}  // namespace

Status collect_inset_heights(const std::array<InsetView, 2>& views, const InnerSurface& edge,
                             const InsetHeightParams& params, InsetHeightWorkspace& workspace,
                             std::span<const InsetRing>& rings) {
  rings = {};
  const double count = std::floor(edge.profile.semi_axes_mm().minCoeff() / params.ring_mm);
  if (!(count >= 1.0 && count <= static_cast<double>(workspace.rings.size())))
    return StatusCode::invalid_configuration;
  RingSort sort(views, edge, params, workspace);
  const auto ring_count = static_cast<std::size_t>(count);
  if (!sort.sort(ring_count)) return StatusCode::invalid_configuration;
  for (std::size_t i = 0; i < ring_count; ++i) {
    const double inset_mm = (static_cast<double>(i) + 0.5) * params.ring_mm;
    workspace.rings[i] = summarise(sort.samples_of(i), inset_mm, params);
  }
  rings = workspace.rings.first(ring_count);
  return StatusCode::ok;
}

}  // namespace traygauge
