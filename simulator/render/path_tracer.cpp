#include "simulator/render/path_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "simulator/render/light.hpp"

namespace traygauge {
namespace {

// Squares of SampleSequence, one for every decision about a path.
enum Decision : std::uint32_t {
  kInPixel,
  kInAperture,
  kInExposure,
  kMirrored,
  kIndirect,
  kMirroredFurther = 16,  // and those after it, two a bounce
  kIndirectFurther = 48,
  kLight = 128,     // and the number of the light
  kPenumbra = 1024  // likewise
};

constexpr float kShadowEnd = 0.9999F;  // of the way to a light: none lies on it

// Where a light's edge would hide first: just within its corners.
const std::array<Eigen::Vector2f, 4> kCorners = {Eigen::Vector2f(0.02F, 0.02F), Eigen::Vector2f(0.98F, 0.02F),
                                                 Eigen::Vector2f(0.02F, 0.98F),
                                                 Eigen::Vector2f(0.98F, 0.98F)};

Ray shadow_ray(const SurfaceHit& hit, const LightSample& light) {
  Ray ray;
  ray.origin_mm = RayScene::leave(hit, light.direction);
  ray.direction = light.direction * light.distance_mm;
  ray.end = kShadowEnd;
  return ray;
}

bool is_above(const SurfaceHit& hit, const Eigen::Vector3f& direction) {
  return hit.flat_normal.dot(direction) > 0.0F && hit.normal.dot(direction) > 0.0F;
}

// What a lit point of a light adds, before shadows.
Eigen::Vector3f lit(const SurfaceResponse& response, const LightSample& light) {
  Eigen::Vector3f factor = response.base_factor(light.direction);
  if (response.has_coat()) {
    const float share = light.density / (light.density + response.coat_density(light.direction));
    factor += share * response.coat_factor(light.direction);
  }
  return factor.cwiseProduct(light.radiance) / light.density;
}

// Shadow rays and what each adds if nothing hides the light.
struct ShadowBatch {
  static constexpr std::size_t kCapacity = 16;
  std::array<Ray, kCapacity> rays;
  std::array<Eigen::Vector3f, kCapacity> additions;
  std::array<std::uint8_t, kCapacity> is_occluded{};
  std::size_t count = 0;

  void add(const SurfaceHit& hit, const SurfaceResponse& response, const AreaLight& light,
           const Eigen::Vector2f& place) {
    const auto sample = sample_light(light, hit.point_mm, place);
    if (!sample || !is_above(hit, sample->direction)) return;
    rays[count] = shadow_ray(hit, *sample);
    additions[count] = lit(response, *sample);
    ++count;
  }

  void trace(const RayScene& scene) {
    scene.occlude({rays.data(), count}, {is_occluded.data(), count}, RayBundle::coherent);
  }

  bool is_all_alike() const {
    return std::all_of(is_occluded.begin(), is_occluded.begin() + static_cast<std::ptrdiff_t>(count),
                       [this](std::uint8_t hidden) { return hidden == is_occluded[0]; });
  }

  Eigen::Vector3f sum_of_seen(std::size_t number) const {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::size_t i = 0; i < number; ++i) {
      if (is_occluded[i] == 0) sum += additions[i];
    }
    return sum;
  }

  // Traces, sums and empties.
  Eigen::Vector3f take(const RayScene& scene) {
    trace(scene);
    const Eigen::Vector3f sum = sum_of_seen(count);
    count = 0;
    return sum;
  }
};

}  // namespace

struct PathTracer::Round {
  SampleSequence sequence{0};
  std::uint32_t first = 0;  // index of its first ray
  std::array<Ray, kRound> rays;
  std::array<SurfaceHit, kRound> hits;
  std::vector<SurfaceResponse> responses;  // of those that hit
  std::array<std::size_t, kRound> of_hit;  // whose response it is

  const SurfaceHit& hit(std::size_t response) const { return hits[of_hit[response]]; }
};

PathTracer::PathTracer(const RayScene& scene, const CameraRays& rays, const RenderSettings& settings)
    : scene_(scene),
      rays_(rays),
      settings_(settings),
      seed_(hash_of(hash_of(settings.seed), static_cast<std::uint32_t>(settings.view))) {}

