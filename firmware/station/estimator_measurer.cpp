#include "firmware/station/estimator_measurer.hpp"

#include "firmware/network/food_network.hpp"

namespace traygauge {
namespace {

// What memory depends on.
Configuration with_limits(Configuration configuration, const FrameLimits& limits, bool finds_labels) {
  configuration.limits = limits;
  configuration.network = finds_labels ? &food_network() : nullptr;
  return configuration;
}

}  // namespace

EstimatorMeasurer::EstimatorMeasurer(Scene& scene, const FrameLimits& limits, std::uint64_t seed)
    : scene_(scene),
      limits_(limits),
      seed_(seed),
      block_(required_bytes(with_limits({}, limits, scene.needs_labels()))) {}

// The card's pattern is learned again only when the configuration is another one.
void EstimatorMeasurer::begin_scan(const TrayHint& hint) {
  const Configuration* configuration = scene_.configuration();
  if (configuration == nullptr) {
    estimator_.reset();
  } else if (configuration != configured_with_ || !estimator_) {
    estimator_.emplace(block_.bytes(), with_limits(*configuration, limits_, scene_.needs_labels()));
  } else {
    estimator_->reset();
  }
  status_ = estimator_ ? expect(*configuration, hint) : Status(StatusCode::wrong_call);
  configured_with_ = configuration;
  first_view_.reset();
  view_count_ = 0;
}

Status EstimatorMeasurer::expect(const Configuration& configuration, const TrayHint& hint) {
  return estimator_->expect(scene_.dishes(hint),
                            hint.foods > 0 ? hint.foods : configuration.segmentation.items);
}

Status EstimatorMeasurer::add_view(const StationView& view) {
  if (!status_.ok()) return status_;
  const ViewInput input = scene_.describe(view);
  if (!first_view_) first_view_ = input;
  if (view_count_ < views_.size()) views_[view_count_++] = view;
  return estimator_->add_view(input);
}

// Looks for the card of the first view only here: who has an arm does not need it.
std::optional<double> EstimatorMeasurer::turned_deg(const FrameView& live) {
  if (configured_with_ == nullptr || !first_view_) return std::nullopt;
  if (!first_view_->frame.empty()) {
    guide_.begin(configured_with_->card, first_view_->lens.value_or(configured_with_->lens),
                 first_view_->frame, estimator_ ? estimator_->scratch() : std::span<std::byte>());
    first_view_->frame = {};
  }
  return guide_.turned_deg(live);
}

const Measurement& EstimatorMeasurer::measure() {
  if (!status_.ok()) {
    unmeasured_.status = status_;
    return unmeasured_;
  }
  const Measurement& measurement = estimator_->estimate(seed_);
  if (is_measured(measurement)) watch_lens();
  return measurement;
}

// Two cameras have a lens each: what is at the same place of both pictures is on neither.
void EstimatorMeasurer::watch_lens() {
  if (view_count_ < 2 || views_[1].is_of_second_camera) return;
  lens_watch_.add({{{views_[0].frame, estimator_->labels(0)}, {views_[1].frame, estimator_->labels(1)}}});
}

}  // namespace traygauge
