#include "core/estimator/segmenter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/image/resample.hpp"
#include "core/scale/card_hypotheses.hpp"
#include "core/segmentation/convex_fill.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kRimCorners = 180;     // of the polygon that an ellipse is drawn as
constexpr std::size_t kCardSideCorners = 8;  // on each side, which a lens bends

CardModelSize size_of(const ReferenceCard& card) {
  return {card.width_mm, card.height_mm, card.thickness_mm};
}

Vec2 pixel_of(const Vec2& ray, const LensModel& lens) {
  return lens.pinhole.pixel(lens.distort(ray));
}

// Four straight sides through the lens.
std::array<Vec2, 4 * kCardSideCorners> outline_of(const std::array<Vec2, 4>& corners, const LensModel& lens) {
  std::array<Vec2, 4 * kCardSideCorners> outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t side = i / kCardSideCorners;
    const double t = static_cast<double>(i % kCardSideCorners) / kCardSideCorners;
    outline[i] = pixel_of((1.0 - t) * corners[side] + t * corners[(side + 1) % 4], lens);
  }
  return outline;
}

std::array<Vec2, 4> corners_of(const Pose& camera_from_table, const CardModelSize& size) {
  std::array<Vec2, 4> corners = print_corners_mm(size);
  for (Vec2& corner : corners)
    corner = (camera_from_table * print_point_mm(corner, size.thickness_mm)).hnormalized();
  return corners;
}

void clear(ImageView<std::uint8_t> labels) {
  for (int y = 0; y < labels.height; ++y) std::fill_n(labels.row(y), labels.width, kBackgroundLabel);
}

}  // namespace

template <class Allocator>
constexpr void Segmenter::Memory::allocate(Allocator& arena, const Configuration& configuration,
                                           const SegmenterParams& params) {
  const EstimatorLimits& limits = configuration.limits;
  pattern.allocate(arena, configuration.best.card.pattern);
  print.allocate(arena, params.card);
  dish.allocate(arena, params.dish);
  gray = arena.template take_image<std::uint8_t>(limits.max_frame_width, limits.max_frame_height);
  alignment.allocate(arena, configuration.best.card);
  card.allocate(arena, limits.max_frame_width, limits.max_frame_height, params.card);
}

std::size_t segmenter_bytes(const Configuration& configuration, const SegmenterParams& params) {
  ArenaPlan plan;
  Segmenter::Memory memory;
  memory.allocate(plan, configuration, params);
  return plan.high_water_bytes();
}

Segmenter::Segmenter(std::span<std::byte> block, const Configuration& configuration,
                     const SegmenterParams& params)
    : configuration_(configuration), params_(params) {
  status_ = validate(configuration);
  if (!status_.ok()) return;
  std::copy(configuration.dishes.begin(), configuration.dishes.end(), dishes_.begin());
  configuration_.dishes = std::span<const DishModel>(dishes_).first(configuration.dishes.size());
  configuration_.card.pattern = {};
  Arena arena(block);
  memory_.allocate(arena, configuration_, params_);
  if (arena.exhausted()) {
    status_ = StatusCode::out_of_memory;
    return;
  }
  status_ = prepare_card_pattern(configuration.card.pattern, size_of(configuration.card),
                                 configuration.best.card.pattern, memory_.pattern);
  if (status_.ok()) status_ = learn_print_corners(memory_.pattern, params_.card, memory_.card, memory_.print);
}

const Segmentation& Segmenter::segment(const std::array<SegmentedView, 2>& views) {
  result_ = {};
  result_.status = status_;
  StageClock clock;
  DishSearchViews cameras;
  clock.enter(Stage::scale);
  for (std::size_t v = 0; v < 2 && result_.status.ok(); ++v) {
    cameras[v].frame = views[v].frame;
    cameras[v].lens = views[v].lens.value_or(configuration_.lens);
    result_.status = find_card(views[v], cameras[v].lens, v);
    cameras[v].camera_from_table = result_.cards[v].camera_from_table;
  }
  if (result_.status.ok()) {
    clock.enter(Stage::surface);
    result_.status = find_dishes(cameras);
  }
  if (result_.status.ok()) draw_dishes(views, cameras);
  clock.stop();
  result_.card_ms = clock.stage_ms()[static_cast<std::size_t>(Stage::scale)];
  result_.dish_ms = clock.stage_ms()[static_cast<std::size_t>(Stage::surface)];
  return result_;
}

