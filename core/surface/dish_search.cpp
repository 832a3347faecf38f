#include "core/surface/dish_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/surface/rim_ballot.hpp"
#include "core/surface/rim_reader.hpp"

namespace traygauge {
namespace {

constexpr double kRoundMm = 0.5;  // axes that differ by less are a round dish's
constexpr double kHold = 1e4;     // 1 / mm², of what is described
constexpr std::size_t kMaxPeaks = 16;

// A place that the edges vote for.
struct Peak {
  const DishModel* dish = nullptr;
  DishPlace place;
  int inside_sign = 1;  // 1: brighter inside the rim
  double votes_per_mm = -1.0;
};

Vec2 direction_of(double azimuth_rad) {
  return {std::cos(azimuth_rad), std::sin(azimuth_rad)};
}

class Level {
 public:
  Level(const Pose& camera_from_table, double height_mm)
      : table_from_camera_(camera_from_table.rotation.transpose()),
        centre_mm_(camera_centre_mm(camera_from_table)),
        height_mm_(height_mm) {}

  bool meet(const Vec2& ray, Vec2& place_mm) const {
    const Vec3 direction = table_from_camera_ * ray.homogeneous();
    const double depth = (height_mm_ - centre_mm_.z()) / direction.z();
    place_mm = centre_mm_.head<2>() + depth * direction.head<2>();
    return depth > 0.0 && place_mm.allFinite();
  }

  bool meet(const RimEdge& edge, RimLevelEdge& at) const {
    Vec2 along_mm;
    if (!meet(edge.ray, at.place_mm) || !meet(edge.along, along_mm)) return false;
    const Vec2 along = along_mm - at.place_mm;
    // The picture of the table is seen from above, with y turned over: left in the one is right in the other.
    at.brighter = Vec2(-along.y(), along.x()).normalized();
    return at.brighter.allFinite();
  }

 private:
  Mat3 table_from_camera_;
  Vec3 centre_mm_;
  double height_mm_;
};

class DishSearch {
 public:
  DishSearch(const DishSearchViews& views, std::span<const FoundDish> taken, const DishSearchParams& params,
             DishSearchWorkspace& workspace)
      : views_(views), taken_(taken), params_(params), workspace_(workspace) {
    for (std::size_t v = 0; v < 2; ++v) {
      cameras_[v] = views[v].camera_from_table;
      focals_px_[v] = views[v].lens.pinhole.mean_focal_px();
    }
  }

  Status run(std::span<const DishModel> candidates, FoundDish& found) {
    for (const DishModel& dish : candidates) vote_for(dish);
    Status status = StatusCode::rim_not_found;
    for (const Peak& peak : peaks()) {
      FoundDish tried;
      if (!confirm(peak, tried).ok() || !(tried.support > found.support)) continue;
      found = tried;
      found.candidate = static_cast<int>(peak.dish - candidates.data());
      status = StatusCode::ok;
    }
    return status;
  }

 private:
  std::span<const Peak> peaks() const { return std::span(peaks_).first(peak_count_); }

  // The middle of what both views see of the table.
  Vec2 middle_mm(double height_mm) const {
    Vec2 sum = Vec2::Zero();
    for (std::size_t v = 0; v < 2; ++v) {
      Vec2 place = Vec2::Zero();
      const LensModel& lens = views_[v].lens;
      const Vec2 ray = lens.pinhole.ray(Vec2(0.5 * lens.width, 0.5 * lens.height));
      if (Level(cameras_[v], height_mm).meet(ray, place)) sum += 0.5 * place;
    }
    return sum;
  }

  bool is_free(const Vec2& centre_mm, const DishModel& dish) const {
    const double radius = 0.5 * std::min(dish.outer_size_mm[0], dish.outer_size_mm[1]);
    return std::all_of(taken_.begin(), taken_.end(), [&](const FoundDish& other) {
      const DishPlace& place = other.place;
      const double sum = radius + 0.5 * std::min(place.size_mm[0], place.size_mm[1]);
      return (centre_mm - place.centre_mm).norm() >= (1.0 - params_.max_overlap) * sum;
    });
  }

