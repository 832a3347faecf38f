#include "firmware/station/estimator_measurer.hpp"

#include <algorithm>

namespace traygauge {

EstimatorMeasurer::EstimatorMeasurer(Scene& scene, const EstimatorLimits& limits, Profile profile,
                                     std::uint64_t seed)
    : scene_(scene),
      limits_(limits),
      profile_(profile),
      seed_(seed),
      block_(required_bytes(limits, profile)) {
  if (!scene.needs_labels()) return;
  Configuration configuration;
  configuration.limits = limits;
  configuration.profile = profile;
  drawer_.emplace(configuration);
}

// The card's pattern is learned again only when the configuration is another one.
void EstimatorMeasurer::begin_scan() {
  is_drawing_ = false;
  const Configuration* configuration = scene_.configuration();
  if (configuration == nullptr) {
    estimator_.reset();
  } else if (configuration != configured_with_ || !estimator_) {
    configure(*configuration);
  } else {
    estimator_->reset();
    if (drawer_) drawer_->reset();
  }
  configured_with_ = configuration;
  first_view_.reset();
}

void EstimatorMeasurer::configure(const Configuration& configuration) {
  Configuration own = configuration;
  own.limits = limits_;
  own.profile = profile_;
  estimator_.emplace(block_.bytes(), own);
  if (drawer_) drawer_->configure(own, *estimator_);
}

Status EstimatorMeasurer::add_view(const StationView& view) {
  if (!estimator_) return StatusCode::invalid_configuration;
  if (!estimator_->status().ok()) return estimator_->status();
  const ViewInput input = scene_.describe(view);
  if (!first_view_) {
    first_view_ = input;
    is_drawing_ = drawer_ && input.labels.empty();
  }
  return is_drawing_ ? drawer_->add_view(input, *estimator_) : estimator_->add_view(input);
}

// Where nothing lies between the two views.
std::span<std::byte> EstimatorMeasurer::idle_memory() const {
  if (!estimator_) return {};
  const std::span<std::byte> idle = estimator_->idle_memory();
  const std::size_t borrowed = drawer_ ? drawer_->borrowed_bytes() : 0;
  return idle.subspan(std::min(borrowed, idle.size()));
}

// Looks for the card of the first view only here: who has an arm does not need it.
std::optional<double> EstimatorMeasurer::turned_deg(const FrameView& live) {
  if (configured_with_ == nullptr || !first_view_) return std::nullopt;
  if (!first_view_->frame.empty()) {
    guide_.begin(configured_with_->card, first_view_->lens.value_or(configured_with_->lens),
                 first_view_->frame, idle_memory());
    first_view_->frame = {};
  }
  return guide_.turned_deg(live);
}

const Measurement& EstimatorMeasurer::measure() {
  if (estimator_ && estimator_->status().ok())
    return is_drawing_ ? drawer_->measure(*estimator_, seed_) : estimator_->estimate(seed_);
  unmeasured_.status = estimator_ ? estimator_->status() : Status(StatusCode::invalid_configuration);
  return unmeasured_;
}

}  // namespace traygauge
