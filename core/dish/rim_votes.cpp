#include "core/dish/rim_votes.hpp"

#include <algorithm>
#include <numbers>

#include "core/dish/rim_ballot.hpp"

namespace traygauge {
namespace {

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

class Vote {
 public:
  Vote(const DishSearchViews& views, const RimEdges& edges, std::span<const FoundDish> taken,
       const DishSearchParams& params, DishSearchWorkspace& workspace, std::span<RimPeak> peaks)
      : views_(views), edges_(edges), taken_(taken), params_(params), workspace_(workspace), peaks_(peaks) {}

  void vote_for(const DishModel& dish) {
    const double height_mm = edge_height_mm(dish);
    const Vec2 semi(0.5 * dish.outer_size_mm[0], 0.5 * dish.outer_size_mm[1]);
    const int azimuths = is_round_dish(dish.outer_size_mm) ? 1 : params_.azimuths;
    std::array<Ballot, 2> ballots = {Ballot(middle_mm(height_mm), params_, workspace_.votes[0]),
                                     Ballot(middle_mm(height_mm), params_, workspace_.votes[1])};
    const double perimeter_mm = std::numbers::pi * (semi.x() + semi.y());
    lay_edges(height_mm);
    for (int a = 0; a < azimuths; ++a) {
      const double azimuth_rad = std::numbers::pi * a / azimuths;
      const Vec2 axis = direction_of(azimuth_rad);
      for (Ballot& ballot : ballots) ballot.clear();
      for (const RimLevelEdge& at : workspace_.level_edges) {
        const Vec2 normal = turned_back_by(at.brighter, axis);
        const Vec2 on_axes = semi.cwiseAbs2().cwiseProduct(normal) / semi.cwiseProduct(normal).norm();
        const Vec2 to_brighter = turned_by(on_axes, axis);
        ballots[0].vote(at.place_mm + to_brighter);
        ballots[1].vote(at.place_mm - to_brighter);
      }
      for (std::size_t b = 0; b < ballots.size(); ++b) {
        RimPeak peak{&dish, {}, b == 0 ? 1 : -1, 0.0};
        const int most =
            ballots[b].most([&](const Vec2& centre) { return is_free(centre, dish); }, peak.place.centre_mm);
        peak.place.azimuth_rad = azimuth_rad;
        peak.place.edge_height_mm = height_mm;
        peak.place.size_mm = dish.outer_size_mm;
        peak.votes_per_mm = most / perimeter_mm;
        keep(peak);
      }
    }
  }

  std::size_t count() const { return count_; }

 private:
  // The middle of what both views see of the table.
  Vec2 middle_mm(double height_mm) const {
    Vec2 sum = Vec2::Zero();
    for (std::size_t v = 0; v < 2; ++v) {
      Vec2 place = Vec2::Zero();
      const LensModel& lens = views_[v].lens;
      const Vec2 ray = lens.pinhole.ray(Vec2(0.5 * lens.width, 0.5 * lens.height));
      if (Level(views_[v].camera_from_table, height_mm).meet(ray, place)) sum += 0.5 * place;
    }
    return sum;
  }

  bool is_free(const Vec2& centre_mm, const DishModel& dish) const {
    const double radius = 0.5 * std::min(dish.outer_size_mm[0], dish.outer_size_mm[1]);
    return std::all_of(taken_.begin(), taken_.end(), [&](const FoundDish& other) {
      const DishPose& place = other.place;
      const double sum = radius + 0.5 * std::min(place.size_mm[0], place.size_mm[1]);
      return (centre_mm - place.centre_mm).norm() >= sum;
    });
  }

  // The edges of both views on one level of the table frame.
  void lay_edges(double height_mm) {
    workspace_.level_edges.clear();
    for (std::size_t v = 0; v < 2; ++v) {
      const Level level(views_[v].camera_from_table, height_mm);
      for (const RimEdge& edge : edges_[v]) {
        RimLevelEdge at;
        if (level.meet(edge, at)) workspace_.level_edges.push_back(at);
      }
    }
  }

  // Keeps the best, best first.
  void keep(const RimPeak& peak) {
    std::size_t at = count_;
    while (at > 0 && peaks_[at - 1].votes_per_mm < peak.votes_per_mm) --at;
    if (at >= peaks_.size()) return;
    count_ = std::min(count_ + 1, peaks_.size());
    for (std::size_t i = count_ - 1; i > at; --i) peaks_[i] = peaks_[i - 1];
    peaks_[at] = peak;
  }

  const DishSearchViews& views_;
  const RimEdges& edges_;
  std::span<const FoundDish> taken_;
  const DishSearchParams& params_;
  DishSearchWorkspace& workspace_;
  std::span<RimPeak> peaks_;
  std::size_t count_ = 0;
};

}  // namespace

std::size_t vote_for_places(const DishSearchViews& views, const RimEdges& edges,
                            std::span<const DishModel> candidates, std::span<const FoundDish> taken,
                            const DishSearchParams& params, DishSearchWorkspace& workspace,
                            std::span<RimPeak> peaks) {
  Vote vote(views, edges, taken, params, workspace, peaks);
  for (const DishModel& dish : candidates) vote.vote_for(dish);
  return vote.count();
}

}  // namespace traygauge