  void vote_for(const DishModel& dish) {
    const double height_mm = edge_height_mm(dish);
    const Vec2 semi(0.5 * dish.outer_size_mm[0], 0.5 * dish.outer_size_mm[1]);
    const bool is_round = std::abs(semi.x() - semi.y()) < kRoundMm;
    const int azimuths = is_round ? 1 : params_.azimuths;
    Ballot ballot(middle_mm(height_mm), params_, workspace_.votes);
    const double perimeter_mm = std::numbers::pi * (semi.x() + semi.y());
    lay_edges(height_mm);
    for (int a = 0; a < azimuths; ++a) {
      const double azimuth_rad = std::numbers::pi * a / azimuths;
      const Vec2 axis = direction_of(azimuth_rad);
      for (const int inside_sign : {1, -1}) {
        ballot.clear();
        for (const RimLevelEdge& at : workspace_.level_edges) {
          const Vec2 outward = -inside_sign * at.brighter;
          const Vec2 normal = turned_back_by(outward, axis);
          const Vec2 on_axes = semi.cwiseAbs2().cwiseProduct(normal) / semi.cwiseProduct(normal).norm();
          ballot.vote(at.place_mm - turned_by(on_axes, axis));
        }
        Peak peak{&dish, {}, inside_sign, 0.0};
        const int most =
            ballot.most([&](const Vec2& centre) { return is_free(centre, dish); }, peak.place.centre_mm);
        peak.place.azimuth_rad = azimuth_rad;
        peak.place.edge_height_mm = height_mm;
        peak.place.size_mm = dish.outer_size_mm;
        peak.votes_per_mm = most / perimeter_mm;
        keep(peak);
      }
    }
  }

  // The edges of both views on one level of the table frame.
  void lay_edges(double height_mm) {
    workspace_.level_edges.clear();
    for (std::size_t v = 0; v < 2; ++v) {
      const Level level(cameras_[v], height_mm);
      for (const RimEdge& edge : workspace_.edges[v]) {
        RimLevelEdge at;
        if (level.meet(edge, at)) workspace_.level_edges.push_back(at);
      }
    }
  }

  // Keeps the best few, best first.
  void keep(const Peak& peak) {
    const auto limit = std::min(kMaxPeaks, static_cast<std::size_t>(std::max(params_.max_peaks, 1)));
    std::size_t at = peak_count_;
    while (at > 0 && peaks_[at - 1].votes_per_mm < peak.votes_per_mm) --at;
    if (at >= limit) return;
    peak_count_ = std::min(peak_count_ + 1, limit);
    for (std::size_t i = peak_count_ - 1; i > at; --i) peaks_[i] = peaks_[i - 1];
    peaks_[at] = peak;
  }

  Vec2 angle_at(int i) const { return direction_of(2.0 * std::numbers::pi * i / params_.outline_points); }

  // Only place and azimuth are free. Whatever else stands parallel to the rim, a band of its decoration or
  // the foot of its shadow, has another size.
  Status confirm(const Peak& peak, FoundDish& found) {
    DishPlace place = peak.place;
    place.edge_drop_mm = params_.placement.edge_drop_mm;
    shift_to_edges(peak, place);
    PlacePrior prior = prior_of(*peak.dish, place.azimuth_rad, params_.placement);
    prior.information.tail<kPlaceParameters - kPlaceHeight>().setConstant(kHold);
    LevenbergMarquardtParams search;
    search.max_iterations = params_.iterations;
    double unused = 0.0;
    trace(place, peak.inside_sign, params_.min_step, unused);
    const DishOutlines outlines = {workspace_.outlines[0].items(), workspace_.outlines[1].items()};
    if (outlines[0].size() + outlines[1].size() < static_cast<std::size_t>(params_.placement.min_points))
      return StatusCode::rim_not_found;
    const PlacementProblem problem(outlines, cameras_, focals_px_, prior, params_.placement.point_sigma_px,
                                   params_.scale_px, 1);
    minimise<kPlaceParameters>(problem, search, place);
    if (!as_vector(place).allFinite()) return StatusCode::rim_not_found;
    found.place = place;
    const double noise = noise_beside(place, peak.inside_sign);
    found.support = trace(place, peak.inside_sign,
                          std::max(params_.min_step, params_.min_step_over_noise * noise), found.rms_mm);
    return found.support >= params_.min_support ? StatusCode::ok : StatusCode::rim_not_found;
  }

  // Moves the place to where most of the rim lies on an edge, in both views together.
  void shift_to_edges(const Peak& peak, DishPlace& place) {
    const int points = params_.outline_points;
    int offsets = 0;
    for (std::size_t v = 0; v < 2; ++v) {
      const RimReader reader(views_[v], params_);
      offsets = reader.offsets(params_.vote_reach_mm);
      for (int i = 0; i < points; ++i) {
        const std::span<float> steps = steps_of(v, i, offsets);
        if (!reader.read_steps(place, angle_at(i), peak.inside_sign, steps))
          std::fill(steps.begin(), steps.end(), 0.0F);
        for (float& step : steps) step = std::clamp(step, 0.0F, static_cast<float>(params_.sure_step));
      }
    }
    const bool is_round = std::abs(place.size_mm[0] - place.size_mm[1]) < kRoundMm;
    const int turns = is_round ? 0 : params_.azimuth_steps / 2;
    const double turn_step_rad = std::numbers::pi / params_.azimuths / std::max(1, params_.azimuth_steps - 1);
    const int shifts = static_cast<int>(0.8 * params_.vote_reach_mm / params_.shift_step_mm);
    float most = -1.0F;
    DishPlace best = place;
    for (int turn = -turns; turn <= turns; ++turn) {
      for (int dy = -shifts; dy <= shifts; ++dy) {
        for (int dx = -shifts; dx <= shifts; ++dx) {
          DishPlace moved = place;
          moved.centre_mm += params_.shift_step_mm * Vec2(dx, dy);
          moved.azimuth_rad += turn * turn_step_rad;
          const float sum = sum_steps(place, moved, offsets);
          if (sum <= most) continue;
          most = sum;
          best = moved;
        }
      }
    }
    place = best;
  }

