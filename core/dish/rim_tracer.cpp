#include "core/dish/rim_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/dish/rim_votes.hpp"
#include "core/geometry/parabola.hpp"

namespace traygauge {
namespace {

// Where the values peak between the samples about `best`, by a parabola.
float refined(std::span<const float> steps, std::size_t best, double& index) {
  index = static_cast<double>(best);
  if (best > 0 && best + 1 < steps.size())
    index += parabola_top(steps[best - 1], steps[best], steps[best + 1]);
  return steps[best];
}

// The largest value.
float peak_of(std::span<const float> steps, double& index) {
  const auto best = static_cast<std::size_t>(std::max_element(steps.begin(), steps.end()) - steps.begin());
  return refined(steps, best, index);
}

// Of the peaks that reach a good part of the largest, the one nearest to the middle.
float nearest_peak_of(std::span<const float> steps, double& index) {
  constexpr float kGoodPart = 0.3F;
  const float least = kGoodPart * *std::max_element(steps.begin(), steps.end());
  const std::size_t middle = steps.size() / 2;
  const auto is_peak = [&](std::size_t i) {
    return steps[i] >= least && steps[i] >= steps[i - 1] && steps[i] >= steps[i + 1];
  };
  for (std::size_t off = 0; off < middle; ++off) {
    for (const std::size_t i : {middle - off, middle + off}) {
      if (i > 0 && i + 1 < steps.size() && is_peak(i)) return refined(steps, i, index);
    }
  }
  return peak_of(steps, index);
}

}  // namespace

RimTracer::RimTracer(const DishSearchViews& views, const DishSearchParams& params,
                     DishSearchWorkspace& workspace)
    : views_(views), params_(params), workspace_(workspace) {
  for (int i = 0; i < params_.outline_points; ++i) {
    workspace_.angles[static_cast<std::size_t>(i)] =
        direction_of(2.0 * std::numbers::pi * i / params_.outline_points);
  }
}

void RimTracer::shift_to_edges(std::span<const std::size_t> views, int inside_sign, DishPose& place) {
  const int offsets = RimReader(views_[0], params_).offsets(params_.vote_reach_mm);
  for (int i = 0; i < params_.outline_points; ++i) {
    const std::span<float> steps = steps_of(0, i, offsets);
    std::fill(steps.begin(), steps.end(), 0.0F);
  }
  for (const std::size_t view : views) add_steps(view, place, inside_sign);
  prepare_shifts(place);
  const bool is_round = is_round_dish(place.size_mm);
  const int turns = is_round ? 0 : params_.azimuth_steps / 2;
  const double turn_step_rad = std::numbers::pi / params_.azimuths / std::max(1, params_.azimuth_steps - 1);
  const int shifts = static_cast<int>(0.8 * params_.vote_reach_mm / params_.shift_step_mm);
  float most = -1.0F;
  DishPose best = place;
  for (int turn = -turns; turn <= turns; ++turn) {
    for (int dy = -shifts; dy <= shifts; ++dy) {
      for (int dx = -shifts; dx <= shifts; ++dx) {
        const Vec2 shift_mm = params_.shift_step_mm * Vec2(dx, dy);
        const float sum = sum_steps(shift_mm, turn * turn_step_rad, offsets);
        if (sum <= most) continue;
        most = sum;
        best.centre_mm = place.centre_mm + shift_mm;
        best.azimuth_rad = place.azimuth_rad + turn * turn_step_rad;
      }
    }
  }
  place = best;
}

// Onto what was read of other views.
void RimTracer::add_steps(std::size_t view, const DishPose& place, int inside_sign) {
  const RimReader reader(views_[view], params_);
  const int offsets = reader.offsets(params_.vote_reach_mm);
  std::array<float, kMaxRimOffsets> storage{};
  const std::span<float> steps = std::span(storage).first(static_cast<std::size_t>(offsets));
  for (int i = 0; i < params_.outline_points; ++i) {
    if (!reader.read_steps(rim_normal(place, angle_at(i)), inside_sign, steps)) continue;
    const std::span<float> sums = steps_of(0, i, offsets);
    for (std::size_t k = 0; k < sums.size(); ++k)
      sums[k] += std::clamp(steps[k], 0.0F, static_cast<float>(params_.sure_step));
  }
}

std::span<float> RimTracer::steps_of(std::size_t view, int angle, int offsets) const {
  const std::size_t index =
      view * static_cast<std::size_t>(params_.outline_points) + static_cast<std::size_t>(angle);
  return workspace_.steps.subspan(index * kMaxRimOffsets, static_cast<std::size_t>(offsets));
}

void RimTracer::prepare_shifts(const DishPose& place) {
  const Vec2 axis = direction_of(place.azimuth_rad);
  const Vec2 semi(0.5 * place.size_mm[0], 0.5 * place.size_mm[1]);
  for (std::size_t i = 0; i < workspace_.shifts.size(); ++i) {
    const Vec2& angle = workspace_.angles[i];
    const Vec2 normal = Vec2(semi.y() * angle.x(), semi.x() * angle.y()).normalized();
    const Vec2 point = semi.cwiseProduct(angle);
    const Vec2 on_table = turned_by(normal, axis) / params_.sample_mm;
    const double turn = normal.dot(Vec2(-point.y(), point.x())) / params_.sample_mm;
    workspace_.shifts[i] = {static_cast<float>(on_table.x()), static_cast<float>(on_table.y()),
                            static_cast<float>(turn)};
  }
}

// Of the steps that were read about a place, those where the rim lies once the dish is moved,
// to first order.
float RimTracer::sum_steps(const Vec2& shift_mm, double turn_rad, int offsets) const {
  const Eigen::Vector3f moved(static_cast<float>(shift_mm.x()), static_cast<float>(shift_mm.y()),
                              static_cast<float>(turn_rad));
  // Rounds to the nearest by cutting off what is positive.
  const int centre = offsets / 2;
  const float middle = static_cast<float>(centre) + 0.5F;
  float sum = 0.0F;
  for (std::size_t i = 0; i < workspace_.shifts.size(); ++i) {
    const RimShift& shift = workspace_.shifts[i];
    const float at = middle + moved.x() * shift.x + moved.y() * shift.y + moved.z() * shift.turn;
    if (!(at >= 0.0F) || at >= static_cast<float>(offsets)) continue;
    sum += workspace_.steps[i * kMaxRimOffsets + static_cast<std::size_t>(static_cast<int>(at))];
  }
  return sum;
}

double RimTracer::noise_beside(const DishPose& place, int inside_sign) {
  std::array<int, 256> counts{};
  int total = 0;
  for (std::size_t v = 0; v < 2; ++v) {
    const RimReader reader(views_[v], params_);
    const int offsets = reader.offsets(params_.vote_reach_mm);
    for (int i = 0; i < params_.outline_points; ++i) {
      const std::span<float> steps = steps_of(v, i, offsets);
      if (!reader.read_steps(rim_normal(place, angle_at(i)), inside_sign, steps)) continue;
      for (int k = 0; k < offsets; ++k) {
        if (std::abs(reader.offset_mm(k, offsets)) < params_.edge_reach_mm + params_.band_mm) continue;
        const float step = std::abs(steps[static_cast<std::size_t>(k)]);
        ++counts[static_cast<std::size_t>(std::min(step, 255.0F))];
        ++total;
      }
    }
  }
  int below = 0;
  std::size_t median = 0;
  while (median < counts.size() && 2 * (below + counts[median]) < total) below += counts[median++];
  return static_cast<double>(median);
}

RimTrace RimTracer::trace(std::size_t view, const DishPose& place, int inside_sign, double min_step,
                          RimChoice choice, BoundedList<Vec2>& rays) {
  RimTrace trace;
  const RimReader reader(views_[view], params_);
  const int offsets = reader.offsets(params_.edge_reach_mm);
  rays.clear();
  for (int i = 0; i < params_.outline_points; ++i) {
    const std::span<float> steps = steps_of(view, i, offsets);
    const RimNormal rim = rim_normal(place, angle_at(i));
    if (!reader.read_steps(rim, inside_sign, steps)) continue;
    ++trace.seen;
    double index = 0.0;
    const float peak = choice == RimChoice::strongest ? peak_of(steps, index) : nearest_peak_of(steps, index);
    if (static_cast<double>(peak) < min_step) continue;
    ++trace.supported;
    const double beyond_mm = reader.offset_mm(index, offsets);
    trace.squares_mm2 += beyond_mm * beyond_mm;
    rays.push_back((views_[view].camera_from_table * rim.beyond(beyond_mm)).hnormalized());
  }
  return trace;
}

RimOutline rim_outline(const DishPose& place, const DishSearchView& camera, double beyond_mm,
                       double above_mm) {
  RimOutline outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kRimCorners;
    Vec3 point = rim_normal(place, {std::cos(angle), std::sin(angle)}).beyond(beyond_mm);
    point.z() += above_mm;
    outline[i] = camera.lens.pixel((camera.camera_from_table * point).hnormalized());
  }
  return outline;
}

RimNormal rim_normal(const DishPose& place, const Vec2& cosine_sine) {
  const Vec2 semi(0.5 * place.size_mm[0], 0.5 * place.size_mm[1]);
  const Vec2 axis = direction_of(place.azimuth_rad);
  const Vec2 normal = Vec2(semi.y() * cosine_sine.x(), semi.x() * cosine_sine.y()).normalized();
  const Vec2 at_mm = place.centre_mm + turned_by(semi.cwiseProduct(cosine_sine), axis);
  RimNormal rim;
  rim.point_mm = {at_mm.x(), at_mm.y(), place.edge_height_mm};
  rim.outward.head<2>() = turned_by(normal, axis);
  return rim;
}

}  // namespace traygauge
