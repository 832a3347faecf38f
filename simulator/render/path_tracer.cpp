#include "simulator/render/path_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "simulator/render/light.hpp"
#include "simulator/render/shadow_batch.hpp"

namespace traygauge {
namespace {

// Squares of SampleSequence, one for every decision about a path.
enum Decision : std::uint32_t {
  place_in_pixel,
  place_in_aperture,
  time_in_exposure,
  mirrored_way,
  indirect_way,
  light_place,
  mirrored_further = 16,  // and those after it, three a bounce
  indirect_further = 48,
  penumbra_place = 128  // and the number of the light
};

constexpr float kJump_px = 4.0F;  // a surface that jumps by more is more than one

// Where a light's edge would hide first: just within its corners.
const std::array<Eigen::Vector2f, 4> kCorners = {Eigen::Vector2f(0.02F, 0.02F), Eigen::Vector2f(0.98F, 0.02F),
                                                 Eigen::Vector2f(0.02F, 0.98F),
                                                 Eigen::Vector2f(0.98F, 0.98F)};

// What a light adds, before shadows: to the base from the whole light where it is in full view, to the coat
// by a point of it.
Eigen::Vector3f lit(const SurfaceResponse& response, const SurfaceHit& hit, const LightSample& light,
                    const LightQuadrature& whole) {
  Eigen::Vector3f factor = Eigen::Vector3f::Zero();
  if (response.has_base()) {
    const auto irradiance = whole.irradiance(hit.point_mm, hit.normal);
    if (irradiance) {
      const float entering = response.base_entry(light.direction) * *irradiance;
      factor = response.base_albedo() * (entering * std::numbers::inv_pi_v<float>);
    } else {
      factor = response.base_factor(light.direction) / light.density;
    }
  }
  if (response.has_coat()) {
    const SurfaceResponse::CoatFactor coat = response.coat_factor(light.direction);
    factor += coat.factor / (light.density + (response.is_sharp() ? coat.density : 0.0F));
  }
  return factor.cwiseProduct(light.radiance);
}

// How strongly a point of a light shines on a surface, in any unit that the light's points share.
float light_weight(const AreaLight& light, const SurfaceHit& hit, const Eigen::Vector3f& way_mm) {
  const float square = way_mm.squaredNorm();
  return -light.edge_u_mm.cross(light.edge_v_mm).dot(way_mm) * hit.normal.dot(way_mm) / (square * square);
}

// How much a surface counts in a mean over a pixel's: as it shows. Black and metal a little, so that they
// have a mean.
Eigen::Vector3f shade_color(const SurfaceResponse& response) {
  return response.base_albedo() + Eigen::Vector3f::Constant(1e-3F);
}

}  // namespace

struct PathTracer::Round {
  SampleSequence sequence{0};
  std::uint32_t first = 0;  // index of its first ray
  std::array<Ray, kRound> rays;
  std::array<SurfaceHit, kRound> hits;
  std::vector<SurfaceResponse> responses;            // of those that hit
  std::array<std::size_t, kRound> of_hit;            // whose response it is
  std::array<Eigen::Vector2f, kRound> light_places;  // on all lights, by response

