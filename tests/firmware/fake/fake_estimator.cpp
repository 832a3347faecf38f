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

namespace {

std::size_t fake_bytes(const FrameLimits& limits) {
  return kBytesPerPixel * static_cast<std::size_t>(limits.max_frame_width) *
         static_cast<std::size_t>(limits.max_frame_height);
}

Status construct(std::span<std::byte> block, const TraySetup& setup) {
  FakeEstimator& fake = fake_estimator();
  fake.lens = setup.lens;
  fake.card = setup.card;
  fake.dishes.assign(setup.dishes.begin(), setup.dishes.end());
  fake.limits = setup.limits;
  return block.size() < fake_bytes(setup.limits) ? Status(StatusCode::out_of_memory) : fake.construction;
}

Status take(const ViewInput& view) {
  fake_estimator().views.push_back(view);
  return fake_estimator().views.size() == 2 ? fake_estimator().second_view : Status();
}

const Measurement& answer(std::uint64_t seed) {
  fake_estimator().seed = seed;
  ++fake_estimator().estimates;
  return fake_estimator().measurement;
}

}  // namespace

TRAYGAUGE_FAKE std::size_t required_bytes(const Configuration& configuration) {
  return fake_bytes(configuration.limits);
}

TRAYGAUGE_FAKE std::array<MemoryRow, kMemoryRowCount> describe_memory(const Configuration& configuration) {
  return {{{"features", required_bytes(configuration) / 2, false},
           {"stereo", required_bytes(configuration) / 2, true}}};
}

TRAYGAUGE_FAKE Status validate(const TraySetup&) {
  return fake_estimator().construction;
}

TRAYGAUGE_FAKE TrayEstimator::TrayEstimator(std::span<std::byte> block, const Configuration& configuration)
    : status_(construct(block, configuration)) {}
TRAYGAUGE_FAKE Status TrayEstimator::expect(std::span<const DishModel> /*dishes*/, int /*items*/) {
  return {};
}
TRAYGAUGE_FAKE double TrayEstimator::setup_ms() const {
  return 3.5;
}
TRAYGAUGE_FAKE std::size_t TrayEstimator::reserved_bytes() const {
  return fake_bytes(fake_estimator().limits);
}
TRAYGAUGE_FAKE std::size_t TrayEstimator::used_bytes() const {
  return reserved_bytes() / 2;
}
TRAYGAUGE_FAKE Status TrayEstimator::add_view(const ViewInput& view) {
  return take(view);
}
TRAYGAUGE_FAKE const Measurement& TrayEstimator::estimate(std::uint64_t seed, StageObserver*) {
  return answer(seed);
}
TRAYGAUGE_FAKE const Segmentation* TrayEstimator::segmentation() const {
  static const Segmentation nothing;
  return &nothing;
}
TRAYGAUGE_FAKE ImageView<const std::uint8_t> TrayEstimator::labels(std::size_t) const {
  return {};
}
TRAYGAUGE_FAKE std::span<std::byte> TrayEstimator::scratch() const {
  return {};
}
TRAYGAUGE_FAKE void TrayEstimator::reset() {
  fake_estimator().views.clear();
}

namespace paper {

TRAYGAUGE_FAKE std::size_t required_bytes(const Configuration& configuration) {
  return fake_bytes(configuration.limits);
}
TRAYGAUGE_FAKE std::array<MemoryRow, kMemoryRowCount> describe_memory(const Configuration&) {
  return {};
}
TRAYGAUGE_FAKE Estimator::Estimator(std::span<std::byte> block, const Configuration& configuration)
    : status_(construct(block, configuration)) {}
TRAYGAUGE_FAKE double Estimator::setup_ms() const {
  return 3.5;
}
TRAYGAUGE_FAKE std::size_t Estimator::reserved_bytes() const {
  return fake_bytes(fake_estimator().limits);
}
TRAYGAUGE_FAKE std::size_t Estimator::used_bytes() const {
  return reserved_bytes() / 2;
}
TRAYGAUGE_FAKE Status Estimator::add_view(const ViewInput& view) {
  return take(view);
}
TRAYGAUGE_FAKE Status Estimator::add_view_without_features(const ViewInput& view) {
  return take(view);
}
TRAYGAUGE_FAKE Status Estimator::set_matches(std::span<const GivenMatch>, std::span<const GivenCardMatch>) {
  return StatusCode::ok;
}
TRAYGAUGE_FAKE Status Estimator::set_motion_search(paper::MotionSearch*) {
  return StatusCode::ok;
}
TRAYGAUGE_FAKE const Measurement& Estimator::estimate(std::uint64_t seed) {
  return answer(seed);
}
TRAYGAUGE_FAKE const WorkingPictures& Estimator::pictures() const {
  return fake_estimator().pictures;
}
TRAYGAUGE_FAKE void Estimator::reset() {
  fake_estimator().views.clear();
}

}  // namespace paper

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
