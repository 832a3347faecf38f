// Where cameras and dishes are: tracks, bundle adjustment, the pose of every dish.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/random.hpp"
#include "core/base/status.hpp"
#include "core/pipeline/measurement.hpp"
#include "core/pipeline/own_motion.hpp"
#include "core/pipeline/tray_view.hpp"
#include "core/stereo/surface_agreement.hpp"

namespace traygauge {

// A dish on the tray, by its label in both views.
struct DishOnTray {
  std::uint8_t label = kDishLabel;
  LabelSet labels;                        // its own and its items'
  std::span<const DishModel> candidates;  // the one described, or all that are known
  Status verdict;                         // why it cannot be measured, though it was placed
};

struct SceneGeometry {
  std::array<DishOnTray, kMaxPlacedDishes> dishes;
  std::size_t dish_count = 0;
  LabelSet beside_dishes;  // items that lie on none of them
  OwnMotion own_motion;    // from the first picture to the second; then the cameras are those in its frame
  BundleResult bundle;
  AgreedHeight table;  // over where the card puts it, around the card
  std::span<const PointTrack> tracks;
  std::span<const PointTrack> strays;  // that contradict the cameras' motion
};

struct SceneGeometryWorkspace {
  PointTrackingWorkspace tracking;
  LabelBorders borders;
  DishOutlineWorkspace outline;
  std::array<std::array<BoundedList<Vec2>, 2>, kMaxPlacedDishes> outlines;  // of every dish in both views
  BundleWorkspace bundle;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    const FrameLimits& limits = configuration.limits;
    tracking.allocate(arena, limits.max_frame_width, limits.max_frame_height, configuration.tracking);
    borders.allocate(arena);
    outline.allocate(arena, configuration.pipeline.max_contour_sides);
    for (auto& views : outlines) {
      for (BoundedList<Vec2>& rays : views) {
        rays = BoundedList<Vec2>(arena.template take<Vec2>(configuration.pipeline.max_outline_points));
      }
    }
    bundle.allocate(arena, static_cast<std::size_t>(configuration.tracking.max_corners),
                    configuration.pipeline.max_outline_points);
  }
};

// Lists the dishes that either view shows, with what lies on them, and what lies beside. no_dish_label
// without any; dish_unknown when one of them has no description.
Status list_dishes(const ViewPair& views, const Configuration& configuration,
                   SceneGeometryWorkspace& workspace, SceneGeometry& geometry);

// Fills the rest of `geometry` and the sparse part of the report.
Status find_geometry(const ViewPair& views, const Configuration& configuration, Random& random,
                     SceneGeometryWorkspace& workspace, StageClock& clock, MeasurementReport& report,
                     SceneGeometry& geometry);

// Repeats the bundle adjustment alone, for example with other candidates for the dishes.
Status refine_geometry(const ViewPair& views, const ReferenceCard& card, const BundleParams& params,
                       SceneGeometryWorkspace& workspace, SceneGeometry& geometry);

}  // namespace traygauge