  const SurfaceHit& hit(std::size_t response) const { return hits[of_hit[response]]; }
  std::uint32_t index(std::size_t response) const {
    return first + static_cast<std::uint32_t>(of_hit[response]);
  }
};

struct PathTracer::Sum {
  Eigen::Vector3f direct = Eigen::Vector3f::Zero();
  Eigen::Vector3f albedo = Eigen::Vector3f::Zero();
  Eigen::Vector3f indirect = Eigen::Vector3f::Zero();  // weighed
  Eigen::Vector3f weights = Eigen::Vector3f::Zero();
  SurfaceHit first;
  bool is_one_surface = true;
};

PathTracer::PathTracer(const RayScene& scene, const CameraRays& rays, const RenderSettings& settings)
    : scene_(scene),
      rays_(rays),
      settings_(settings),
      quadratures_(scene.scene().lights.begin(), scene.scene().lights.end()),
      seed_(hash_of(hash_of(settings.seed), static_cast<std::uint32_t>(settings.view))) {}

PixelLight PathTracer::trace(int x, int y, int samples) const {
  Sum sum;
  Round round;
  round.responses.reserve(kRound);
  round.sequence =
      SampleSequence(hash_of(hash_of(seed_, static_cast<std::uint32_t>(y)), static_cast<std::uint32_t>(x)));
  const CameraRays::Pixel pixel = rays_.pixel(x, y);
  const std::uint32_t rounds = (static_cast<std::uint32_t>(samples) + kRound - 1) / kRound;
  for (std::uint32_t i = 0; i < rounds; ++i) {
    round.first = i * kRound;
    aim(round, pixel);
    look_for_steps(round, sum);
    add_lights(round, sum);
    add_mirrored(round, sum);
    add_indirect(round, sum);
  }
  const auto count = static_cast<float>(rounds * kRound);
  PixelLight light;
  light.direct = sum.direct / count;
  light.albedo = sum.albedo / count;
  if (sum.weights.minCoeff() > 0.0F) light.indirect = sum.indirect.cwiseQuotient(sum.weights);
  light.is_one_surface = sum.is_one_surface;
  return light;
}

// All rays must meet the plane of the first one's surface, within a few pixels' widths.
void PathTracer::look_for_steps(const Round& round, Sum& sum) const {
  if (round.first == 0) sum.first = round.hits[0];
  const float most_mm = kJump_px * rays_.pixel_width() * sum.first.distance;
  for (const SurfaceHit& hit : round.hits) {
    const float off_mm = std::abs(sum.first.normal.dot(hit.point_mm - sum.first.point_mm));
    if (hit.object != sum.first.object || off_mm > most_mm) sum.is_one_surface = false;
  }
}

void PathTracer::aim(Round& round, const CameraRays::Pixel& pixel) const {
  for (std::uint32_t i = 0; i < kRound; ++i) {
    const std::uint32_t index = round.first + i;
    RaySample sample;
    sample.in_pixel = round.sequence.point(place_in_pixel, index);
    if (rays_.has_aperture()) sample.in_aperture = round.sequence.point(place_in_aperture, index);
    if (rays_.moves()) sample.in_exposure = round.sequence.point(time_in_exposure, index).x();
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

void PathTracer::add_lights(Round& round, Sum& sum) const {
  const std::size_t missed = kRound - round.responses.size();
  sum.direct += static_cast<float>(missed) * scene_.scene().ambient;
  if (round.responses.empty()) return;
  for (std::size_t i = 0; i < round.responses.size(); ++i) {
    round.light_places[i] = round.sequence.point(light_place, round.index(i));
  }
  const std::span<const AreaLight> lights = scene_.scene().lights;
  for (std::size_t i = 0; i < lights.size(); ++i) add_light(round, static_cast<std::uint32_t>(i), sum);
}

// A shadow ray for each ray of the round, and some to the light's corners. Where these disagree, many more
// tell how much of the light is seen.
void PathTracer::add_light(Round& round, std::uint32_t number, Sum& sum) const {
  const AreaLight& light = scene_.scene().lights[number];
  ShadowBatch batch;
  std::array<Eigen::Vector3f, kRound> additions;
  for (std::size_t i = 0; i < round.responses.size(); ++i) {
    const SurfaceHit& hit = round.hit(i);
    const auto sample = sample_light(light, hit.point_mm, round.light_places[i]);
    if (!sample || !RayScene::is_above(hit, sample->direction)) continue;
    additions[batch.count] = lit(round.responses[i], hit, *sample, quadratures_[number]);
    batch.add(hit, sample->direction * sample->distance_mm);
  }
  const std::size_t own = batch.count;
  for (std::size_t i = 0; i < kCorners.size(); ++i) {
    const SurfaceHit& hit = round.hit(i * round.responses.size() / kCorners.size());
    const Eigen::Vector3f way_mm = way_to_light(light, hit.point_mm, kCorners[i]);
    if (RayScene::is_above(hit, way_mm)) batch.add(hit, way_mm);
  }
  batch.trace(scene_);
  const bool is_penumbra = !batch.is_all_alike() && settings_.penumbra_samples > 0;
  Eigen::Vector3f total = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < own; ++i) {
    if (is_penumbra || batch.is_occluded[i] == 0) total += additions[i];
  }
  if (is_penumbra) total = total.cwiseProduct(seen_share(round, number));
  sum.direct += total;
}

// Of a light, as the round's surfaces see it together.
Eigen::Vector3f PathTracer::seen_share(const Round& round, std::uint32_t number) const {
  const AreaLight& light = scene_.scene().lights[number];
  const auto samples = static_cast<std::uint32_t>(settings_.penumbra_samples);
  Visibility visibility;
  ShadowBatch batch;
  std::array<Eigen::Vector3f, ShadowBatch::kCapacity> amounts;
  const auto trace_batch = [&] {
    batch.trace(scene_);
    for (std::size_t k = 0; k < batch.count; ++k) visibility.add(amounts[k], batch.is_occluded[k] != 0);
    batch.count = 0;
  };
  for (std::size_t i = 0; i < round.responses.size(); ++i) {
    const SurfaceHit& hit = round.hit(i);
    const Eigen::Vector3f color = shade_color(round.responses[i]);
    for (std::uint32_t j = 0; j < samples; ++j) {
      const Eigen::Vector2f place =
          round.sequence.point(penumbra_place + number, round.index(i) * samples + j);
      const Eigen::Vector3f way_mm = way_to_light(light, hit.point_mm, place);
      const float weight = light_weight(light, hit, way_mm);
      if (!(weight > 0.0F) || !RayScene::is_above(hit, way_mm)) continue;
      amounts[batch.count] = weight * color;
      batch.add(hit, way_mm);
      if (batch.is_full()) trace_batch();
    }
  }
  trace_batch();
  if (!(visibility.all.minCoeff() > 0.0F)) return Eigen::Vector3f::Zero();
  return visibility.seen.cwiseQuotient(visibility.all);
}

void PathTracer::add_mirrored(Round& round, Sum& sum) const {
  const std::span<const AreaLight> lights = scene_.scene().lights;
  std::array<Ray, kRound> rays;
  std::array<SurfaceResponse::CoatSample, kRound> samples;
  std::array<bool, kRound> is_sharp{};
  std::array<std::uint32_t, kRound> indices{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < round.responses.size(); ++i) {
    const SurfaceResponse& response = round.responses[i];
    if (!response.has_coat()) continue;
    // A rough coat mirrors lights as add_light sees them, and its surroundings so evenly that half of the
    // rays will do.
    const bool is_halved = !response.is_sharp();
    if (is_halved && round.of_hit[i] >= kRound / 2) continue;
    const std::uint32_t index = round.index(i) - (is_halved ? round.first / 2 : 0);
    auto sample = response.sample_coat(round.sequence.point(mirrored_way, index));
    if (!sample || !RayScene::is_above(round.hit(i), sample->to_light)) continue;
    if (is_halved) sample->weight *= 2.0F;
    rays[count] = {RayScene::leave(round.hit(i), sample->to_light), sample->to_light};
    samples[count] = *sample;
    is_sharp[count] = response.is_sharp();
    indices[count++] = index;
  }
  std::array<SurfaceHit, kRound> hits;
  scene_.intersect({rays.data(), count}, {hits.data(), count}, RayBundle::coherent);
  for (std::size_t k = 0; k < count; ++k) {
    Eigen::Vector3f arriving =
        gather(hits[k], round.sequence, indices[k], settings_.bounces - 1, mirrored_further);
    for (const AreaLight& light : is_sharp[k] ? lights : lights.first(0)) {
      const auto met = meet_light(light, rays[k].origin_mm, rays[k].direction);
      if (!met || (hits[k].object != nullptr && hits[k].distance < met->distance_mm)) continue;
      arriving += met->radiance * (samples[k].density / (samples[k].density + met->density));
    }
    sum.direct += samples[k].weight.cwiseProduct(arriving);
  }
}

void PathTracer::add_indirect(Round& round, Sum& sum) const {
  std::array<Ray, kRound> rays;
  std::array<Eigen::Vector3f, kRound> weights;
  std::array<std::uint32_t, kRound> indices{};
  // The further rays of a pixel at an edge are for what is sharp.
  const bool is_further = round.first >= static_cast<std::uint32_t>(settings_.samples);
  const auto wanted = static_cast<std::size_t>(is_further ? (settings_.indirect_samples + 3) / 4
                                                          : settings_.indirect_samples);
  std::size_t count = 0;
  for (std::size_t i = 0; i < round.responses.size(); ++i) {
    const SurfaceResponse& response = round.responses[i];
    sum.albedo += response.base_albedo();
    if (i >= wanted || response.is_metal()) continue;
    const Eigen::Vector3f weight = shade_color(response);
    sum.weights += weight;
    indices[count] = round.first + static_cast<std::uint32_t>(i);
    const Eigen::Vector3f direction =
        cosine_direction(round.hit(i).normal, round.sequence.point(indirect_way, indices[count]));
    if (!RayScene::is_above(round.hit(i), direction)) continue;
    rays[count] = {RayScene::leave(round.hit(i), direction), direction};
    weights[count++] = weight * response.base_entry(direction);
  }
  std::array<SurfaceHit, kRound> hits;
  scene_.intersect({rays.data(), count}, {hits.data(), count}, RayBundle::scattered);
  for (std::size_t k = 0; k < count; ++k) {
    sum.indirect += weights[k].cwiseProduct(
        gather(hits[k], round.sequence, indices[k], settings_.bounces - 1, indirect_further));
  }
}

Eigen::Vector3f PathTracer::gather(const SurfaceHit& hit, const SampleSequence& sequence, std::uint32_t index,
                                   int bounces, std::uint32_t decision) const {
  if (hit.object == nullptr) return scene_.scene().ambient;
  const Reflectance reflectance = hit.object->material->at(hit.point_mm, hit.normal);
  Eigen::Vector3f arriving = one_light(hit, sequence, index, decision);
  if (bounces > 0) {
    const Eigen::Vector3f direction = cosine_direction(hit.normal, sequence.point(decision + 2, index));
    if (RayScene::is_above(hit, direction)) {
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
  if (!sample || !RayScene::is_above(hit, sample->direction)) return Eigen::Vector3f::Zero();
  ShadowBatch batch;
  batch.add(hit, sample->direction * sample->distance_mm);
  batch.trace(scene_);
  if (batch.is_occluded[0] != 0) return Eigen::Vector3f::Zero();
  const float cosine = hit.normal.dot(sample->direction);
  return sample->radiance * (count * cosine / (std::numbers::pi_v<float> * sample->density));
}

}  // namespace traygauge
