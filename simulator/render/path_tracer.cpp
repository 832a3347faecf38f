#include "simulator/render/path_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "simulator/render/block_sequence.hpp"
#include "simulator/render/light.hpp"
#include "simulator/render/lit_surface.hpp"
#include "simulator/render/ray_spread.hpp"
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

constexpr float kSmoothed_px = 3.0F;  // radius of a filter from which on neighbours count for a pixel
constexpr float kBusySpreads = 3.0F;  // of calm_spread: pixels above get the most rays
constexpr float kJump_px = 4.0F;      // a surface that jumps by more is more than one

// Where a light's edge would hide first: just within its corners.
const std::array<Eigen::Vector2f, 4> kCorners = {Eigen::Vector2f(0.02F, 0.02F), Eigen::Vector2f(0.98F, 0.02F),
                                                 Eigen::Vector2f(0.02F, 0.98F),
                                                 Eigen::Vector2f(0.98F, 0.98F)};

// How much a surface counts in a mean over a pixel's: as it shows. Black and metal a little, so that they
// have a mean.
Eigen::Vector3f shade_color(const SurfaceResponse& response) {
  return response.base_albedo() + Eigen::Vector3f::Constant(1e-3F);
}

}  // namespace

struct PathTracer::Round {
  SampleSequence sequence{0};
  BlockSequence indirect;
  std::uint32_t first = 0;      // index of its first ray
  std::uint32_t size = kRound;  // 4 or 8
  std::array<Ray, kRound> rays;
  std::array<SurfaceHit, kRound> hits;
  std::vector<SurfaceResponse> responses;            // of those that hit
  std::array<std::size_t, kRound> of_hit;            // whose response it is
  std::array<Eigen::Vector2f, kRound> light_places;  // on all lights, by response
  std::array<Eigen::Vector3f, kRound> shades;        // direct and mirrored light, by response

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
  bool is_in_penumbra = false;
  bool has_metal = false;  // few rays agree by chance on what it mirrors
  RaySpread spread;
};

PathTracer::PathTracer(const RayScene& scene, const ClearObjects& clear, const CameraRays& rays,
                       const RenderSettings& settings)
    : scene_(scene),
      clear_(clear),
      rays_(rays),
      settings_(settings),
      few_(in_rounds(settings.samples) / 2),
      usual_(in_rounds(settings.samples)),
      most_(std::max(usual_, in_rounds(settings.edge_samples))),
      gatherer_(scene, settings.bounces - 1),
      quadratures_(scene.scene().lights.begin(), scene.scene().lights.end()),
      seed_(hash_of(hash_of(settings.seed), static_cast<std::uint32_t>(settings.view))) {}

std::uint32_t PathTracer::in_rounds(int rays) {
  return (static_cast<std::uint32_t>(rays) + kRound - 1) / kRound * kRound;
}

PixelLight PathTracer::trace(int x, int y, PixelKind expected) const {
  Sum sum;
  Round round;
  round.responses.reserve(kRound);
  round.sequence =
      SampleSequence(hash_of(hash_of(seed_, static_cast<std::uint32_t>(y)), static_cast<std::uint32_t>(x)));
  round.indirect = BlockSequence(hash_of(seed_ + 1U), x, y);
  const CameraRays::Pixel pixel = rays_.pixel(x, y);
  const std::uint32_t wanted = expected == PixelKind::calm    ? few_
                               : expected == PixelKind::usual ? usual_
                                                              : most_;
  std::uint32_t count = 0;
  while (count < wanted) {
    round.first = count;
    round.size = std::min(kRound, wanted - count);
    trace_round(round, pixel, sum);
    count += round.size;
  }
  PixelLight light;
  light.direct = sum.direct / static_cast<float>(count);
  light.albedo = sum.albedo / static_cast<float>(count);
  if (sum.weights.minCoeff() > 0.0F) light.indirect = sum.indirect.cwiseQuotient(sum.weights);
  light.is_one_surface = sum.is_one_surface;
  light.kind = kind_of(sum);
  return light;
}

void PathTracer::trace_round(Round& round, const CameraRays::Pixel& pixel, Sum& sum) const {
  aim(round, pixel, sum);
  look_for_steps(round, sum);
  add_lights(round, sum);
  add_mirrored(round, sum);
  add_indirect(round, sum);
  look_for_change(round, sum);
}

// Shade is as bright as it is under the room's light.
void PathTracer::look_for_change(const Round& round, Sum& sum) const {
  const Eigen::Vector3f& room = scene_.scene().ambient;
  sum.spread.add(room.sum(), static_cast<float>(round.size - round.responses.size()));
  for (std::size_t i = 0; i < round.responses.size(); ++i) {
    sum.spread.add(round.shades[i].sum() + round.responses[i].base_albedo().dot(room));
    sum.has_metal |= round.responses[i].is_metal();
  }
}

