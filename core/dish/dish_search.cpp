#include "core/dish/dish_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/units.hpp"
#include "core/dish/rim_reader.hpp"
#include "core/dish/rim_votes.hpp"

namespace traygauge {
namespace {

class DishSearch {
 public:
  DishSearch(const DishSearchViews& views, const RimEdges& edges, std::span<const FoundDish> taken,
             const DishSearchParams& params, DishSearchWorkspace& workspace)
      : views_(views), edges_(edges), taken_(taken), params_(params), workspace_(workspace) {
    for (int i = 0; i < params_.outline_points; ++i) {
      workspace_.angles[static_cast<std::size_t>(i)] =
          direction_of(2.0 * std::numbers::pi * i / params_.outline_points);
    }
    for (std::size_t v = 0; v < 2; ++v) {
      cameras_[v] = views[v].camera_from_table;
      focals_px_[v] = views[v].lens.pinhole.mean_focal_px();
    }
  }

  Result<FoundDish> run(std::span<const DishModel> candidates) {
    const std::size_t count =
        vote_for_places(views_, edges_, candidates, taken_, params_, workspace_, peaks_);
    FoundDish best;
    for (RimPeak& peak : std::span(peaks_).first(count)) {
      peak.place.edge_drop_mm = params_.placement.edge_drop_mm;
      shift_to_edges(peak.inside_sign, peak.place);
      if (is_repeated(peak)) continue;
      const Result<FoundDish> confirmed = confirm(peak);
      if (!confirmed.ok() || !(confirmed->support > best.support)) continue;
      best = *confirmed;
      best.candidate = static_cast<int>(peak.dish - candidates.data());
    }
    if (best.candidate < 0) return StatusCode::rim_not_found;
    return best;
  }

 private:
  // Whether one of the peaks before was moved to the same place.
  bool is_repeated(const RimPeak& peak) const {
    return std::any_of(peaks_.data(), &peak, [&](const RimPeak& other) {
      return other.dish == peak.dish && other.inside_sign == peak.inside_sign &&
             (other.place.centre_mm - peak.place.centre_mm).norm() < params_.same_place_mm &&
             std::abs(std::remainder(other.place.azimuth_rad - peak.place.azimuth_rad, std::numbers::pi)) *
                     peak.place.size_mm[0] <
                 2.0 * params_.same_place_mm;
    });
  }

  const Vec2& angle_at(int i) const { return workspace_.angles[static_cast<std::size_t>(i)]; }

  // Only place and azimuth are free. Whatever else stands parallel to the rim, a band of its decoration or
  // the foot of its shadow, has another size.
  Result<FoundDish> confirm(const RimPeak& peak) {
    DishPose place = peak.place;
    PlacePrior prior = prior_of(*peak.dish, place.azimuth_rad, params_.placement);
    prior.information.tail<kPlaceParameters - kPlaceHeight>().setConstant(kHeldInformation);
    LevenbergMarquardtParams search;
    search.max_iterations = params_.iterations;
    double unused = 0.0;
    trace(place, peak.inside_sign, params_.min_step, unused);
    const DishOutlines outlines = {workspace_.outlines[0].items(), workspace_.outlines[1].items()};
    if (outlines[0].size() + outlines[1].size() < static_cast<std::size_t>(params_.placement.min_points))
      return StatusCode::rim_not_found;
    const DishPoseProblem problem(outlines, cameras_, focals_px_, prior, params_.scale_px, 1);
    minimise<kPlaceParameters>(problem, search, place);
    if (!as_vector(place).allFinite()) return StatusCode::rim_not_found;
    FoundDish found;
    found.place = place;
    const double noise = noise_beside(place, peak.inside_sign);
    found.support = trace(place, peak.inside_sign,
                          std::max(params_.min_step, params_.min_step_over_noise * noise), found.rms_mm);
    if (!(found.support >= params_.min_support)) return StatusCode::rim_not_found;
    return found;
  }

