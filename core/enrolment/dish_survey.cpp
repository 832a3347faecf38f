#include "core/enrolment/dish_survey.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/pipeline/dish_observation.hpp"
#include "core/quality/view_input.hpp"
#include "core/volume/uncertainty.hpp"

namespace traygauge {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

Status check_bare_dish(const TrayView& view) {
  for (int value = kFirstFurtherDishLabel; value <= kLastFurtherDishLabel; ++value) {
    if (view.regions().pixels[static_cast<std::size_t>(value)] > 0) return StatusCode::too_many_dishes;
  }
  if (view.regions().pixels[kDishLabel] == 0) return StatusCode::no_dish_label;
  return is_cut_off(view, labels_of_single_dish()) ? StatusCode::dish_cut_off : StatusCode::ok;
}

// The edge as a dish without an inner surface.
DishModel model_of(const DishPose& place, const DishEdgeParams& params) {
  DishModel model;
  model.outer_size_mm = place.size_mm;
  if (std::abs(place.size_mm[0] - place.size_mm[1]) <= params.round_mm)
    model.outer_size_mm.fill(0.5 * (place.size_mm[0] + place.size_mm[1]));
  model.rim_height_mm = place.edge_height_mm;
  return model;
}

// A surface without a flat bottom, which gives every place of the dish its inset.
DishModel funnel_of(const DishModel& edge) {
  constexpr double kNearlyAll = 0.98;  // of the half axis; the last inset is never reached
  DishModel funnel = edge;
  funnel.profile_points[0] = {0.0, edge.rim_height_mm};
  funnel.profile_points[1] = {kNearlyAll * 0.5 * std::min(edge.outer_size_mm[0], edge.outer_size_mm[1]), 0.0};
  funnel.profile_size = 2;
  return funnel;
}

}  // namespace

template <class Allocator>
constexpr void DishSurveyor::Memory::allocate(Allocator& arena, const Configuration& configuration) {
  pattern.allocate(arena, configuration.card_alignment.pattern);
  for (TrayView& view : views) view.allocate(arena, configuration.limits);
  scene = arena.template take<SceneGeometry>(1);
  const auto max_samples = static_cast<std::size_t>(configuration.surface.rectification.max_samples);
  arena.overlay([&] { preparation.allocate(arena, configuration); },
                [&] {
                  geometry.allocate(arena, configuration);
                  surface.allocate(arena, configuration.surface);
                  heights.allocate(arena, max_samples);
                  profile.allocate(arena);
                });
}

std::size_t survey_bytes(const Configuration& configuration) {
  ArenaPlan plan;
  DishSurveyor::Memory memory;
  memory.allocate(plan, configuration);
  return plan.high_water_bytes();
}

DishSurveyor::DishSurveyor(std::span<std::byte> block, const Configuration& configuration,
                           const DishSurveyParams& params)
    : configuration_(configuration), params_(params) {
  configuration_.dishes = {};
  status_ = validate_apart_from_dishes(configuration_);
  if (!status_.ok()) return;
  Arena arena(block);
  memory_.allocate(arena, configuration_);
  if (arena.exhausted()) {
    status_ = StatusCode::out_of_memory;
    return;
  }
  const ReferenceCard& card = configuration_.card;
  status_ =
      prepare_card_pattern(card.pattern, card.size(), configuration_.card_alignment.pattern, memory_.pattern);
}

Status DishSurveyor::add_view(const ViewInput& input) {
  if (!status_.ok()) return status_;
  if (views_ == 2) return StatusCode::wrong_call;
  TrayView& view = memory_.views[static_cast<std::size_t>(views_)];
  view.lens = input.lens.value_or(configuration_.lens);
  view.arm_angle_deg = input.arm_angle_deg;
  view.labels = input.labels;
  StageClock clock;
  Status status = validate(view.lens);
  if (status.ok()) status = measure_labels(input.frame, configuration_, view);
  if (status.ok()) status = check_bare_dish(view);
  if (status.ok()) {
    status = prepare_labelled_view({input.frame}, configuration_, memory_.pattern, memory_.preparation, clock,
                                   view);
  }
  if (views_status_.ok()) views_status_ = status;
  ++views_;
  return status;
}

