// A look at what a stage gave before the next one takes it: an evaluation compares it with
// the truth, or puts the truth in its place.
#pragma once

#include <array>

#include "core/pipeline/scene_geometry.hpp"
#include "core/stereo/surface_grid.hpp"

namespace traygauge {

class StageObserver {
 public:
  // Which view of the pair is worked first: its camera and its grid come first, too.
  virtual void on_order(int first_view) = 0;
  // Cameras and dishes are found; both may be replaced.
  virtual void on_geometry(BundleResult& bundle, std::span<const DishOnTray> dishes) = 0;
  // Both views' surfaces over one dish; a grid may be replaced by one of the same size, which the observer
  // keeps until the measurement ends.
  virtual void on_surfaces(const TableCameras& camera_from_table, std::array<SurfaceGrid, 2>& grids) = 0;

 protected:
  ~StageObserver() = default;
};

}  // namespace traygauge
