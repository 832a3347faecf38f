#include "firmware/station/estimator_measurer.hpp"

namespace traygauge {
namespace {

// What memory depends on.
Configuration with_limits(Configuration configuration, const FrameLimits& limits, bool finds_labels) {
  configuration.limits = limits;
  configuration.finds_labels = finds_labels;
  return configuration;
}

}  // namespace

EstimatorMeasurer::EstimatorMeasurer(Scene& scene, const FrameLimits& limits, std::uint64_t seed)
    : scene_(scene),
      limits_(limits),
      seed_(seed),
      block_(required_bytes(with_limits({}, limits, scene.needs_labels()))) {}

// The card's pattern is learned again only when the configuration is another one.
void EstimatorMeasurer::begin_scan() {
  const Configuration* configuration = scene_.configuration();
  if (configuration == nullptr) {
    estimator_.reset();
  } else if (configuration != configured_with_ || !estimator_) {
    estimator_.emplace(block_.bytes(), with_limits(*configuration, limits_, scene_.needs_labels()));
  } else {
    estimator_->reset();
  }
  configured_with_ = configuration;
  first_view_.reset();
}

Status EstimatorMeasurer::add_view(const StationView& view) {
  if (!estimator_) return StatusCode::wrong_call;
  if (!estimator_->status().ok()) return estimator_->status();
  const ViewInput input = scene_.describe(view);
  if (!first_view_) first_view_ = input;
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
  if (estimator_ && estimator_->status().ok()) return estimator_->estimate(seed_);
  unmeasured_.status = estimator_ ? estimator_->status() : Status(StatusCode::wrong_call);
  return unmeasured_;
}

}  // namespace traygauge
