// What an empty dish is like: outer size, rim, bottom and inner surface, from two views of it beside the
// card.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/enrolment/dish_edge.hpp"
#include "core/enrolment/inset_heights.hpp"
#include "core/enrolment/profile_fit.hpp"
#include "core/pipeline/configuration.hpp"
#include "core/pipeline/scene_geometry.hpp"
#include "core/pipeline/tray_view.hpp"
#include "core/pipeline/view_input.hpp"
#include "core/stereo/dense_stereo.hpp"

namespace traygauge {

struct DishSurveyParams {
  DishEdgeParams edge;
  InsetHeightParams heights;
  ProfileFitParams profile;
  // How far the bundle adjustment may take the edge from what the outlines alone said.
  double edge_height_sigma_mm = 10.0;
  double edge_size_sigma_mm = 10.0;
  double above_edge_mm = 6.0;         // of the edge that is searched: a rim's crest
  double min_inlier_fraction = 0.88;  // of the outlines on the edge found; fewer: labels_inconsistent
  // A dish that leans by more stands on something, or the card is not flat on the table: table_not_found.
  double max_lean_deg = 1.5;
};

// How sure it is, mm: standard deviations, 0 where nothing was measured.
struct DishSurveyErrors {
  double size_mm = 0.0;
  double edge_height_mm = 0.0;  // of the outer edge, from the outlines
  double height_mm = 0.0;       // of the inner surface as a whole: cameras and matching
};

struct DishSurvey {
  Status status;
  FittedProfile fitted;
  DishPose place;
  OutlineFit outline;
  DishSurveyErrors errors;
  double lean_deg = 0.0;          // of the inner surface to the table
  double matched_fraction = 0.0;  // of the dish, the same way from either view
  double relative_angle_deg = 0.0;
};

// Not thread-safe. Nothing allocates, construction included.
class DishSurveyor {
 public:
  // `block` holds survey_bytes(configuration), aligned to kArenaAlignmentBytes, and outlives the surveyor. No
  // dish of the configuration is read. Check status() before use.
  DishSurveyor(std::span<std::byte> block, const Configuration& configuration,
               const DishSurveyParams& params = {});

  Status status() const { return status_; }

  // Takes the first, then the second view; pixels and labels stay the caller's until survey() returns. What
  // is labelled as food is taken for something that hides the dish.
  Status add_view(const ViewInput& input);

  // The dish of label 1. too_little_depth: the glaze is too plain or too shiny for a profile; size and edge
  // are given nevertheless. table_not_found: the dish leans, or lies below the table. no_dish_label,
  // too_many_dishes, dish_cut_off, rim_not_found, labels_inconsistent, and what the stages before can meet.
  const DishSurvey& survey(std::uint64_t seed);

  // Forgets both views.
  void reset() {
    views_ = 0;
    views_status_ = {};
  }

  // What was put together from both grids of the last survey.
  std::span<const InsetRing> rings() const { return rings_; }

 private:
  struct Memory {
    CardPattern pattern;
    std::array<TrayView, 2> views;
    TrayViewWorkspace preparation;
    SceneGeometryWorkspace geometry;
    std::span<SceneGeometry> scene;  // one
    DenseStereoWorkspace surface;
    InsetHeightWorkspace heights;
    ProfileFitWorkspace profile;

    template <class Allocator>
    constexpr void allocate(Allocator& arena, const Configuration& configuration);
  };
  friend std::size_t survey_bytes(const Configuration& configuration);

  Status find_edge(const ViewPair& views, std::uint64_t seed);
  Status match(const ViewPair& views, double bottom_mm, std::array<SurfaceGrid, 2>& grids);
  Status measure_profile(const ViewPair& views);
  std::array<InsetView, 2> inset_views(const std::array<SurfaceGrid, 2>& grids) const;
  double lean_rad(const std::array<SurfaceGrid, 2>& grids, const InnerSurface& inner) const;
  void rate_errors();

  Configuration configuration_;
  DishSurveyParams params_;
  Memory memory_;
  Status status_;
  int views_ = 0;
  Status views_status_;
  DishSurvey survey_;
  double sample_mm_ = 0.0;  // of the grid that was matched last
  std::span<const InsetRing> rings_;
};

// Bytes that a surveyor with this configuration takes from its block.
std::size_t survey_bytes(const Configuration& configuration);

}  // namespace traygauge