const DishSurvey& DishSurveyor::survey(std::uint64_t seed) {
  survey_ = {};
  rings_ = {};
  survey_.status = !status_.ok() ? status_ : !views_status_.ok() ? views_status_ : StatusCode::ok;
  if (survey_.status.ok() && views_ != 2) survey_.status = StatusCode::frame_missing;
  if (!survey_.status.ok()) return survey_;
  const ViewPair views = {memory_.views.data(), &memory_.views[1]};
  survey_.status = find_edge(views, seed);
  if (survey_.status.ok()) survey_.status = measure_profile(views);
  return survey_;
}

// Cameras without the dish, the edge at these, then all together.
Status DishSurveyor::find_edge(const ViewPair& views, std::uint64_t seed) {
  SceneGeometry& geometry = memory_.scene.front();
  SceneGeometryWorkspace& workspace = memory_.geometry;
  geometry = {};
  geometry.dish_count = 1;
  geometry.dishes[0] = {kDishLabel, labels_of_single_dish(), {}, {}};
  Random random(seed);
  StageClock clock;
  MeasurementReport report;
  Status status = find_geometry(views, configuration_, random, workspace, clock, report, geometry);
  if (!status.ok()) return status;
  const FocalsPx focals_px = {views[0]->lens.pinhole.mean_focal_px(), views[1]->lens.pinhole.mean_focal_px()};
  BundleParams params = configuration_.bundle;
  status = measure_dish_edge({workspace.outlines[0][0].items(), workspace.outlines[0][1].items()},
                             geometry.bundle.camera_from_table, focals_px, params.placement, params_.edge,
                             workspace.bundle.placement, survey_.place);
  if (!status.ok()) return status;

  const std::array<DishModel, 1> edge = {model_of(survey_.place, params_.edge)};
  geometry.dishes[0].candidates = edge;
  params.placement.height_sigma_mm = params_.edge_height_sigma_mm;
  params.placement.size_sigma_mm = params_.edge_size_sigma_mm;
  status = refine_geometry(views, configuration_.card, params, workspace, geometry);
  geometry.dishes[0].candidates = {};
  if (!status.ok()) return status;
  const BundleDishResult& dish = geometry.bundle.dishes[0];
  if (!dish.status.ok()) return dish.status;
  survey_.place = dish.placed.place;
  survey_.outline = dish.placed.fit;
  survey_.errors.size_mm = std::sqrt(dish.placed.covariance(kPlaceSize, kPlaceSize));
  survey_.errors.edge_height_mm = std::sqrt(dish.placed.covariance(kPlaceHeight, kPlaceHeight));
  survey_.fitted.dish = model_of(survey_.place, params_.edge);
  survey_.relative_angle_deg =
      angle_between_views_deg(geometry.bundle.camera_from_table, middle_of(survey_.place, 0.0));
  status = check_angle(survey_.relative_angle_deg, configuration_.geometry);
  if (!status.ok()) return status;
  return survey_.outline.explained_fraction() >= params_.min_inlier_fraction
             ? StatusCode::ok
             : StatusCode::labels_inconsistent;
}

Status DishSurveyor::match(const ViewPair& views, double bottom_mm, std::array<SurfaceGrid, 2>& grids) {
  const SceneGeometry& geometry = memory_.scene.front();
  const DishOnTray& dish = geometry.dishes[0];
  DenseStereoReport dense;
  DenseStereoParams params = configuration_.surface;
  params.rectification.whole_dish = true;  // here the dish is what is measured
  params.refinement.refines_dish = true;
  const Status status = run_dense_stereo(
      diffuse_views(views, geometry.bundle.camera_from_table, dish.labels), labels_on_dish(dish.labels),
      bottom_mm, survey_.place.edge_height_mm + params_.above_edge_mm, params, memory_.surface, grids, dense);
  survey_.matched_fraction = 0.5 * (dense.confirmed[0] + dense.confirmed[1]);
  sample_mm_ = dense.column_step_mm;
  return status;
}

