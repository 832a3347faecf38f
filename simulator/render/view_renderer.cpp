#include "simulator/render/view_renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulator/render/camera_rays.hpp"
#include "simulator/render/indirect_filter.hpp"
#include "simulator/render/path_tracer.hpp"
#include "simulator/render/shared_work.hpp"

namespace traygauge {
namespace {

constexpr int kTileSide = 16;
constexpr int kStripRows = 32;  // smoothed at a time
constexpr int kBlurredEdgeReach_px = 3;
constexpr double kTruthShare = 0.03;  // of the time
constexpr double kTraceShare = 0.95;  // until then; the rest is smoothing

void check_range(const char* name, double value, double least, double most) {
  if (value >= least && value <= most) return;
  throw std::invalid_argument(std::string("render settings: ") + name + " is " + std::to_string(value) +
                              ", expected " + std::to_string(least) + " to " + std::to_string(most));
}

// All that is known about the pixels before the light is smoothed.
struct Canvas {
  Canvas(int width, int height) : map(width, height) {
    const std::size_t count = map.objects.size();
    view.width = width;
    view.height = height;
    view.radiance.resize(count);
    view.labels.resize(count);
    view.kinds.resize(count);
    view.depth_mm.resize(count);
    indirect.resize(count);
    albedo.resize(count);
  }

  RenderedView view;
  SurfaceMap map;
  std::vector<Eigen::Vector3f> indirect;
  std::vector<Eigen::Vector3f> albedo;
};

// Clear glass is what a pixel shows, unless food lies behind: people outline that through the glass.
void name_clear(const SurfaceHit& clear, std::size_t at, Canvas& canvas) {
  if (clear.object == nullptr || canvas.view.kinds[at] == TruthKind::food) return;
  canvas.view.labels[at] = clear.object->label;
  canvas.view.kinds[at] = clear.object->kind_at ? clear.object->kind_at(clear.point_mm) : clear.object->kind;
  canvas.view.depth_mm[at] = clear.distance;
}

// Truth, at the centres of a row's pixels.
void fill_truth(const RayScene& scene, const ClearObjects& clear, const CameraRays& camera_rays, int y,
                Canvas& canvas) {
  const auto width = static_cast<std::size_t>(canvas.map.width);
  std::vector<Ray> rays;
  std::vector<SurfaceHit> hits(width);
  rays.reserve(width);
  for (int x = 0; x < canvas.map.width; ++x) rays.push_back(camera_rays.central_ray(camera_rays.pixel(x, y)));
  scene.intersect(rays, hits, RayBundle::coherent);
  for (std::size_t i = 0; i < width; ++i) {
    if (hits[i].object == nullptr) continue;
    const std::size_t at = canvas.map.index(0, y) + i;
    const SceneObject& object = *hits[i].object;
    canvas.view.labels[at] = object.label;
    canvas.view.kinds[at] = object.kind_at ? object.kind_at(hits[i].point_mm) : object.kind;
    canvas.view.depth_mm[at] = hits[i].distance;
    canvas.map.points_mm[at] = hits[i].point_mm;
    canvas.map.normals[at] = hits[i].normal;
    canvas.map.objects[at] = static_cast<std::uint32_t>(hits[i].object - scene.scene().objects.data()) + 1;
    canvas.map.footprint_mm[at] = hits[i].distance * camera_rays.pixel_width();
    if (!clear.is_empty()) name_clear(clear.look_through(rays[i], hits[i].distance).nearest, at, canvas);
  }
}

PixelKind trace_pixel(const PathTracer& tracer, int x, int y, PixelKind expected, Canvas& canvas) {
  const PixelLight light = tracer.trace(x, y, expected);
  const std::size_t at = canvas.map.index(x, y);
  canvas.view.radiance[at] = light.direct;
  canvas.indirect[at] = light.indirect;
  canvas.albedo[at] = light.albedo;
  canvas.map.is_mixed[at] = light.is_one_surface ? 0 : 1;
  return light.kind;
}

// By the pixels to the left and above, and by whether several surfaces are near.
PixelKind expected_kind(PixelKind left, PixelKind above, bool is_edge) {
  if (is_edge)
    return left == PixelKind::busy || above == PixelKind::busy ? PixelKind::busy : PixelKind::usual;
  const bool is_calm = left == PixelKind::calm || above == PixelKind::calm;
  return is_calm && left != PixelKind::busy && above != PixelKind::busy ? PixelKind::calm : PixelKind::usual;
}

}  // namespace

void RenderSettings::check() const {
  check_range("samples", samples, 8, 4096);
  check_range("edge_samples", edge_samples, 0, 4096);
  check_range("calm_spread", static_cast<double>(calm_spread), 0, 1);
  check_range("indirect_samples", indirect_samples, 1, 8);
  check_range("penumbra_samples", penumbra_samples, 0, 1024);
  check_range("bounces", bounces, 1, 8);
  check_range("indirect_filter_px", static_cast<double>(indirect_filter_px), 0, 20);
  check_range("threads", threads, 0, 1024);
}

RenderedView ViewRenderer::render(const ViewCamera& camera, const RenderSettings& settings,
                                  const RenderProgress& progress) const {
  settings.check();
  const CameraRays rays(camera);
  const ClearObjects clear(scene_, clear_);
  const PathTracer tracer(scene_, clear, rays, settings);
  Canvas canvas(camera.width, camera.height);
  const int threads = settings.threads;
  const auto part_of = [&](double from, double to) -> RenderProgress {
    if (!progress) return {};
    return [&progress, from, to](double share) { progress(from + (to - from) * share); };
  };

  share_work(camera.height, threads, part_of(0.0, kTruthShare),
             [&](int y) { fill_truth(scene_, clear, rays, y, canvas); });

  const bool is_sharp = !rays.has_aperture() && !rays.moves();
  const int edge_reach_px = is_sharp ? 1 : kBlurredEdgeReach_px;
  const int columns = (camera.width + kTileSide - 1) / kTileSide;
  const int rows = (camera.height + kTileSide - 1) / kTileSide;
  share_work(columns * rows, threads, part_of(kTruthShare, kTraceShare), [&](int tile) {
    const int x0 = tile % columns * kTileSide;
    const int y0 = tile / columns * kTileSide;
    // Of the row above, then of this one.
    std::array<PixelKind, kTileSide> kinds;
    kinds.fill(PixelKind::usual);
    for (int y = y0; y < std::min(y0 + kTileSide, camera.height); ++y) {
      PixelKind left = PixelKind::usual;
      for (int x = x0; x < std::min(x0 + kTileSide, camera.width); ++x) {
        PixelKind& kind = kinds[static_cast<std::size_t>(x - x0)];
        const bool is_edge = is_near_edge(canvas.map, edge_reach_px, x, y);
        kind = trace_pixel(tracer, x, y, expected_kind(left, kind, is_edge), canvas);
        left = kind;
      }
    }
  });

  const int strips = (camera.height + kStripRows - 1) / kStripRows;
  share_work(strips, threads, part_of(kTraceShare, 1.0), [&](int strip) {
    const int first = strip * kStripRows;
    const int end = std::min(first + kStripRows, camera.height);
    const LightSmoother smoother(canvas.map, canvas.indirect, settings.indirect_filter_px, first, end);
    for (int y = first; y < end; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const std::size_t at = canvas.map.index(x, y);
        canvas.view.radiance[at] += canvas.albedo[at].cwiseProduct(smoother.at(x, y));
      }
    }
  });
  return std::move(canvas.view);
}

}  // namespace traygauge