  // Moves the place to where most of the rim lies on an edge, in both views together.
  void shift_to_edges(int inside_sign, DishPose& place) {
    const int points = params_.outline_points;
    int offsets = 0;
    for (std::size_t v = 0; v < 2; ++v) {
      const RimReader reader(views_[v], params_);
      offsets = reader.offsets(params_.vote_reach_mm);
      for (int i = 0; i < points; ++i) {
        const std::span<float> steps = steps_of(v, i, offsets);
        if (!reader.read_steps(rim_normal(place, angle_at(i)), inside_sign, steps))
          std::fill(steps.begin(), steps.end(), 0.0F);
        for (float& step : steps) step = std::clamp(step, 0.0F, static_cast<float>(params_.sure_step));
      }
    }
    for (int i = 0; i < points; ++i) {
      const std::span<float> both = steps_of(0, i, offsets);
      const std::span<const float> second = steps_of(1, i, offsets);
      for (std::size_t k = 0; k < both.size(); ++k) both[k] += second[k];
    }
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

  std::span<float> steps_of(std::size_t view, int angle, int offsets) const {
    const std::size_t index =
        view * static_cast<std::size_t>(params_.outline_points) + static_cast<std::size_t>(angle);
    return workspace_.steps.subspan(index * kMaxRimOffsets, static_cast<std::size_t>(offsets));
  }

  void prepare_shifts(const DishPose& place) {
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

  // Of the steps of both views that were read about a place, those where the rim lies once the dish is moved,
  // to first order.
  float sum_steps(const Vec2& shift_mm, double turn_rad, int offsets) const {
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

  // Median magnitude of the steps off the rim: grain of the table, shading of the dish.
  double noise_beside(const DishPose& place, int inside_sign) {
    std::array<int, kByteValues> counts{};
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

  // Collects where the edge lies along the rim; returns the share of the rim, within the pictures, that has
  // one, and its distance from the place.
  double trace(const DishPose& place, int inside_sign, double min_step, double& rms_mm) {
    int seen = 0;
    int supported = 0;
    double squares_mm = 0.0;
    for (std::size_t v = 0; v < 2; ++v) {
      const RimReader reader(views_[v], params_);
      const int offsets = reader.offsets(params_.edge_reach_mm);
      workspace_.outlines[v].clear();
      for (int i = 0; i < params_.outline_points; ++i) {
        const std::span<float> steps = steps_of(v, i, offsets);
        if (!reader.read_steps(rim_normal(place, angle_at(i)), inside_sign, steps)) continue;
        ++seen;
        double index = 0.0;
        if (static_cast<double>(peak_of(steps, index)) < min_step) continue;
        ++supported;
        const double beyond_mm = reader.offset_mm(index, offsets);
        squares_mm += beyond_mm * beyond_mm;
        const Vec3 point = views_[v].camera_from_table * rim_normal(place, angle_at(i)).beyond(beyond_mm);
        workspace_.outlines[v].push_back(point.hnormalized());
      }
    }
    rms_mm = supported > 0 ? std::sqrt(squares_mm / supported) : 0.0;
    return seen > 0 ? static_cast<double>(supported) / seen : 0.0;
  }

  // The largest value, and where it lies between the samples, by a parabola.
  static float peak_of(std::span<const float> steps, double& index) {
    const auto best = static_cast<std::size_t>(std::max_element(steps.begin(), steps.end()) - steps.begin());
    index = static_cast<double>(best);
    if (best == 0 || best + 1 == steps.size()) return steps[best];
    const float bend = steps[best - 1] - 2.0F * steps[best] + steps[best + 1];
    if (bend < 0.0F) index += 0.5 * static_cast<double>((steps[best - 1] - steps[best + 1]) / bend);
    return steps[best];
  }

  const DishSearchViews& views_;
  const RimEdges& edges_;
  std::span<const FoundDish> taken_;
  const DishSearchParams& params_;
  DishSearchWorkspace& workspace_;
  TableCameras cameras_;
  FocalsPx focals_px_{};
  std::array<RimPeak, kMaxRimPeaks> peaks_;
};

}  // namespace

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

Result<FoundDish> search_dish(const DishSearchViews& views, const RimEdges& edges,
                              std::span<const DishModel> candidates, std::span<const FoundDish> taken,
                              const DishSearchParams& params, DishSearchWorkspace& workspace) {
  return DishSearch(views, edges, taken, params, workspace).run(candidates);
}

}  // namespace traygauge
