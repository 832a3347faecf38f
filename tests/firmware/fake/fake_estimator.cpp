#include "tests/firmware/fake/fake_estimator.hpp"

#include <array>

#include "core/enrolment/dish_survey.hpp"
#include "core/pipeline/memory_report.hpp"

// Weak: a test program may link core beside it, for what is not played here.
#define TRAYGAUGE_FAKE __attribute__((weak))

namespace traygauge {
namespace {

constexpr std::size_t kBytesPerPixel = 10;

}  // namespace

FakeEstimator& fake_estimator() {
  static FakeEstimator fake;
  return fake;
}

TRAYGAUGE_FAKE std::size_t required_bytes(const EstimatorLimits& limits, Profile /*profile*/) {
  return kBytesPerPixel * static_cast<std::size_t>(limits.max_frame_width) *
         static_cast<std::size_t>(limits.max_frame_height);
}

TRAYGAUGE_FAKE std::size_t required_bytes(const Configuration& configuration) {
  return required_bytes(configuration.limits, configuration.profile);
}

TRAYGAUGE_FAKE std::array<MemoryRow, kMemoryRowCount> describe_memory(const Configuration& configuration) {
  return {{{"features", required_bytes(configuration) / 2, false},
           {"stereo", required_bytes(configuration) / 2, true}}};
}

TRAYGAUGE_FAKE Status validate(const Configuration&) {
  return fake_estimator().construction;
}

TRAYGAUGE_FAKE Estimator::Estimator(std::span<std::byte> block, const Configuration& configuration)
    : status_(fake_estimator().construction) {
  FakeEstimator& fake = fake_estimator();
  fake.lens = configuration.lens;
  fake.card = configuration.card;
  fake.dishes.assign(configuration.dishes.begin(), configuration.dishes.end());
  fake.limits = configuration.limits;
  if (block.size() < required_bytes(configuration.limits, configuration.profile))
    status_ = StatusCode::out_of_memory;
}

TRAYGAUGE_FAKE double Estimator::setup_ms() const {
  return 3.5;
}

TRAYGAUGE_FAKE std::size_t Estimator::reserved_bytes() const {
  return required_bytes(fake_estimator().limits, Profile::best);
}

TRAYGAUGE_FAKE std::size_t Estimator::used_bytes() const {
  return reserved_bytes() / 2;
}

TRAYGAUGE_FAKE Status Estimator::add_view(const ViewInput& view) {
  fake_estimator().views.push_back(view);
  return fake_estimator().views.size() == 2 ? fake_estimator().second_view : Status();
}

TRAYGAUGE_FAKE Status Estimator::add_view_without_features(const ViewInput& view) {
  return add_view(view);
}

TRAYGAUGE_FAKE Status Estimator::set_matches(std::span<const GivenMatch>, std::span<const GivenCardMatch>) {
  return StatusCode::ok;
}

TRAYGAUGE_FAKE Status Estimator::set_motion_search(MotionSearch*) {
  return StatusCode::ok;
}

TRAYGAUGE_FAKE const Measurement& Estimator::estimate(std::uint64_t seed, StageTap*) {
  fake_estimator().seed = seed;
  ++fake_estimator().estimates;
  return fake_estimator().measurement;
}

TRAYGAUGE_FAKE ImageView<std::uint8_t> Estimator::gray_memory(std::size_t) const {
  return {};
}

TRAYGAUGE_FAKE std::span<std::byte> Estimator::idle_memory() const {
  return {};
}

TRAYGAUGE_FAKE const CardPattern* Estimator::card_pattern() const {
  return nullptr;
}

TRAYGAUGE_FAKE void Estimator::reset() {
  fake_estimator().views.clear();
}

// Enrolment is not played: its tests run the real one.
TRAYGAUGE_FAKE std::size_t survey_bytes(const Configuration&) {
  return 1;
}

TRAYGAUGE_FAKE DishSurveyor::DishSurveyor(std::span<std::byte>, const Configuration&, const DishSurveyParams&)
    : status_(StatusCode::invalid_configuration) {}

TRAYGAUGE_FAKE Status DishSurveyor::add_view(const ViewInput&) {
  return status_;
}

TRAYGAUGE_FAKE const DishSurvey& DishSurveyor::survey(std::uint64_t) {
  return survey_;
}

}  // namespace traygauge