PixelLight PathTracer::trace(int x, int y) const {
  PixelLight sum;
  Round round;
  round.responses.reserve(kRound);
  round.sequence =
      SampleSequence(hash_of(hash_of(seed_, static_cast<std::uint32_t>(y)), static_cast<std::uint32_t>(x)));
  const CameraRays::Pixel pixel = rays_.pixel(x, y);
  const std::uint32_t rounds = (static_cast<std::uint32_t>(settings_.samples) + kRound - 1) / kRound;
  for (std::uint32_t i = 0; i < rounds; ++i) {
    round.first = i * kRound;
    aim(round, pixel);
    add_lights(round, sum);
    add_mirrored(round, sum);
    add_indirect(round, sum);
  }
  const auto samples = static_cast<float>(rounds * kRound);
  sum.direct /= samples;
  sum.albedo /= samples;
  if (sum.indirect_count > 0) sum.indirect /= static_cast<float>(sum.indirect_count);
  return sum;
}

void PathTracer::aim(Round& round, const CameraRays::Pixel& pixel) const {
  for (std::uint32_t i = 0; i < kRound; ++i) {
    const std::uint32_t index = round.first + i;
    RaySample sample;
    sample.in_pixel = round.sequence.point(kInPixel, index);
    sample.in_aperture = round.sequence.point(kInAperture, index);
    sample.in_exposure = round.sequence.point(kInExposure, index).x();
    round.rays[i] = rays_.ray(pixel, sample);
  }
  scene_.intersect(round.rays, round.hits, RayBundle::coherent);
  round.responses.clear();
  for (std::size_t i = 0; i < kRound; ++i) {
    const SurfaceHit& hit = round.hits[i];
    if (hit.object == nullptr) continue;
    round.of_hit[round.responses.size()] = i;
    round.responses.emplace_back(hit.object->material->at(hit.point_mm, hit.normal), hit.normal,
                                 -round.rays[i].direction);
  }
}

void PathTracer::add_lights(Round& round, PixelLight& sum) const {
  const std::size_t missed = kRound - round.responses.size();
  sum.direct += static_cast<float>(missed) * scene_.scene().ambient;
  if (round.responses.empty()) return;
  const std::span<const AreaLight> lights = scene_.scene().lights;
  for (std::size_t i = 0; i < lights.size(); ++i) add_light(round, static_cast<std::uint32_t>(i), sum);
}

// A shadow ray for each ray of the round, and some to the light's corners. Where these disagree, more.
void PathTracer::add_light(Round& round, std::uint32_t number, PixelLight& sum) const {
  const AreaLight& light = scene_.scene().lights[number];
  ShadowBatch first;
  for (std::size_t i = 0; i < round.responses.size(); ++i) {
    const auto index = round.first + static_cast<std::uint32_t>(round.of_hit[i]);
    first.add(round.hit(i), round.responses[i], light, round.sequence.point(kLight + number, index));
  }
  const std::size_t own = first.count;
  for (std::size_t i = 0; i < kCorners.size(); ++i) {
    const std::size_t at = i * round.responses.size() / kCorners.size();
    first.add(round.hit(at), round.responses[at], light, kCorners[i]);
  }
  first.trace(scene_);
  const Eigen::Vector3f seen = first.sum_of_seen(own);
  if (first.is_all_alike() || settings_.penumbra_samples == 0) {
    sum.direct += seen;
    return;
  }
  const auto further = static_cast<std::uint32_t>(settings_.penumbra_samples);
  Eigen::Vector3f total = seen;
  ShadowBatch batch;
  for (std::uint32_t j = 0; j < further; ++j) {
    if (batch.count + round.responses.size() > ShadowBatch::kCapacity) total += batch.take(scene_);
    for (std::size_t i = 0; i < round.responses.size(); ++i) {
      const std::uint32_t index = (round.first + static_cast<std::uint32_t>(round.of_hit[i])) * further + j;
      batch.add(round.hit(i), round.responses[i], light, round.sequence.point(kPenumbra + number, index));
    }
  }
  total += batch.take(scene_);
  sum.direct += total / static_cast<float>(further + 1);
}