  std::span<float> steps_of(std::size_t view, int angle, int offsets) {
    const std::size_t index =
        view * static_cast<std::size_t>(params_.outline_points) + static_cast<std::size_t>(angle);
    return workspace_.steps.subspan(index * kMaxRimOffsets, static_cast<std::size_t>(offsets));
  }

  // Of the steps that were read about `place`, those where the rim of `moved` lies, to first order.
  float sum_steps(const DishPlace& place, const DishPlace& moved, int offsets) {
    const Vec2 on_axes = turned_back_by(moved.centre_mm - place.centre_mm, direction_of(place.azimuth_rad));
    const double turn = moved.azimuth_rad - place.azimuth_rad;
    const Vec2 semi(0.5 * place.size_mm[0], 0.5 * place.size_mm[1]);
    float sum = 0.0F;
    for (int i = 0; i < params_.outline_points; ++i) {
      const Vec2 angle = angle_at(i);
      const Vec2 normal = Vec2(semi.y() * angle.x(), semi.x() * angle.y()).normalized();
      const Vec2 point = semi.cwiseProduct(angle);
      const double beyond_mm = normal.dot(on_axes + turn * Vec2(-point.y(), point.x()));
      const int at = offsets / 2 + static_cast<int>(std::lround(beyond_mm / params_.sample_mm));
      if (at < 0 || at >= offsets) continue;
      for (std::size_t v = 0; v < 2; ++v) sum += steps_of(v, i, offsets)[static_cast<std::size_t>(at)];
    }
    return sum;
  }

  // Median magnitude of the steps off the rim: grain of the table, shading of the dish.
  double noise_beside(const DishPlace& place, int inside_sign) {
    std::array<int, 256> counts{};
    int total = 0;
    for (std::size_t v = 0; v < 2; ++v) {
      const RimReader reader(views_[v], params_);
      const int offsets = reader.offsets(params_.vote_reach_mm);
      for (int i = 0; i < params_.outline_points; ++i) {
        const std::span<float> steps = steps_of(v, i, offsets);
        if (!reader.read_steps(place, angle_at(i), inside_sign, steps)) continue;
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
  double trace(const DishPlace& place, int inside_sign, double min_step, double& rms_mm) {
    int seen = 0;
    int supported = 0;
    double squares_mm = 0.0;
    for (std::size_t v = 0; v < 2; ++v) {
      const RimReader reader(views_[v], params_);
      const int offsets = reader.offsets(params_.edge_reach_mm);
      workspace_.outlines[v].clear();
      for (int i = 0; i < params_.outline_points; ++i) {
        const std::span<float> steps = steps_of(v, i, offsets);
        if (!reader.read_steps(place, angle_at(i), inside_sign, steps)) continue;
        ++seen;
        double index = 0.0;
        if (static_cast<double>(peak_of(steps, index)) < min_step) continue;
        ++supported;
        const double beyond_mm = reader.offset_mm(index, offsets);
        squares_mm += beyond_mm * beyond_mm;
        const Vec3 point = views_[v].camera_from_table * rim_point_mm(place, angle_at(i), beyond_mm);
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
  std::span<const FoundDish> taken_;
  const DishSearchParams& params_;
  DishSearchWorkspace& workspace_;
  TableCameras cameras_;
  FocalsPx focals_px_{};
  std::array<Peak, kMaxPeaks> peaks_;
  std::size_t peak_count_ = 0;
};

}  // namespace

Vec3 rim_point_mm(const DishPlace& place, const Vec2& cosine_sine, double beyond_mm) {
  const Vec2 semi(0.5 * place.size_mm[0], 0.5 * place.size_mm[1]);
  const Vec2 normal = Vec2(semi.y() * cosine_sine.x(), semi.x() * cosine_sine.y()).normalized();
  const Vec2 on_axes = semi.cwiseProduct(cosine_sine) + beyond_mm * normal;
  const Vec2 at_mm = place.centre_mm + turned_by(on_axes, direction_of(place.azimuth_rad));
  return {at_mm.x(), at_mm.y(), place.edge_height_mm};
}

Status search_dish(const DishSearchViews& views, std::span<const DishModel> candidates,
                   std::span<const FoundDish> taken, const DishSearchParams& params,
                   DishSearchWorkspace& workspace, FoundDish& found) {
  found = {};
  return DishSearch(views, taken, params, workspace).run(candidates, found);
}

}  // namespace traygauge
