#include "core/pipeline/tray_estimator.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>

#include "core/pipeline/lens_doubt.hpp"
#include "core/pipeline/segmenter.hpp"
#include "core/pipeline/stage_clock.hpp"
#include "core/pipeline/tray_measurement.hpp"
#include "core/pipeline/tray_memory.hpp"

namespace traygauge {

// What an estimator keeps in its block.
struct EstimatorState {
  Configuration configuration;  // without the pattern's pixels, which are read at construction only
  std::array<DishModel, kMaxDishCandidates> dishes{};
  TrayMemory memory;
  std::span<std::byte> shared;  // of the block: what only stages at work use
  std::size_t reserved_bytes = 0;
  std::size_t used_bytes = 0;
  double setup_ms = 0.0;
  std::array<ViewInput, 2> inputs;
  std::size_t views = 0;         // taken so far
  Status views_status;           // the first thing that went wrong with them
  StageClock preparation_clock;  // of views with given labels, which are prepared as they come
  std::optional<Segmenter> segmenter;
  Segmentation segmentation;
  bool is_finding_labels = false;
  Measurement doubted;  // while other lenses are tried
};

namespace {

ImageView<std::uint8_t> of_size(ImageView<std::uint8_t> storage, const FrameView& frame) {
  return {storage.data, frame.width, frame.height};
}

Status prepare(EstimatorState& state, std::size_t index, const GivenPicture& picture,
               ImageView<const std::uint8_t> labels, StageClock& clock) {
  const ViewInput& input = state.inputs[index];
  TrayView& view = state.memory.views[index];
  view.lens = input.lens.value_or(state.configuration.lens);
  view.arm_angle_deg = input.arm_angle_deg;
  view.labels = labels;
  view.rims = {};
  if (state.is_finding_labels) view.rims = state.memory.seen_rims[index];
  if (const Status status = validate(view.lens); !status.ok()) return status;
  const Status status = prepare_tray_view(picture, state.configuration, state.memory.pattern,
                                          state.memory.preparation, clock, view);
  clock.stop();
  return status;
}

// Its grey picture goes where a measurement keeps it, which then need not make it again.
SegmentedView segmented_view(EstimatorState& state, std::size_t index) {
  const ViewInput& input = state.inputs[index];
  SegmentedView view;
  view.frame = input.frame;
  view.lens = input.lens.value_or(state.configuration.lens);
  const FrameLimits& limits = state.configuration.limits;
  if (input.frame.width > limits.max_frame_width || input.frame.height > limits.max_frame_height) return view;
  view.labels = of_size(state.memory.found_labels[index], input.frame);
  view.gray = of_size(state.memory.views[index].gray_storage, input.frame);
  view.rims = state.memory.seen_rims[index];
  return view;
}

Status find_labels(EstimatorState& state, std::size_t index) {
  if (index == 0)
    state.segmenter.emplace(state.configuration, state.memory.pattern, state.memory.segmentation,
                            state.segmentation);
  const Status status = state.segmenter->add_view(segmented_view(state, index));
  if (index == 0) return status;
  state.segmenter->segment();
  return state.segmentation.status;
}

Status prepare_found_views(EstimatorState& state, StageClock& clock) {
  for (std::size_t i = 0; i < 2; ++i) {
    const SegmentedView found = segmented_view(state, i);
    const Status status =
        prepare(state, i, {found.frame, found.gray, &state.segmentation.cards[i]}, found.labels, clock);
    if (!status.ok()) return status;
  }
  return StatusCode::ok;
}

double scale_or_infinity(const std::optional<double>& scale_percent) {
  return scale_percent.value_or(std::numeric_limits<double>::infinity());
}

Status check_views(const EstimatorState& state) {
  if (state.views > 0 && !state.views_status.ok()) return state.views_status;
  return state.views == 2 ? StatusCode::ok : StatusCode::frame_missing;
}

}  // namespace

std::size_t estimator_state_bytes() {
  return aligned_bytes(sizeof(EstimatorState));
}

std::size_t required_bytes(const Configuration& configuration) {
  ArenaPlan plan;
  TrayMemory memory;
  memory.allocate(plan, configuration);
  return estimator_state_bytes() + plan.high_water_bytes();
}

TrayEstimator::TrayEstimator(std::span<std::byte> block, const Configuration& configuration) {
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
  state.reserved_bytes = block.size();
  state.used_bytes = arena.high_water_bytes();
  state.shared = block.first(state.used_bytes).subspan(state.memory.kept_bytes);
  const ReferenceCard& card = configuration.card;
  status_ = prepare_card_pattern(card.pattern, card.size(), configuration.card_alignment.pattern,
                                 state.memory.pattern);
  if (!status_.ok()) return;
  clock.stop();
  state.setup_ms = clock.total_ms();
  state_ = &state;
}

double TrayEstimator::setup_ms() const {
  return state_ == nullptr ? 0.0 : state_->setup_ms;
}

std::size_t TrayEstimator::reserved_bytes() const {
  return state_ == nullptr ? 0 : state_->reserved_bytes;
}

std::size_t TrayEstimator::used_bytes() const {
  return state_ == nullptr ? 0 : state_->used_bytes;
}

Status TrayEstimator::expect(std::span<const DishModel> dishes, int items) {
  if (!status_.ok()) return status_;
  EstimatorState& state = *state_;
  if (state.views == 1) return StatusCode::wrong_call;
  if (const Status status = validate_dishes(dishes); !status.ok()) return status;
  if (items < 0 || items > static_cast<int>(kMaxItems)) return StatusCode::invalid_configuration;
  std::copy(dishes.begin(), dishes.end(), state.dishes.begin());
  state.configuration.dishes = std::span(state.dishes).first(dishes.size());
  state.configuration.segmentation.items = items;
  return StatusCode::ok;
}

Status TrayEstimator::add_view(const ViewInput& input) {
  if (!status_.ok()) return status_;
  EstimatorState& state = *state_;
  if (state.views == state.inputs.size()) return StatusCode::wrong_call;
  if (state.views == 0) {
    state.preparation_clock = {};
    state.views_status = {};
    state.is_finding_labels = state.configuration.network != nullptr && input.labels.empty();
  }
  const std::size_t index = state.views++;
  state.inputs[index] = input;
  const Status status = state.is_finding_labels
                            ? find_labels(state, index)
                            : prepare(state, index, {input.frame}, input.labels, state.preparation_clock);
  if (state.views_status.ok()) state.views_status = status;
  return status;
}

const Measurement& TrayEstimator::estimate(std::uint64_t seed, StageObserver* observer) {
  measurement_ = {};
  measurement_.status = status_;
  if (!status_.ok()) return measurement_;
  measure(seed, observer);
  if (state_->views == 2 && may_be_the_lens(measurement_)) doubt_lens(seed);
  return measurement_;
}

void TrayEstimator::measure(std::uint64_t seed, StageObserver* observer, Extent extent) {
  measurement_ = {};
  EstimatorState& state = *state_;
  StageClock clock = state.preparation_clock;
  measurement_.status = check_views(state);
  const bool is_found = state.is_finding_labels && state.views > 0;
  const bool is_bare = is_found && measurement_.status.ok() && state.segmentation.is_bare();
  if (measurement_.status.ok() && is_found && !is_bare)
    measurement_.status = prepare_found_views(state, clock);
  const auto work = extent == Extent::measured ? measure_tray : locate_tray;
  if (measurement_.status.ok() && !is_bare)
    work(state.memory, state.configuration, is_found ? &state.segmentation : nullptr, seed, observer, clock,
         measurement_);
  if (is_found && state.segmentation.status.ok()) {
    warn_about_labels(state.segmentation, measurement_.warnings);
    measurement_.status = blame_card(state.segmentation, measurement_.status);
  }
  clock.stop();
  measurement_.stage_ms = clock.stage_ms();
  measurement_.segmentation_ms = is_found ? state.segmentation.total_ms() : 0.0;
  measurement_.total_ms = clock.total_ms() + measurement_.segmentation_ms;
}

// Locates the tray through each lens, which contradicts most of them already, and measures through those that
// are left, the best one first. Locating leaves surfaces and items alone, so that the pair as given is
// measured again only where another lens was measured.
void TrayEstimator::doubt_lens(std::uint64_t seed) {
  const LensDoubtParams& params = state_->configuration.lens_doubt;
  const std::array<ViewInput, 2> given = state_->inputs;
  state_->doubted = measurement_;
  double spent_ms = measurement_.total_ms;
  const auto scale_through = [&](const LensChange& change, Extent extent) {
    std::array<ViewInput, 2> changed = given;
    for (ViewInput& view : changed) view.lens = change.of(view.lens.value_or(state_->configuration.lens));
    take_again(changed);
    measure(seed, nullptr, extent);
    spent_ms += measurement_.total_ms;
    const std::optional<double> scale_percent = scale_if_all_agrees(measurement_);
    return scale_percent && *scale_percent <= params.max_scale_percent ? scale_percent : std::nullopt;
  };
  std::array<std::optional<double>, std::tuple_size_v<decltype(params.tried)>> located;
  std::ranges::transform(params.tried, located.begin(),
                         [&](const LensChange& change) { return scale_through(change, Extent::located); });
  const LensChange* best = nullptr;
  bool is_overwritten = false;
  while (best == nullptr) {
    auto* const next = std::ranges::min_element(located, {}, scale_or_infinity);
    if (!*next) break;
    next->reset();
    const LensChange& change = params.tried[static_cast<std::size_t>(next - located.begin())];
    if (scale_through(change, Extent::measured)) best = &change;
    is_overwritten = true;
  }
  take_again(given);
  if (is_overwritten) {
    measure(seed, nullptr);
    spent_ms += measurement_.total_ms;
  } else {
    measurement_ = state_->doubted;
    spent_ms += measurement_.segmentation_ms;
  }
  measurement_.total_ms = spent_ms;
  if (best != nullptr)
    blame_lens(*best, params, {state_->memory.dish.items.begin(), measurement_.items.size()}, measurement_);
}

void TrayEstimator::take_again(const std::array<ViewInput, 2>& inputs) {
  reset();
  // What goes wrong with them, measure() finds again.
  for (const ViewInput& input : inputs) static_cast<void>(add_view(input));
}

const Segmentation* TrayEstimator::segmentation() const {
  return state_ != nullptr && state_->views > 0 && state_->is_finding_labels ? &state_->segmentation
                                                                             : nullptr;
}

ImageView<const std::uint8_t> TrayEstimator::labels(std::size_t view) const {
  if (state_ == nullptr || view >= state_->views) return {};
  return state_->is_finding_labels ? segmented_view(*state_, view).labels : state_->inputs[view].labels;
}

std::span<std::byte> TrayEstimator::scratch() const {
  return state_ == nullptr ? std::span<std::byte>()
                           : state_->shared.subspan(state_->memory.segmentation.kept_bytes);
}

void TrayEstimator::reset() {
  if (state_ == nullptr) return;
  state_->views = 0;
  state_->segmentation = {};
}

}  // namespace traygauge