PixelKind PathTracer::kind_of(const Sum& sum) const {
  const float spread = sum.spread.share();
  if (!(spread <= kBusySpreads * settings_.calm_spread)) return PixelKind::busy;
  const bool is_simple = sum.is_one_surface && !sum.is_in_penumbra && !sum.has_metal;
  return is_simple && spread < settings_.calm_spread ? PixelKind::calm : PixelKind::usual;
}

// All rays must meet the plane of the first one's surface, within a few pixels' widths.
void PathTracer::look_for_steps(const Round& round, Sum& sum) const {
  if (round.first == 0) sum.first = round.hits[0];
  const float most_mm = kJump_px * rays_.pixel_width() * sum.first.distance;
  for (const SurfaceHit& hit : std::span(round.hits).first(round.size)) {
    const float off_mm = std::abs(sum.first.normal.dot(hit.point_mm - sum.first.point_mm));
    if (hit.object != sum.first.object || off_mm > most_mm) sum.is_one_surface = false;
  }
}

void PathTracer::aim(Round& round, const CameraRays::Pixel& pixel, Sum& sum) const {
  for (std::uint32_t i = 0; i < round.size; ++i) {
    const std::uint32_t index = round.first + i;
    RaySample sample;
    sample.in_pixel = round.sequence.point(place_in_pixel, index);
    if (rays_.has_aperture()) sample.in_aperture = round.sequence.point(place_in_aperture, index);
    if (rays_.moves()) sample.in_exposure = round.sequence.point(time_in_exposure, index).x();
    round.rays[i] = rays_.ray(pixel, sample);
  }
  scene_.intersect(std::span(round.rays).first(round.size), round.hits, RayBundle::coherent);
  round.responses.clear();
  for (std::size_t i = 0; i < round.size; ++i) {
    const SurfaceHit& hit = round.hits[i];
    ClearObjects::View through;
    if (!clear_.is_empty()) {
      through = clear_.look_through(round.rays[i], hit.object == nullptr ? round.rays[i].end : hit.distance);
      sum.direct += through.mirrored;
    }
    if (hit.object == nullptr) continue;
    Reflectance reflectance = hit.object->material->at(hit.point_mm, hit.normal);
    if (through.nearest.object != nullptr) {
      // What passes glass is less of all that the surface sends.
      reflectance.base = reflectance.base.cwiseProduct(through.passed);
      reflectance.coat *= through.passed.mean();
      sum.has_metal = true;  // and few rays agree by chance on what it mirrors
    }
    round.of_hit[round.responses.size()] = i;
    round.responses.emplace_back(reflectance, hit.normal, -round.rays[i].direction);
  }
}

void PathTracer::add_lights(Round& round, Sum& sum) const {
  const std::size_t missed = round.size - round.responses.size();
  sum.direct += static_cast<float>(missed) * scene_.scene().ambient;
  if (round.responses.empty()) return;
  for (std::size_t i = 0; i < round.responses.size(); ++i) {
    round.light_places[i] = round.sequence.point(light_place, round.index(i));
    round.shades[i].setZero();
  }
  const std::span<const AreaLight> lights = scene_.scene().lights;
  for (std::size_t i = 0; i < lights.size(); ++i) add_light(round, static_cast<std::uint32_t>(i), sum);
}

// A shadow ray for each surface that the round's rays meet: for four of them to a point of the light, for
// four to its corners. Where these disagree, many more tell how much of the light is seen.
void PathTracer::add_light(Round& round, std::uint32_t number, Sum& sum) const {
  const AreaLight& light = scene_.scene().lights[number];
  const std::size_t count = round.responses.size();
  const bool has_penumbra = settings_.penumbra_samples > 0;
  std::array<std::optional<LightSample>, kRound> samples;
  std::array<std::uint8_t, kRound> own{};
  ShadowBatch batch;
  for (std::size_t i = 0; i < count; ++i) {
    const SurfaceHit& hit = round.hit(i);
    samples[i] = sample_light(light, hit.point_mm, round.light_places[i]);
    if (samples[i] && !RayScene::is_above(hit, samples[i]->direction)) samples[i].reset();
    if (!samples[i] || (has_penumbra && count > kCorners.size() && i % 2 != 0)) continue;
    own[i] = static_cast<std::uint8_t>(batch.count);
    batch.add(hit, samples[i]->direction * samples[i]->distance_mm);
  }
  for (std::size_t k = 0; k < kCorners.size() && has_penumbra; ++k) {
    const SurfaceHit& hit = round.hit((2 * k + 1) * count / (2 * kCorners.size()));
    const Eigen::Vector3f way_mm = way_to_light(light, hit.point_mm, kCorners[k]);
    if (RayScene::is_above(hit, way_mm)) batch.add(hit, way_mm);
  }
  batch.trace(scene_);
  Eigen::Vector3f seen = Eigen::Vector3f::Ones();
  if (has_penumbra) {
    const bool is_penumbra = batch.count == 0 || !batch.is_all_alike();
    if (!is_penumbra && batch.is_occluded[0] != 0) return;
    if (is_penumbra) {
      seen = seen_fraction(round, number);
      sum.is_in_penumbra = true;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!samples[i] || (!has_penumbra && batch.is_occluded[own[i]] != 0)) continue;
    const Eigen::Vector3f addition =
        lit(round.responses[i], round.hit(i), *samples[i], quadratures_[number]).cwiseProduct(seen);
    sum.direct += addition;
    round.shades[i] += addition;
  }
}

