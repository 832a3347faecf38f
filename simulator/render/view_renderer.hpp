// Pictures of a scene.
#pragma once

#include <functional>

#include "simulator/render/ray_scene.hpp"
#include "simulator/render/render_settings.hpp"
#include "simulator/render/rendered_view.hpp"
#include "simulator/render/view_camera.hpp"

namespace traygauge {

// Called now and then, by one thread at a time, with the share that is done: 0 to 1.
using RenderProgress = std::function<void(double share)>;

// A scene made ready once for any number of views.
class ViewRenderer {
 public:
  // Refers to the scene, which must outlive it. Throws as RayScene does.
  explicit ViewRenderer(const Scene& scene) : scene_(scene), clear_(scene, ObjectChoice::clear) {}

  // The same picture, bit by bit, for the same settings with any number of threads. Throws
  // std::invalid_argument for a camera or settings that make no sense.
  RenderedView render(const ViewCamera& camera, const RenderSettings& settings = {},
                      const RenderProgress& progress = {}) const;

 private:
  RayScene scene_;
  RayScene clear_;
};

}  // namespace traygauge
