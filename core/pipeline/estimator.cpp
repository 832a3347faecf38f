#include "core/pipeline/estimator.hpp"

#include <algorithm>
#include <utility>

#include "core/paper/pipeline/feature_preparation.hpp"
#include "core/pipeline/estimator_state.hpp"

namespace traygauge {
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
  if (state.configuration.profile == Profile::best) {
    BestView& view = state.best.views[static_cast<std::size_t>(state.views)];
    view.lens = lens;
    view.arm_angle_deg = input.arm_angle_deg;
    view.labels = input.labels;
    view.are_outlines_found = input.are_outlines_found;
    return prepare_best_view({input.frame, input.gray, input.card}, state.configuration, state.best.pattern,
                             state.best.preparation, state.preparation_clock, view);
  }
  PreparedView& view = state.view(state.views);
  view.lens = lens;
  view.arm_angle_deg = input.arm_angle_deg;
  view.labels = input.labels;
  view.keypoints.clear();
  state.preparation_clock.enter(Stage::image);
  return prepare_picture(input.frame, state.configuration, state.memory.preparation, view);
}

bool takes_views(const EstimatorState& state) {
  return state.views < 2;
}

// Profile best makes its own tracks.
bool takes_correspondences(const EstimatorState& state) {
  return state.configuration.profile == Profile::paper;
}

Status finish_view(EstimatorState& state, Status status) {
  state.preparation_clock.stop();
  if (state.views == 0 || state.views_status.ok()) state.views_status = status;
  ++state.views;
  return status;
}

}  // namespace

std::size_t estimator_state_bytes() {
  return aligned_bytes(sizeof(EstimatorState));
}

std::size_t required_bytes(const Configuration& configuration) {
  return estimator_state_bytes() + planned_bytes(configuration);
}

std::size_t required_bytes(const EstimatorLimits& limits, Profile profile) {
  Configuration configuration;
  configuration.profile = profile;
  configuration.limits = limits;
  return required_bytes(configuration);
}

void EstimatorState::place_pattern(int width_px) {
  const ReferenceCard& card = configuration.card;
  for (std::size_t i = 0; i < memory.pattern.keypoints.size(); ++i) {
    memory.pattern.positions_mm[i] = pattern_mm(memory.pattern.keypoints[i].pixel, width_px, card.size());
  }
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
  const bool is_best = configuration.profile == Profile::best;
  if (is_best) {
    state.best.allocate(arena, configuration);
  } else {
    state.memory.allocate(arena, configuration);
  }
  if (arena.exhausted()) {
    status_ = StatusCode::out_of_memory;
    return;
  }
  state.extrinsics.inliers = BoundedList<RayMatch>(state.memory.extrinsics.inliers);
  state.extrinsics.card_points = BoundedList<Vec3>(state.memory.extrinsics.card_points);
  state.reserved_bytes = block.size();
  state.used_bytes = arena.high_water_bytes();
  if (is_best) {
    state.idle = block.first(state.used_bytes).subspan(state.best.kept_bytes);
    const ReferenceCard& card = configuration.card;
    status_ =
        prepare_card_pattern(card.pattern, card.size(), configuration.best.card.pattern, state.best.pattern);
    if (!status_.ok()) return;
  } else {
    state.set_up_pattern(configuration.card.pattern);
  }
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
  if (!takes_views(*state_)) return StatusCode::wrong_call;
  Status status = start_view(*state_, input);
  if (status.ok() && state_->configuration.profile == Profile::paper) {
    state_->preparation_clock.enter(Stage::features);
    status = prepare_features(state_->configuration, state_->memory.preparation, state_->view(state_->views));
  }
  return finish_view(*state_, status);
}

Status Estimator::add_view(const ViewInput& input, const GivenFeatures& features) {
  if (!status_.ok()) return status_;
  if (!takes_views(*state_) || !takes_correspondences(*state_)) return StatusCode::wrong_call;
  Status status = start_view(*state_, input);
  if (status.ok()) {
    state_->preparation_clock.enter(Stage::features);
    status = take_features(features.keypoints, features.descriptors, state_->configuration.view,
                           state_->view(state_->views));
  }
  return finish_view(*state_, status);
}

Status Estimator::add_view_without_features(const ViewInput& input) {
  if (!status_.ok()) return status_;
  if (!takes_views(*state_) || !takes_correspondences(*state_)) return StatusCode::wrong_call;
  return finish_view(*state_, start_view(*state_, input));
}

Status Estimator::set_pattern(const GivenFeatures& features, int picture_width_px) {
  if (!status_.ok()) return status_;
  if (!takes_correspondences(*state_) || features.keypoints.size() != features.descriptors.size() ||
      picture_width_px <= 0) {
    return StatusCode::wrong_call;
  }
  PatternMemory& pattern = state_->memory.pattern;
  pattern.keypoints.clear();
  for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
    if (!pattern.keypoints.push_back(features.keypoints[i])) break;
    pattern.descriptors[i] = features.descriptors[i];
  }
  state_->place_pattern(picture_width_px);
  return StatusCode::ok;
}

Status Estimator::set_matches(std::span<const GivenMatch> matches,
                              std::span<const GivenCardMatch> card_matches) {
  if (!status_.ok()) return status_;
  if (!takes_correspondences(*state_) || state_->views != 2 || matches.empty()) return StatusCode::wrong_call;
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
  if (!takes_correspondences(*state_)) return StatusCode::wrong_call;
  state_->motion_search = search;
  return StatusCode::ok;
}

const Measurement& Estimator::estimate(std::uint64_t seed, StageTap* tap) {
  measurement_ = {};
  measurement_.status = status_;
  if (!status_.ok()) return measurement_;
  StageClock clock = state_->preparation_clock;
  run_measurement(*state_, seed, tap, clock, measurement_);
  clock.stop();
  measurement_.stage_ms = clock.stage_ms();
  measurement_.total_ms = clock.total_ms();
  return measurement_;
}

ImageView<std::uint8_t> Estimator::gray_memory(std::size_t view) const {
  const bool keeps_gray = state_ != nullptr && state_->configuration.profile == Profile::best;
  return keeps_gray ? state_->best.views[view].gray_storage : ImageView<std::uint8_t>{};
}

std::span<std::byte> Estimator::idle_memory() const {
  return state_ == nullptr ? std::span<std::byte>() : state_->idle;
}

const CardPattern* Estimator::card_pattern() const {
  const bool is_best = state_ != nullptr && state_->configuration.profile == Profile::best;
  return is_best ? &state_->best.pattern : nullptr;
}

void Estimator::reset() {
  if (state_ != nullptr) state_->views = 0;
}

}  // namespace traygauge
