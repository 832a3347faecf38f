#include "simulator/render/light_gatherer.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "simulator/render/light.hpp"
#include "simulator/render/shadow_batch.hpp"
#include "simulator/render/surface_response.hpp"

namespace traygauge {
namespace {

constexpr float kSureWeight = 0.3F;  // paths that count for at least this go on for sure

}  // namespace

// The end of a path so far, and by how much what arrives there counts for the path.
struct LightGatherer::Leg {
  Path* path;
  SurfaceHit hit;
  Eigen::Vector3f share;
};

struct LightGatherer::Legs {
  std::array<Leg, kMostPaths> legs;
  std::size_t count = 0;

  std::span<Leg> all() { return {legs.data(), count}; }
};

void LightGatherer::gather(std::span<Path> paths, const SampleSequence& sequence,
                           std::uint32_t decision) const {
  Legs legs;
  for (Path& path : paths) {
    path.arriving.setZero();
    legs.legs[legs.count++] = {&path, path.hit, Eigen::Vector3f::Ones()};
  }
  for (int bounce = 0; legs.count > 0; ++bounce, decision += 3) {
    scatter(legs);
    add_light(legs, sequence, decision);
    if (bounce == bounces_) return;
    go_on(legs, sequence, decision);
  }
}

// Paths that left for the room end there.
void LightGatherer::scatter(Legs& legs) const {
  std::size_t kept = 0;
  for (Leg& leg : legs.all()) {
    if (leg.hit.object == nullptr) {
      leg.path->arriving += leg.share.cwiseProduct(scene_.scene().ambient);
      continue;
    }
    leg.share = leg.share.cwiseProduct(leg.hit.object->material->at(leg.hit.point_mm, leg.hit.normal).base);
    legs.legs[kept++] = leg;
  }
  legs.count = kept;
}

// By one point of one light for each path: the mean radiance that a diffuse surface gets from the lights.
void LightGatherer::add_light(Legs& legs, const SampleSequence& sequence, std::uint32_t decision) const {
  const std::span<const AreaLight> lights = scene_.scene().lights;
  if (lights.empty()) return;
  const auto light_count = static_cast<float>(lights.size());
  ShadowBatch batch;
  std::array<Path*, kMostPaths> receivers{};
  std::array<Eigen::Vector3f, kMostPaths> amounts;
  for (const Leg& leg : legs.all()) {
    const auto drawn = static_cast<std::size_t>(sequence.point(decision, leg.path->index).x() * light_count);
    const auto sample = sample_light(lights[std::min(drawn, lights.size() - 1)], leg.hit.point_mm,
                                     sequence.point(decision + 1, leg.path->index));
    if (!sample || !RayScene::is_above(leg.hit, sample->direction)) continue;
    const float cosine = leg.hit.normal.dot(sample->direction);
    receivers[batch.count] = leg.path;
    amounts[batch.count] = leg.share.cwiseProduct(sample->radiance) *
                           (light_count * cosine / (std::numbers::pi_v<float> * sample->density));
    batch.add(leg.hit, sample->direction * sample->distance_mm);
  }
  batch.trace(scene_, RayBundle::scattered);
  for (std::size_t i = 0; i < batch.count; ++i) {
    if (batch.is_occluded[i] == 0) receivers[i]->arriving += amounts[i];
  }
}

void LightGatherer::go_on(Legs& legs, const SampleSequence& sequence, std::uint32_t decision) const {
  std::array<Ray, kMostPaths> rays;
  std::size_t kept = 0;
  for (Leg& leg : legs.all()) {
    const float chance = leg.path->weight * leg.share.maxCoeff() / kSureWeight;
    if (chance < 1.0F) {
      // The second coordinate, as add_light uses the first.
      if (sequence.point(decision, leg.path->index).y() >= chance) continue;
      leg.share /= chance;
    }
    const Eigen::Vector3f direction =
        cosine_direction(leg.hit.normal, sequence.point(decision + 2, leg.path->index));
    if (!RayScene::is_above(leg.hit, direction)) continue;
    rays[kept] = {RayScene::leave(leg.hit, direction), direction};
    legs.legs[kept++] = leg;
  }
  legs.count = kept;
  std::array<SurfaceHit, kMostPaths> hits;
  scene_.intersect({rays.data(), kept}, {hits.data(), kept}, RayBundle::scattered);
  for (std::size_t i = 0; i < kept; ++i) legs.legs[i].hit = hits[i];
}

}  // namespace traygauge
