#include "core/pipeline/standing_object.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/base/bounded_list.hpp"
#include "core/pipeline/dish_observation.hpp"

namespace traygauge {
namespace {

// From 18 to 64 mm by 2 mm are 24; an object of 512 patches 12 mm apart would be as large as a tray.
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
  const Vec2 offset = turned_back_by(place_mm - dish.centre_mm, frame_of(dish).axis);
  const Vec2 axes(0.5 * dish.size_mm[0] + margin_mm, 0.5 * dish.size_mm[1] + margin_mm);
  return offset.cwiseQuotient(axes).squaredNorm() <= 1.0;
}

// Steps from `least` on that do not go beyond `most`, both ends counted.
std::size_t steps_between(double least, double most, double step) {
  return static_cast<std::size_t>((most - least) / step) + 1;
}

double at_step(double least, std::size_t index, double step) {
  return least + static_cast<double>(index) * step;
}

// The height at which something stands over a place of the table; 0 where nothing does.
double standing_height_mm(const LevelPatch& patch, const Vec2& place_mm, const StandingObjectParams& params) {
  const auto correlation = [&](double height_mm) {
    return patch.correlation({place_mm.x(), place_mm.y(), height_mm});
  };
  double on_table = -1.0;
  for (std::size_t i = 0; i < steps_between(-params.low_mm, params.low_mm, params.height_step_mm); ++i) {
    on_table = std::max(on_table, correlation(at_step(-params.low_mm, i, params.height_step_mm)));
    // No correlation above 1 leads over this one.
    if (on_table > 1.0 - params.min_lead_over_table) return 0.0;
  }
  // What lies between, a tray's rim above all, peaks below the least height.
  std::array<double, kMostHeights> curve{};
  const std::size_t steps = std::min(
      kMostHeights, steps_between(params.sought_from_mm, params.most_height_mm, params.height_step_mm));
  const auto height_at = [&](std::size_t i) {
    return at_step(params.sought_from_mm, i, params.height_step_mm);
  };
  for (std::size_t i = 0; i < steps; ++i) curve[i] = correlation(height_at(i));
  const auto heights = std::span(curve).first(steps);
  const auto best = static_cast<std::size_t>(std::ranges::max_element(heights) - heights.begin());
  const double height_mm = height_at(best);
  if (height_mm < params.least_height_mm || curve[best] < params.min_correlation ||
      curve[best] < on_table + params.min_lead_over_table)
    return 0.0;
  for (std::size_t i = 0; i < steps; ++i) {
    const double apart_mm = std::abs(height_at(i) - height_mm);
    if (apart_mm >= params.apart_mm && curve[i] > curve[best] - params.min_lead) return 0.0;
  }
  return height_mm;
}

}  // namespace

StandingObject find_standing_object(const ViewPair& views, const SceneGeometry& geometry,
                                    const CardModelSize& card, const StandingObjectParams& params,
                                    std::uint8_t label) {
  const TableCameras& cameras = geometry.bundle.camera_from_table;
  const SurfaceView first = surface_view(*views[0], cameras[0]);
  const SurfaceView second = surface_view(*views[1], cameras[1]);
  const Area area = area_around(geometry, card, params.around_mm);
  const Vec2 middle_mm = 0.5 * (area.least_mm + area.most_mm);
  const LevelPatch patch(first, second, label, {middle_mm.x(), middle_mm.y(), 0.0}, params.patch);
  std::array<Vec3, kMostPatches> storage;
  BoundedList<Vec3> standing{std::span<Vec3>(storage)};
  const auto steps_along = [&](int axis) {
    return steps_between(area.least_mm[axis], area.most_mm[axis], params.step_mm);
  };
  for (std::size_t row = 0; row < steps_along(1); ++row) {
    for (std::size_t column = 0; column < steps_along(0); ++column) {
      const Vec2 place_mm(at_step(area.least_mm.x(), column, params.step_mm),
                          at_step(area.least_mm.y(), row, params.step_mm));
      if (std::ranges::any_of(placed_dishes(geometry), [&](const BundleDishResult& dish) {
            return dish.status.ok() && is_at(dish.placed.place, place_mm, params.from_dish_mm);
          }))
        continue;
      const double height_mm = standing_height_mm(patch, place_mm, params);
      if (height_mm > 0.0) standing.push_back({place_mm.x(), place_mm.y(), height_mm});
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
    object.height_mm = middle.z();
  }
  return object;
}

}  // namespace traygauge