// The search gives the outline to a pixel or two; the alignment of the print, which a labelled card gets
// anyway, the rest.
Status Segmenter::find_card(const SegmentedView& view, const LensModel& lens, std::size_t index) {
  const FrameView& frame = view.frame;
  if (frame.width != lens.width || frame.height != lens.height || frame.width > memory_.gray.width ||
      frame.height > memory_.gray.height || view.labels.width != frame.width ||
      view.labels.height != frame.height) {
    return StatusCode::frame_size_mismatch;
  }
  const ImageView<std::uint8_t> gray{memory_.gray.data, frame.width, frame.height};
  convert_to_gray(frame, gray);
  clear(view.labels);
  collect_rim_edges(gray, lens, params_.dish.edges, memory_.dish.edge_search, memory_.dish.edges[index]);
  const CardModelSize size = size_of(configuration_.card);
  std::array<Vec2, 4> corners;
  Status status = search_card(gray, lens, size, memory_.print, params_.card, configuration_.card_search,
                              memory_.card, corners);
  if (!status.ok()) return status;
  // An outline that is off by some pixels may end in a print half aligned, which a second start mends.
  CardAlignment& card = result_.cards[index];
  for (int round = 0; round < params_.max_alignments; ++round) {
    clear(view.labels);
    fill_convex(view.labels, outline_of(corners, lens), kCardLabel);
    CardAlignment aligned;
    const Status reached = align_card(gray, view.labels, measure_regions(view.labels).card, lens,
                                      memory_.pattern, configuration_.best.card, memory_.alignment, aligned);
    if (!reached.ok() && round == 0) return reached;
    if (!reached.ok() || aligned.correlation <= card.correlation) break;
    card = aligned;
    corners = corners_of(card.camera_from_table, size);
    if (card.correlation >= params_.sure_correlation) break;
  }
  clear(view.labels);
  fill_convex(view.labels, outline_of(corners, lens), kCardLabel);
  return StatusCode::ok;
}

Status Segmenter::find_dishes(const DishSearchViews& views) {
  std::array<FoundDish, kMaxPlacedDishes> taken;
  std::size_t taken_count = 0;
  std::span<const DishModel> rest = configuration_.dishes;
  while (!rest.empty()) {
    const std::uint8_t label = rest.front().label;
    const auto end = std::find_if_not(rest.begin(), rest.end(),
                                      [&](const DishModel& dish) { return dish.label == label; });
    const std::span<const DishModel> candidates(rest.begin(), end);
    rest = {end, rest.end()};
    if (result_.dish_count == kMaxPlacedDishes) return StatusCode::too_many_dishes;
    SegmentedDish& dish = result_.dishes[result_.dish_count++];
    dish.label = label;
    dish.status = search_dish(views, candidates, std::span(taken).first(taken_count), params_.dish,
                              memory_.dish, dish.found);
    if (dish.status.ok()) taken[taken_count++] = dish.found;
  }
  return taken_count > 0 ? StatusCode::ok : StatusCode::rim_not_found;
}

void Segmenter::draw_dishes(const std::array<SegmentedView, 2>& views, const DishSearchViews& cameras) {
  std::array<Vec2, kRimCorners> outline;
  for (std::size_t d = 0; d < result_.dish_count; ++d) {
    const SegmentedDish& dish = result_.dishes[d];
    if (!dish.status.ok()) continue;
    for (std::size_t v = 0; v < 2; ++v) {
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kRimCorners;
        const Vec3 point = rim_point_mm(dish.found.place, {std::cos(angle), std::sin(angle)}, 0.0);
        outline[i] = pixel_of((cameras[v].camera_from_table * point).hnormalized(), cameras[v].lens);
      }
      fill_convex(views[v].labels, outline, dish.label);
    }
  }
}

}  // namespace traygauge
