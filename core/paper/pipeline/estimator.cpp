#include "core/paper/pipeline/estimator.hpp"

#include <algorithm>
#include <utility>

#include "core/paper/image/integral.hpp"
#include "core/paper/pipeline/estimator_state.hpp"
#include "core/paper/pipeline/feature_preparation.hpp"

namespace traygauge::paper {
namespace {

// Checks the picture and prepares what does not need features; the view counts once finish_view was called.
Status start_view(EstimatorState& state, const ViewInput& input) {
  if (state.views == 0) {
    state.preparation_clock = {};
    state.memory.given.matches.clear();
    state.memory.given.card_tracks.clear();
  }
  const LensModel lens = input.lens.value_or(state.configuration.lens);
  if (const Status status = validate(lens); !status.ok()) return status;
  PreparedView& view = state.view(state.views);
  view.lens = lens;
  view.arm_angle_deg = input.arm_angle_deg;
  view.labels = input.labels;
  view.keypoints.clear();
  state.preparation_clock.enter(Stage::image);
  return prepare_picture(input.frame, state.configuration, state.memory.preparation, view);
}

Status finish_view(EstimatorState& state, Status status) {
  state.preparation_clock.stop();
  if (state.views == 0 || state.views_status.ok()) state.views_status = status;
  ++state.views;
  return status;
}

// Finds the features of the card's print. Its picture is reduced to about the scale at which cameras see the
// card, so that box filters meet like structures.
void set_up_pattern(EstimatorState& state, ImageView<const std::uint8_t> picture) {
  const Configuration& configuration = state.configuration;
  PreparationWorkspace& scratch = state.memory.preparation;
  PatternMemory& pattern = state.memory.pattern;
  const double wanted_px = configuration.view.card_px_per_mm * configuration.card.width_mm;
  const double scale = fit_search_scale(std::min(1.0, wanted_px / picture.width), picture.width,
                                        picture.height, configuration);
  const int width = std::max(1, static_cast<int>(picture.width * scale));
  const int height = std::max(1, static_cast<int>(picture.height * scale));
  const ImageView<std::uint8_t> reduced{scratch.feature_picture.data(), width, height};
  reduce_area(picture, reduced);
  const ImageView<std::uint32_t> integral{scratch.integral.data(), width + 1, height + 1};
  build_integral(reduced, integral);
  detect_surf(integral, configuration.surf, scratch.surf, pattern.keypoints);
  const std::size_t count = pattern.keypoints.size();
  describe_surf(integral, pattern.keypoints.items(), pattern.descriptors.first(count));
  for (std::size_t i = 0; i < count; ++i) {
    pattern.positions_mm[i] = pattern_mm(pattern.keypoints[i].pixel, width, configuration.card.size());
  }
}

}  // namespace

std::size_t estimator_state_bytes() {
  return aligned_bytes(sizeof(EstimatorState));
}

std::size_t required_bytes(const Configuration& configuration) {
  return estimator_state_bytes() + planned_bytes(configuration);
}

Estimator::Estimator(std::span<std::byte> block, const Configuration& configuration) {
  status_ = validate(configuration);
  if (!status_.ok()) return;
  StageClock clock;
  clock.enter(Stage::image);
  Arena arena(block);
  const auto storage = arena.take<EstimatorState>(1);
  if (storage.empty()) {
    status_ = StatusCode::out_of_memory;
    return;
  }
  EstimatorState& state = storage.front();
  state.configuration = configuration;
  std::copy(configuration.dishes.begin(), configuration.dishes.end(), state.dishes.begin());
  state.configuration.dishes = std::span(state.dishes).first(configuration.dishes.size());
  state.configuration.card.pattern = {};
  state.memory.allocate(arena, configuration);
  if (arena.exhausted()) {
    status_ = StatusCode::out_of_memory;
    return;
  }
  state.extrinsics.inliers = BoundedList<RayMatch>(state.memory.extrinsics.inliers);
  state.extrinsics.card_points = BoundedList<Vec3>(state.memory.extrinsics.card_points);
  state.reserved_bytes = block.size();
  state.used_bytes = arena.high_water_bytes();
  set_up_pattern(state, configuration.card.pattern);
  clock.stop();
  state.setup_ms = clock.total_ms();
  state_ = &state;
}

double Estimator::setup_ms() const {
  return state_ == nullptr ? 0.0 : state_->setup_ms;
}

std::size_t Estimator::reserved_bytes() const {
  return state_ == nullptr ? 0 : state_->reserved_bytes;
}

std::size_t Estimator::used_bytes() const {
  return state_ == nullptr ? 0 : state_->used_bytes;
}

Status Estimator::add_view(const ViewInput& input) {
  if (!status_.ok()) return status_;
  if (state_->views == 2) return StatusCode::wrong_call;
  Status status = start_view(*state_, input);
  if (status.ok()) {
    state_->preparation_clock.enter(Stage::features);
    status = prepare_features(state_->configuration, state_->memory.preparation, state_->view(state_->views));
  }
  return finish_view(*state_, status);
}

Status Estimator::add_view_without_features(const ViewInput& input) {
  if (!status_.ok()) return status_;
  if (state_->views == 2) return StatusCode::wrong_call;
  return finish_view(*state_, start_view(*state_, input));
}

Status Estimator::set_matches(std::span<const GivenMatch> matches,
                              std::span<const GivenCardMatch> card_matches) {
  if (!status_.ok()) return status_;
  if (state_->views != 2 || matches.empty()) return StatusCode::wrong_call;
  const LensModel& first = state_->view(0).lens;
  const LensModel& second = state_->view(1).lens;
  GivenCorrespondences& given = state_->memory.given;
  given.matches.clear();
  given.card_tracks.clear();
  for (const GivenMatch& match : matches) {
    RayMatch rays;
    if (!first.undistort_pixel(match.first, rays.first) || !second.undistort_pixel(match.second, rays.second))
      continue;
    if (state_->works_in_reverse()) std::swap(rays.first, rays.second);
    given.matches.push_back(rays);
  }
  for (const GivenCardMatch& match : card_matches) {
    CardTrack track;
    track.pattern_mm = match.pattern_mm;
    if (!first.undistort_pixel(match.first, track.first)) continue;
    if (!second.undistort_pixel(match.second, track.second)) continue;
    if (state_->works_in_reverse()) std::swap(track.first, track.second);
    given.card_tracks.push_back(track);
  }
  return StatusCode::ok;
}

Status Estimator::set_motion_search(MotionSearch* search) {
  if (!status_.ok()) return status_;
  state_->motion_search = search;
  return StatusCode::ok;
}

const Measurement& Estimator::estimate(std::uint64_t seed) {
  measurement_ = {};
  measurement_.status = status_;
  if (!status_.ok()) return measurement_;
  StageClock clock = state_->preparation_clock;
  run_measurement(*state_, seed, clock, measurement_);
  clock.stop();
  measurement_.stage_ms = clock.stage_ms();
  measurement_.total_ms = clock.total_ms();
  return measurement_;
}

const WorkingPictures& Estimator::pictures() const {
  static constexpr WorkingPictures kNone{};
  return state_ == nullptr ? kNone : state_->pictures;
}

void Estimator::reset() {
  if (state_ != nullptr) state_->views = 0;
}

}  // namespace traygauge::paper
