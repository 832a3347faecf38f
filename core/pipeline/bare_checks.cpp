#include "core/pipeline/bare_checks.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

// Shares of a dish's depth, from its crest, at which its bands end.
constexpr double kEdgeDepth = 0.2;
constexpr double kWallDepth = 0.8;

std::size_t band_of(double height_mm, const DishProfile& profile) {
  const double depth_mm = profile.crest_height_mm() - profile.bottom_height_mm();
  const double depth = depth_mm > 0.0 ? (profile.crest_height_mm() - height_mm) / depth_mm : 1.0;
  return depth < kEdgeDepth ? 0 : depth < kWallDepth ? 1 : 2;
}

}  // namespace

AgreedHeight find_table(const ViewPair& views, const TableCameras& cameras, const CardModelSize& card,
                        const BareCheckParams& params) {
  const SurfaceView first = surface_view(*views[0], cameras[0]);
  const SurfaceView second = surface_view(*views[1], cameras[1]);
  const Vec3 middle_mm = print_point_mm(Vec2(0.5 * card.width_mm, 0.5 * card.height_mm), 0.0);
  SurfaceAgreement table(first, second, kBackgroundLabel, middle_mm, params.agreement);
  const auto steps = [&](double side_mm) {
    return static_cast<int>((side_mm + 2.0 * params.around_card_mm) / params.table_step_mm);
  };
  const auto is_off = [&](double x_mm, double side_mm) {
    return x_mm < -params.card_margin_mm || x_mm > side_mm + params.card_margin_mm;
  };
  for (int row = 0; row <= steps(card.height_mm); ++row) {
    for (int column = 0; column <= steps(card.width_mm); ++column) {
      const Vec2 place = params.table_step_mm * Vec2(column, row) - Vec2::Constant(params.around_card_mm);
      if (is_off(place.x(), card.width_mm) || is_off(place.y(), card.height_mm))
        table.add(print_point_mm(place, 0.0));
    }
  }
  return table.solve();
}

std::array<AgreedHeight, kGlazeBands> find_glaze(const ViewPair& views, const TableCameras& cameras,
                                                 const SurfaceGrid& grid, const InnerSurface& inner,
                                                 std::uint8_t dish, const BareCheckParams& params) {
  const SurfaceView first = surface_view(*views[0], cameras[0]);
  const SurfaceView second = surface_view(*views[1], cameras[1]);
  const auto for_each_bare = [&](const auto& action) {
    for (int y = 0; y < grid.labels.height; ++y) {
      for (int x = 0; x < grid.labels.width; ++x) {
        if (grid.labels.at(x, y) != kDishLabel || grid.evidence.at(x, y) != SurfaceEvidence::both) continue;
        action(x, y, band_of(grid.points.at(x, y).z_mm, inner.profile));
      }
    }
  };
  std::array<std::size_t, kGlazeBands> counts{};
  for_each_bare([&](int, int, std::size_t band) { ++counts[band]; });
  const auto step_of = [&](std::size_t band) {
    const double share = static_cast<double>(counts[band]) / static_cast<double>(params.max_glaze_samples);
    return std::max(1, static_cast<int>(std::ceil(std::sqrt(share))));
  };
  const std::array<int, kGlazeBands> steps{step_of(0), step_of(1), step_of(2)};
  const Vec2& centre = inner.place.centre_mm;
  const SurfaceAgreement none(first, second, dish, {centre.x(), centre.y(), inner.profile.bottom_height_mm()},
                              params.agreement);
  std::array<SurfaceAgreement, kGlazeBands> bands{none, none, none};
  for_each_bare([&](int x, int y, std::size_t band) {
    if (x % steps[band] != 0 || y % steps[band] != 0) return;
    const SurfacePoint& point = grid.points.at(x, y);
    bands[band].add({point.x_mm, point.y_mm, point.z_mm});
  });
  return {bands[0].solve(), bands[1].solve(), bands[2].solve()};
}

}  // namespace traygauge