// Of a light, as the round's surfaces see it together.
Eigen::Vector3f PathTracer::seen_fraction(const Round& round, std::uint32_t number) const {
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
  std::array<std::size_t, kRound> of_response{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < round.responses.size(); ++i) {
    const SurfaceResponse& response = round.responses[i];
    if (!response.has_coat()) continue;
    const float share = response.mirrored_fraction();
    const bool is_halved = share < 1.0F;
    if (is_halved && round.of_hit[i] >= round.size / 2) continue;
    const std::uint32_t index = round.index(i) - (is_halved ? round.first / 2 : 0);
    auto sample = response.sample_coat(round.sequence.point(mirrored_way, index));
    if (!sample || !RayScene::is_above(round.hit(i), sample->to_light)) continue;
    sample->weight /= share;
    sample->density *= share;
    rays[count] = {RayScene::leave(round.hit(i), sample->to_light), sample->to_light};
    samples[count] = *sample;
    is_sharp[count] = response.is_sharp();
    of_response[count] = i;
    indices[count++] = index;
  }
  std::array<SurfaceHit, kRound> hits;
  scene_.intersect({rays.data(), count}, {hits.data(), count}, RayBundle::coherent);
  std::array<LightGatherer::Path, kRound> paths;
  for (std::size_t k = 0; k < count; ++k) paths[k] = {hits[k], indices[k], samples[k].weight.maxCoeff()};
  gatherer_.gather({paths.data(), count}, round.sequence, mirrored_further);
  for (std::size_t k = 0; k < count; ++k) {
    Eigen::Vector3f arriving = paths[k].arriving;
    for (const AreaLight& light : is_sharp[k] ? lights : lights.first(0)) {
      const auto met = meet_light(light, rays[k].origin_mm, rays[k].direction);
      if (!met || (hits[k].object != nullptr && hits[k].distance < met->distance_mm)) continue;
      arriving += met->radiance * (samples[k].density / (samples[k].density + met->density));
    }
    const Eigen::Vector3f addition = samples[k].weight.cwiseProduct(arriving);
    sum.direct += addition;
    // Of the others, only what is sharp makes a pixel uneasy: rough coats mirror about the same for all.
    if (is_sharp[k]) round.shades[of_response[k]] += addition;
  }
}

// Where a surface goes on, its neighbours' rays are as good as the pixel's own.
std::size_t PathTracer::indirect_rays(const Round& round, const Sum& sum) const {
  const std::size_t wanted = static_cast<std::size_t>(settings_.indirect_samples) * round.size / kRound;
  const bool is_smoothed = sum.is_one_surface && settings_.indirect_filter_px >= kSmoothed_px;
  // The further rays of a pixel at an edge are for what is sharp.
  const bool is_further = round.first >= static_cast<std::uint32_t>(settings_.samples);
  if (is_further) return (wanted + 3) / 4;
  return std::max<std::size_t>(is_smoothed && round.size < kRound ? (wanted + 1) / 2 : wanted, 1);
}

void PathTracer::add_indirect(Round& round, Sum& sum) const {
  std::array<Ray, kRound> rays;
  std::array<Eigen::Vector3f, kRound> weights;
  std::array<std::uint32_t, kRound> indices{};
  const std::size_t wanted = indirect_rays(round, sum);
  std::size_t count = 0;
  for (std::size_t i = 0; i < round.responses.size(); ++i) {
    const SurfaceResponse& response = round.responses[i];
    sum.albedo += response.base_albedo();
    if (i >= wanted || response.is_metal()) continue;
    const Eigen::Vector3f weight = shade_color(response);
    sum.weights += weight;
    indices[count] = round.indirect.index(round.first + static_cast<std::uint32_t>(i));
    const Eigen::Vector3f direction =
        cosine_direction(round.hit(i).normal, round.indirect.sequence().point(indirect_way, indices[count]));
    if (!RayScene::is_above(round.hit(i), direction)) continue;
    rays[count] = {RayScene::leave(round.hit(i), direction), direction};
    weights[count++] = weight * response.base_entry(direction);
  }
  std::array<SurfaceHit, kRound> hits;
  scene_.intersect({rays.data(), count}, {hits.data(), count}, RayBundle::scattered);
  std::array<LightGatherer::Path, kRound> paths;
  for (std::size_t k = 0; k < count; ++k) paths[k] = {hits[k], indices[k]};
  gatherer_.gather({paths.data(), count}, round.indirect.sequence(), indirect_further);
  for (std::size_t k = 0; k < count; ++k) sum.indirect += weights[k].cwiseProduct(paths[k].arriving);
}

}  // namespace traygauge