void PathTracer::add_mirrored(Round& round, PixelLight& sum) const {
  std::array<Ray, kRound> rays;
  std::array<Eigen::Vector3f, kRound> weights;
  std::array<std::size_t, kRound> responses{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < round.responses.size(); ++i) {
    const SurfaceResponse& response = round.responses[i];
    if (!response.has_coat()) continue;
    const auto index = round.first + static_cast<std::uint32_t>(round.of_hit[i]);
    const auto sample = response.sample_coat(round.sequence.point(kMirrored, index));
    if (!sample || !is_above(round.hit(i), sample->to_light)) continue;
    rays[count] = {RayScene::leave(round.hit(i), sample->to_light), sample->to_light};
    weights[count] = sample->weight;
    responses[count] = i;
    ++count;
  }
  if (count == 0) return;
  std::array<SurfaceHit, kRound> hits;
  scene_.intersect({rays.data(), count}, {hits.data(), count}, RayBundle::coherent);
  for (std::size_t k = 0; k < count; ++k) {
    const auto index = round.first + static_cast<std::uint32_t>(round.of_hit[responses[k]]);
    Eigen::Vector3f arriving =
        gather(hits[k], round.sequence, index, settings_.bounces - 1, kMirroredFurther);
    const float density = round.responses[responses[k]].coat_density(rays[k].direction);
    for (const AreaLight& light : scene_.scene().lights) {
      const auto met = meet_light(light, rays[k].origin_mm, rays[k].direction);
      if (!met || (hits[k].object != nullptr && hits[k].distance < met->distance_mm)) continue;
      arriving += met->radiance * (density / (density + met->density));
    }
    sum.direct += weights[k].cwiseProduct(arriving);
  }
}

void PathTracer::add_indirect(Round& round, PixelLight& sum) const {
  std::array<Ray, kRound> rays;
  std::array<float, kRound> entries{};
  std::array<std::uint32_t, kRound> indices{};
  const auto wanted = static_cast<std::size_t>(settings_.indirect_samples);
  std::size_t count = 0;
  for (std::size_t i = 0; i < round.responses.size(); ++i) {
    const SurfaceResponse& response = round.responses[i];
    sum.albedo += response.base_albedo();
    if (i >= wanted) continue;
    ++sum.indirect_count;
    indices[count] =
        round.first / kRound * static_cast<std::uint32_t>(wanted) + static_cast<std::uint32_t>(i);
    const Eigen::Vector3f direction =
        cosine_direction(round.hit(i).normal, round.sequence.point(kIndirect, indices[count]));
    if (!response.has_base() || !is_above(round.hit(i), direction)) continue;
    rays[count] = {RayScene::leave(round.hit(i), direction), direction};
    entries[count] = response.base_entry(direction);
    ++count;
  }
  std::array<SurfaceHit, kRound> hits;
  scene_.intersect({rays.data(), count}, {hits.data(), count}, RayBundle::scattered);
  for (std::size_t k = 0; k < count; ++k) {
    sum.indirect +=
        entries[k] * gather(hits[k], round.sequence, indices[k], settings_.bounces - 1, kIndirectFurther);
  }
}

Eigen::Vector3f PathTracer::gather(const SurfaceHit& hit, const SampleSequence& sequence, std::uint32_t index,
                                   int bounces, std::uint32_t decision) const {
  if (hit.object == nullptr) return scene_.scene().ambient;
  const Reflectance reflectance = hit.object->material->at(hit.point_mm, hit.normal);
  Eigen::Vector3f arriving = one_light(hit, sequence, index, decision);
  if (bounces > 0) {
    const Eigen::Vector3f direction = cosine_direction(hit.normal, sequence.point(decision + 2, index));
    if (is_above(hit, direction)) {
      const Ray next{RayScene::leave(hit, direction), direction};
      SurfaceHit next_hit;
      scene_.intersect({&next, 1}, {&next_hit, 1}, RayBundle::scattered);
      arriving += gather(next_hit, sequence, index, bounces - 1, decision + 3);
    }
  }
  return reflectance.base.cwiseProduct(arriving);
}

// The mean radiance that a diffuse surface gets from the lights, by one point of one of them.
Eigen::Vector3f PathTracer::one_light(const SurfaceHit& hit, const SampleSequence& sequence,
                                      std::uint32_t index, std::uint32_t decision) const {
  const std::span<const AreaLight> lights = scene_.scene().lights;
  if (lights.empty()) return Eigen::Vector3f::Zero();
  const auto count = static_cast<float>(lights.size());
  const auto drawn = static_cast<std::size_t>(sequence.point(decision, index).x() * count);
  const AreaLight& light = lights[std::min(drawn, lights.size() - 1)];
  const auto sample = sample_light(light, hit.point_mm, sequence.point(decision + 1, index));
  if (!sample || !is_above(hit, sample->direction)) return Eigen::Vector3f::Zero();
  const Ray ray = shadow_ray(hit, *sample);
  std::uint8_t is_occluded = 0;
  scene_.occlude({&ray, 1}, {&is_occluded, 1}, RayBundle::scattered);
  if (is_occluded != 0) return Eigen::Vector3f::Zero();
  const float cosine = hit.normal.dot(sample->direction);
  return sample->radiance * (count * cosine / (std::numbers::pi_v<float> * sample->density));
}

}  // namespace traygauge
