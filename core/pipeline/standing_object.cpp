#include "core/pipeline/standing_object.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/bounded_list.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMostHeights = 40;
constexpr std::size_t kMostPatches = 512;

struct Area {
  Vec2 least_mm;
  Vec2 most_mm;
};

std::span<const BundleDishResult> placed_dishes(const SceneGeometry& geometry) {
  return std::span(geometry.bundle.dishes).first(geometry.dish_count);
}

Area area_around(const SceneGeometry& geometry, const CardModelSize& card, double around_mm) {
  Area area{Vec2(0.0, -card.height_mm), Vec2(card.width_mm, 0.0)};
  for (const BundleDishResult& dish : placed_dishes(geometry)) {
    if (!dish.status.ok()) continue;
    const DishPose& place = dish.placed.place;
    const Vec2 half = Vec2::Constant(0.5 * std::max(place.size_mm[0], place.size_mm[1]));
    area.least_mm = area.least_mm.cwiseMin(place.centre_mm - half);
    area.most_mm = area.most_mm.cwiseMax(place.centre_mm + half);
  }
  area.least_mm -= Vec2::Constant(around_mm);
  area.most_mm += Vec2::Constant(around_mm);
  return area;
}

// On the dish or beside it.
bool is_at(const DishPose& dish, const Vec2& place_mm, double margin_mm) {
  const Vec2 offset = Eigen::Rotation2Dd(-dish.azimuth_rad) * (place_mm - dish.centre_mm);
  const Vec2 axes(0.5 * dish.size_mm[0] + margin_mm, 0.5 * dish.size_mm[1] + margin_mm);
  return offset.cwiseQuotient(axes).squaredNorm() <= 1.0;
}

// The height at which something stands over a place of the table; 0 where nothing does.
double standing_height_mm(const LevelPatch& patch, const Vec2& place_mm, const StandingObjectParams& params) {
  const auto correlation = [&](double height_mm) {
    return patch.correlation({place_mm.x(), place_mm.y(), height_mm});
  };
  double on_table = -1.0;
  for (double height_mm = -params.low_mm; height_mm <= params.low_mm; height_mm += params.height_step_mm) {
    on_table = std::max(on_table, correlation(height_mm));
    if (on_table > 1.0 - params.min_lead_over_table) return 0.0;
  }
  // What lies between, a tray's rim above all, peaks below the least height.
  std::array<double, kMostHeights> curve{};
  const double reach_mm = params.most_height_mm - params.sought_from_mm;
  const auto steps = std::min(kMostHeights, static_cast<std::size_t>(reach_mm / params.height_step_mm) + 1);
  for (std::size_t i = 0; i < steps; ++i)
    curve[i] = correlation(params.sought_from_mm + static_cast<double>(i) * params.height_step_mm);
  const auto heights = std::span(curve).first(steps);
  const auto best = static_cast<std::size_t>(std::ranges::max_element(heights) - heights.begin());
  const double height_mm = params.sought_from_mm + static_cast<double>(best) * params.height_step_mm;
  if (height_mm < params.least_height_mm || curve[best] < params.min_correlation ||
      curve[best] < on_table + params.min_lead_over_table)
    return 0.0;
  for (std::size_t i = 0; i < steps; ++i) {
    const double apart_mm =
        params.height_step_mm * std::abs(static_cast<double>(i) - static_cast<double>(best));
    if (apart_mm >= params.apart_mm && curve[i] > curve[best] - params.min_lead) return 0.0;
  }
  return height_mm;
}

}  // namespace

StandingObject find_standing_object(const ViewPair& views, const SceneGeometry& geometry,
                                    const CardModelSize& card, const StandingObjectParams& params) {
  const TableCameras& cameras = geometry.bundle.camera_from_table;
  const SurfaceView first{views[0]->gray, views[0]->lens, views[0]->labels, cameras[0]};
  const SurfaceView second{views[1]->gray, views[1]->lens, views[1]->labels, cameras[1]};
  const Area area = area_around(geometry, card, params.around_mm);
  const Vec2 middle_mm = 0.5 * (area.least_mm + area.most_mm);
  const LevelPatch patch(first, second, kBackgroundLabel, {middle_mm.x(), middle_mm.y(), 0.0}, params.patch);
  std::array<Vec3, kMostPatches> storage;
  BoundedList<Vec3> standing{std::span<Vec3>(storage)};
  for (double y = area.least_mm.y(); y <= area.most_mm.y(); y += params.step_mm) {
    for (double x = area.least_mm.x(); x <= area.most_mm.x(); x += params.step_mm) {
      const Vec2 place_mm(x, y);
      if (std::ranges::any_of(placed_dishes(geometry), [&](const BundleDishResult& dish) {
            return dish.status.ok() && is_at(dish.placed.place, place_mm, params.from_dish_mm);
          }))
        continue;
      const double height_mm = standing_height_mm(patch, place_mm, params);
      if (height_mm > 0.0) standing.push_back({x, y, height_mm});
    }
  }
  StandingObject object;
  object.sigma_mm = params.height_step_mm / std::sqrt(12.0);  // of a uniform distribution
  int most = params.min_patches - 1;
  for (const Vec3& middle : standing.items()) {
    const auto neighbours = static_cast<int>(std::ranges::count_if(standing.items(), [&](const Vec3& other) {
      return std::abs(other.z() - middle.z()) <= params.same_height_mm &&
             (other - middle).head<2>().norm() <= params.same_place_mm;
    }));
    if (neighbours <= most) continue;
    most = neighbours;
    object.is_seen = true;
    object.middle_mm = middle.head<2>();
    object.height_mm = middle.z();
  }
  return object;
}

}  // namespace traygauge
