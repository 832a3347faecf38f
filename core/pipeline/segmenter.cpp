#include "core/pipeline/segmenter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/units.hpp"
#include "core/card/card_location.hpp"
#include "core/dish/dish_profile.hpp"
#include "core/image/resample.hpp"
#include "core/labels/convex_fill.hpp"
#include "core/pipeline/dish_observation.hpp"
#include "core/pipeline/stage_clock.hpp"
#include "core/quality/exposure.hpp"
#include "core/quality/picture_colour.hpp"
#include "core/quality/view_input.hpp"

namespace traygauge {
namespace {

constexpr double kMostFlange = 0.3;  // of the smaller axis
constexpr int kSeedStep = 2;         // cells, a power of two

bool is_within(const FrameView& frame, std::span<const Vec2> outline_px) {
  return std::all_of(outline_px.begin(), outline_px.end(), [&](const Vec2& corner) {
    return corner.minCoeff() > 0.0 && corner.x() < frame.width - 1 && corner.y() < frame.height - 1;
  });
}

void clear(ImageView<std::uint8_t> labels) {
  for (int y = 0; y < labels.height; ++y) std::fill_n(labels.row(y), labels.width, kBackgroundLabel);
}

}  // namespace

Segmenter::Segmenter(const Configuration& configuration, const CardPattern& pattern, SegmenterMemory& memory,
                     Segmentation& result)
    : configuration_(configuration), pattern_(pattern), memory_(memory), result_(result) {
  result_ = {};
  status_ = learn_print_corners(pattern_, params_.card, memory_.card.search, memory_.print);
  result_.status = status_;
}

Status Segmenter::add_view(const SegmentedView& view) {
  if (!status_.ok()) return status_;
  assert(view_count_ < views_.size());
  StageClock clock;
  clock.enter(Stage::scale);
  const std::size_t index = view_count_++;
  views_[index] = view;
  Status status = check_view(view, view.lens);
  if (status.ok()) status = find_card(view, view.lens, index);
  const FrameView gray{view.gray.data, view.gray.width, view.gray.height, view.gray.stride,
                       PixelFormat::gray8};
  cameras_[index] = {gray, view.lens, result_.cards[index].camera_from_table};
  if (result_.status.ok()) result_.status = status;
  clock.stop();
  result_.card_ms += clock.total_ms();
  return status;
}

void Segmenter::segment() {
  assert(view_count_ == views_.size());
  if (!result_.status.ok()) return;
  StageClock clock;
  clock.enter(Stage::surface);
  result_.status = find_dishes();
  if (result_.status.ok()) follow_own_motion();
  if (result_.status.ok()) {
    clock.enter(Stage::volume);
    draw_dishes();
    read_pictures();
    find_tray_places();
    if (result_.place_count > 0) draw_dishes();
    look_at_dishes();
    draw_items(params_.food);
    if (params_.items > 0) {
      meet_hint();
      for (SegmentedDish& dish : result_.dishes) dish.is_split_doubtful = false;
      result_.misses_hint = result_.items != params_.items;
    }
    clear_tray_places();
    const bool is_empty_tray = result_.is_bare() && params_.items == 0;
    if (result_.items == 0 && !is_empty_tray) result_.status = StatusCode::no_food_label;
    // An empty white dish on a grey table has no colours either.
    const auto is_grey = [&](const auto& view) { return !shows_colour(view.frame, params_.colour); };
    if (result_.items > 0 && std::any_of(views_.begin(), views_.end(), is_grey))
      result_.status = StatusCode::picture_without_colour;
  }
  result_.status = blame_card(result_, result_.status);
  clock.stop();
  result_.dish_ms = clock.stage_ms()[static_cast<std::size_t>(Stage::surface)];
  result_.food_ms = clock.stage_ms()[static_cast<std::size_t>(Stage::volume)];
}

Status Segmenter::check_view(const SegmentedView& view, const LensModel& lens) const {
  const FrameView& frame = view.frame;
  if (const Status status = check_sizes(frame, view.labels, lens, configuration_.limits); !status.ok())
    return status;
  if (view.gray.width != frame.width || view.gray.height != frame.height)
    return StatusCode::frame_size_mismatch;
  convert_to_gray(frame, view.gray);
  return check_exposure(view.gray, configuration_.exposure);
}

// The search gives the outline to a pixel or two; the alignment of the print, which a labelled card gets
// anyway, the rest.
Status Segmenter::find_card(const SegmentedView& view, const LensModel& lens, std::size_t index) {
  const ImageView<const std::uint8_t> gray = view.gray;
  clear(view.labels);
  collect_rim_edges(gray, lens, params_.dish.edges, memory_.card.edges, memory_.edges[index]);
  CardAlignment& card = result_.cards[index];
  CardPolygon outline_px;
  const CardRoundsParams rounds{params_.max_alignments, params_.sure_correlation};
  const Status status =
      locate_card(gray, view.labels, lens,
                  {pattern_, memory_.print, params_.card, configuration_.card_search,
                   configuration_.card_alignment, rounds, memory_.card.search, memory_.card.alignment},
                  card, outline_px);
  if (!status.ok()) return status;
  if (card.condition.is_doubtful) result_.is_card_doubtful = true;
  return is_within(view.frame, outline_px) ? StatusCode::ok : StatusCode::card_hidden;
}

Status Segmenter::find_dishes() {
  std::array<FoundDish, kMaxPlacedDishes> taken;
  result_.dish_count = 0;
  result_.place_count = 0;
  std::size_t taken_count = 0;
  std::size_t found_count = 0;
  std::span<const DishModel> rest = configuration_.dishes;
  for (const SegmentedView& view : views_) {
    for (SeenRim& rim : view.rims) rim.label = kBackgroundLabel;
  }
  while (!rest.empty()) {
    const std::uint8_t label = rest.front().label;
    const auto end = std::find_if_not(rest.begin(), rest.end(),
                                      [&](const DishModel& dish) { return dish.label == label; });
    const std::span<const DishModel> candidates(rest.begin(), end);
    rest = {end, rest.end()};
    if (result_.dish_count == kMaxPlacedDishes) return StatusCode::too_many_dishes;
    SegmentedDish& dish = result_.dishes[result_.dish_count++];
    dish.label = label;
    const Result<FoundDish> found = search_dish(
        cameras_, memory_.edges, candidates, std::span(taken).first(taken_count), params_.dish, memory_.dish);
    dish.status = found.status();
    if (!found.ok()) continue;
    dish.found = *found;
    dish.model = candidates[static_cast<std::size_t>(dish.found.candidate)];
    taken[taken_count++] = dish.found;
    dish.sightings =
        sight_found_dish(cameras_, dish.found, params_.dish, configuration_.checks.sighting, memory_.dish);
    keep_rims(result_.dish_count - 1);
    for (const DishSearchView& camera : cameras_) {
      if (!is_within(camera.frame, rim_outline(dish.found.place, camera, 0.0, 0.0)))
        dish.status = StatusCode::dish_cut_off;
    }
    if (dish.status.ok()) ++found_count;
  }
  if (found_count > 0) return StatusCode::ok;
  return taken_count > 0 ? StatusCode::dish_cut_off : StatusCode::rim_not_found;
}

// An outline that is drawn where the card's pose puts the dish only repeats the error of that pose; the edge
// itself does not have it.
void Segmenter::keep_rims(std::size_t dish) const {
  for (std::size_t v = 0; v < 2; ++v) {
    if (memory_.dish.rims[v].empty()) continue;
    SeenRim& rim = views_[v].rims[dish];
    rim.label = result_.dishes[dish].label;
    rim.rays.assign(memory_.dish.rims[v].items());
  }
}

void Segmenter::draw_dishes() const {
  draw_tray_places();
  for (std::size_t d = 0; d < result_.dish_count; ++d) {
    const SegmentedDish& dish = result_.dishes[d];
    if (!dish.status.ok()) continue;
    for (std::size_t v = 0; v < 2; ++v)
      fill_convex(views_[v].labels, rim_outline(dish.found.place, cameras_[v], 0.0, 0.0), dish.label);
  }
}

void Segmenter::draw_items(const FoodOutlineParams& params) {
  result_.items = 0;
  draw_dishes();
  draw_food(params);
}

void Segmenter::read_pictures() {
  const Network& network = *configuration_.network;
  NetworkRunner runner(network, memory_.food.network);
  for (std::size_t v = 0; v < 2; ++v)
    readings_[v] = read_picture(views_[v].frame, network, runner, memory_.food.readings[v]);
}

// Dense matching over every dish, once a pair: it does not depend on how food is drawn.
void Segmenter::look_at_dishes() {
  const std::array<LabelRegions, 2> regions = {measure_regions(views_[0].labels),
                                               measure_regions(views_[1].labels)};
  for (std::size_t d = 0; d < result_.drawn().size(); ++d) {
    const SegmentedDish& dish = result_.dishes[d];
    DishInViews& scene = scenes_[d];
    scene = {};
    if (!dish.status.ok() || !scene.inner.profile.set(dish.model).ok()) continue;
    scene.is_described = true;
    scene.inner.place = frame_of(dish.found.place);
    for (std::size_t v = 0; v < 2; ++v) {
      scene.stored[v] = {views_[v].gray, views_[v].labels, regions[v].boxes[dish.label], cameras_[v].lens,
                         cameras_[v].camera_from_table};
    }
    LabelTable kept{};
    kept[dish.label] = kDishLabel;
    // Without a relief colour has to do.
    if (!measure_height_evidence(scene.stored, kept, scene.inner, params_.relief, memory_.food.reliefs[d],
                                 memory_.food.matching, scene.relief)
             .ok())
      scene.relief = {};
  }
}

void Segmenter::draw_food(const FoodOutlineParams& params) {
  for (std::size_t d = 0; d < result_.drawn().size(); ++d) {
    SegmentedDish& dish = result_.dishes[d];
    dish.items = 0;
    dish.is_split_doubtful = false;
    dish.is_bare = false;
    dish.is_told_by_height = false;
    const DishInViews& scene = scenes_[d];
    if (!scene.is_described) continue;
    const auto first = static_cast<std::uint8_t>(kFirstItemLabel + result_.items);
    const int room = kLastItemLabel + 1 - first;
    DishRaster raster;
    ImageView<std::uint8_t> cells;
    if (!outline_view(dish, scene, 0, raster, cells)) continue;
    const ItemSplit split =
        label_items(raster, readings_[0], params, memory_.food.outline, first, room, cells);
    draw_cells(raster, cells, dish.label, views_[0].labels);
    if (!outline_view(dish, scene, 1, raster, cells)) continue;
    const std::span<const std::uint8_t> second(
        cells.data, static_cast<std::size_t>(raster.width()) * static_cast<std::size_t>(raster.height()));
    dish.is_bare = split.items == 0 && std::find(second.begin(), second.end(), kFoodSeed) == second.end();
    carry_labels(raster, dish, cells);
    spread_items(raster, params, memory_.food.outline, cells);
    draw_cells(raster, cells, dish.label, views_[1].labels);
    dish.items = keep_confirmed(first, split.items, dish.label);
    dish.is_split_doubtful = dish.items > 1 && split.most_alike > params_.doubtful_likeness;
    result_.items += dish.items;
  }
}

// Food and glaze of one dish in one view, as outline_food marks them.
bool Segmenter::outline_view(SegmentedDish& dish, const DishInViews& scene, std::size_t v, DishRaster& raster,
                             ImageView<std::uint8_t>& cells) {
  const DishSearchView& camera = cameras_[v];
  const DishPose& place = dish.found.place;
  const DishProfile& profile = scene.inner.profile;
  RimOutline outline = rim_outline(place, camera, 0.0, 0.0);
  const Vec3 middle = camera.camera_from_table * Vec3(place.centre_mm.x(), place.centre_mm.y(), 0.0);
  const double px_per_mm = camera.lens.pinhole.mean_focal_px() / middle.z();
  if (!load_dish_raster(views_[v].frame, outline, px_per_mm, params_.food.raster, memory_.food.outline.raster,
                        raster))
    return false;
  mark_zone(raster, outline, DishZone::edge);
  const double edge_mm = profile.height_at_inset_mm(0.0);
  const double most_mm = kMostFlange * std::min(place.size_mm[0], place.size_mm[1]);
  double well_mm = params_.flange_begin_mm;
  while (well_mm < most_mm && profile.height_at_inset_mm(well_mm) > edge_mm - params_.flange_depth_mm)
    well_mm += 1.0;
  const auto ring = [&](double inset_mm) {
    return rim_outline(place, camera, -inset_mm, profile.height_at_inset_mm(inset_mm) - edge_mm);
  };
  outline = ring(params_.flange_begin_mm);
  mark_zone(raster, outline, DishZone::flange);
  outline = ring(std::max(well_mm, 2.0 * params_.flange_begin_mm));
  mark_zone(raster, outline, DishZone::inside);
  if (is_tray_place(dish.label)) leave_out_others(dish, v, raster);
  cells = {memory_.food.cells.data(), raster.width(), raster.height()};
  const ImageView<HeightSample> relief{memory_.food.outline.relief.data(), raster.width(), raster.height()};
  lay_height_evidence(scene.relief, v, scene.stored[v], raster, relief);
  if (configuration_.food_observer != nullptr) configuration_.food_observer->on_view(v);
  const bool is_dish = !is_tray_place(dish.label);
  const OutlinedFood outlined =
      outline_food({raster, relief, readings_[v], configuration_.food_observer, is_dish}, params_.food,
                   memory_.food.outline, cells);
  if (!is_dish) keep_seen_food(raster, v, cells);
  dish.is_told_by_height |= outlined.is_told_by_height;
  return outlined.is_outlined;
}

// Seeds for the second view: food that lies on the same item in the first view, whether it is low or high.
void Segmenter::carry_labels(const DishRaster& raster, const SegmentedDish& dish,
                             ImageView<std::uint8_t> cells) const {
  const ImageView<const std::uint8_t> first_labels = views_[0].labels;
  const Pose table_from_second = cameras_[1].camera_from_table.inverse();
  const double bottom_mm = dish.model.bottom_height_mm;
  for (int y = 0; y < raster.height(); ++y) {
    for (int x = 0; x < raster.width(); ++x) {
      std::uint8_t& cell = cells.at(x, y);
      if (cell != kFoodSeed) continue;
      cell = kUnlabelled;
      Vec2 ray;
      if ((x | y) % kSeedStep != 0 || !cameras_[1].lens.undistort_pixel(raster.pixel_of(x, y), ray)) continue;
      const Vec3 direction = table_from_second.rotation * ray.homogeneous();
      std::uint8_t label = kBackgroundLabel;
      for (const double height_mm : params_.food_heights_mm) {
        const double depth = (bottom_mm + height_mm - table_from_second.translation.z()) / direction.z();
        const Vec3 point =
            cameras_[0].camera_from_table * (table_from_second.translation + depth * direction);
        const Vec2 pixel = cameras_[0].lens.pixel(point.hnormalized());
        const int px = static_cast<int>(std::lround(pixel.x()));
        const int py = static_cast<int>(std::lround(pixel.y()));
        const std::uint8_t seen = first_labels.contains(px, py) ? first_labels.at(px, py) : kBackgroundLabel;
        const bool agrees = label == kBackgroundLabel || label == seen;
        label = agrees && is_item(seen) ? seen : kBarred;
      }
      if (label != kBarred) cell = label;
    }
  }
}

// Over the dish's own pixels.
void Segmenter::draw_cells(const DishRaster& raster, ImageView<const std::uint8_t> cells, std::uint8_t dish,
                           ImageView<std::uint8_t> labels) {
  for (int y = 0; y < raster.height(); ++y) {
    for (int x = 0; x < raster.width(); ++x) {
      if (!is_item(cells.at(x, y))) continue;
      const int left = raster.left_px + x * raster.step_px;
      const int top = raster.top_px + y * raster.step_px;
      for (int j = 0; j < raster.step_px; ++j) {
        for (int i = 0; i < raster.step_px; ++i) {
          std::uint8_t& label = labels.at(left + i, top + j);
          if (label == dish) label = cells.at(x, y);
        }
      }
    }
  }
}

}  // namespace traygauge