// First over the table, then over the bottom that was found: there the pictures fit configuration.
Status DishSurveyor::measure_profile(const ViewPair& views) {
  suppress_speculars(views, configuration_.specular);
  const DishModel edge = model_of(survey_.place, params_.edge);
  InnerSurface insets;
  insets.place = frame_of(survey_.place);
  Status status = insets.profile.set(funnel_of(edge));
  double bottom_mm = 0.0;
  std::array<SurfaceGrid, 2> grids;
  for (int round = 0; round < 2 && status.ok(); ++round) {
    status = match(views, bottom_mm, grids);
    if (status.ok())
      status = collect_inset_heights(inset_views(grids), insets, params_.heights, memory_.heights, rings_);
    if (status.ok())
      status = fit_dish_profile(rings_, edge, params_.profile, memory_.profile, survey_.fitted);
    bottom_mm = survey_.fitted.dish.bottom_height_mm;
  }
  if (!status.ok()) return status;
  status = insets.profile.set(survey_.fitted.dish);
  if (!status.ok()) return status;
  survey_.lean_deg = kDegreesPerRadian * lean_rad(grids, insets);
  rate_errors();
  const bool stands = survey_.lean_deg <= params_.max_lean_deg && validate(survey_.fitted.dish).ok();
  return stands ? StatusCode::ok : StatusCode::table_not_found;
}

std::array<InsetView, 2> DishSurveyor::inset_views(const std::array<SurfaceGrid, 2>& grids) const {
  std::array<InsetView, 2> views;
  for (std::size_t v = 0; v < 2; ++v) {
    const DenseStereoWorkspace::View& own = memory_.surface.views[v];
    const ImageView<const std::uint8_t> gray = own.gray[0];
    views[v] = {grids[v],
                gray,
                memory_.surface.views[1 - v].gray[0],
                {own.surface.data(), gray.width, gray.height},
                v == 0 ? 1 : -1};
  }
  return views;
}

// Of the plane through what the samples are above the profile, over their place in the dish.
double DishSurveyor::lean_rad(const std::array<SurfaceGrid, 2>& grids, const InnerSurface& inner) const {
  constexpr double kFarMm = 5.0;  // what is further off was matched wrongly
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const SurfaceGrid& grid : grids) {
    for (int y = 0; y < grid.points.height; ++y) {
      for (int x = 0; x < grid.points.width; ++x) {
        if (grid.labels.at(x, y) != kDishLabel || grid.evidence.at(x, y) != SurfaceEvidence::both) continue;
        const SurfacePoint& point = grid.points.at(x, y);
        const Vec2 at(point.x_mm, point.y_mm);
        const double off_mm = static_cast<double>(point.z_mm) - inner.height_mm(at);
        if (!(std::abs(off_mm) < kFarMm)) continue;
        const Vec2 from_middle = at - survey_.place.centre_mm;
        const Vec3 row(1.0, from_middle.x(), from_middle.y());
        normal += row * row.transpose();
        right += off_mm * row;
      }
    }
  }
  if (!(std::abs(normal.determinant()) > 0.0)) return 0.0;
  const Vec3 plane = normal.inverse() * right;
  return std::atan(plane.tail<2>().norm());
}

void DishSurveyor::rate_errors() {
  const BundleResult& bundle = memory_.scene.front().bundle;
  const Vec3 middle = middle_of(survey_.place, survey_.fitted.dish.bottom_height_mm);
  const double cameras_mm = height_sigma_mm(middle, bundle.camera_from_table, bundle.covariance);
  const double matching_mm = configuration_.uncertainty.disparity_bias_px *
                             height_per_sample_mm(bundle.camera_from_table, middle, sample_mm_);
  survey_.errors.height_mm = std::hypot(cameras_mm, matching_mm);
}

}  // namespace traygauge
