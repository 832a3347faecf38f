// The estimator of the product on a capture of the demo: order of calls, memory, same bits.
#include "core/pipeline/tray_estimator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/pipeline/memory_report.hpp"
#include "tests/core/pipeline/demo_tray.hpp"
#include "tests/core/pipeline/measuring_bench.hpp"
#include "tests/simulator/capture/small_demo.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kBudgetBytes = std::size_t{28} << 20U;  // at 1600 × 1200, the default
constexpr std::byte kGuard{0x5C};
constexpr double kDoubtedScale = 1.02;  // between what is warned of and what is refused

const DemoTray& demo() {
  static const DemoTray tray(SmallDemo().folder());
  return tray;
}
const DemoTray& whole_demo() {
  static const DemoTray tray;
  return tray;
}

std::array<ViewInput, 2> views_of(const DemoTray& tray, bool is_outlined) {
  return {is_outlined ? tray.view(0) : tray.bare_view(0), is_outlined ? tray.view(1) : tray.bare_view(1)};
}

class TrayEstimatorTest : public testing::TestWithParam<bool> {
 protected:
  const std::array<ViewInput, 2> views_ = views_of(demo(), GetParam());
};
INSTANTIATE_TEST_SUITE_P(Labels, TrayEstimatorTest, testing::Values(true, false),
                         [](const auto& labels) { return labels.param ? "Given" : "Found"; });

TEST_P(TrayEstimatorTest, MeasuresAgainAndAgainTheSameBits) {
  MeasuringBench bench(demo().configuration());
  const auto first = numbers_of(bench.measure(views_[0], views_[1], 5));
  ASSERT_EQ(first.front(), static_cast<double>(StatusCode::ok));
  EXPECT_TRUE(have_equal_bits(first, numbers_of(bench.estimator.estimate(5)))) << "without new views";
  EXPECT_TRUE(have_equal_bits(first, numbers_of(bench.measure(views_[0], views_[1], 5))));
  MeasuringBench other(demo().configuration());
  EXPECT_TRUE(have_equal_bits(first, numbers_of(other.measure(views_[0], views_[1], 5))));
}

TEST_P(TrayEstimatorTest, NothingLeaksFromGivenLabelsIntoFoundOnesOrBack) {
  MeasuringBench bench(demo().configuration());
  const auto before = numbers_of(bench.measure(views_[0], views_[1], 5));
  const auto others = views_of(demo(), !GetParam());
  EXPECT_FALSE(have_equal_bits(before, numbers_of(bench.measure(others[0], others[1], 5))));
  EXPECT_TRUE(have_equal_bits(before, numbers_of(bench.measure(views_[0], views_[1], 5))));
}

// Other lenses are tried in the memory of the measurement, and nothing of them stays.
TEST_P(TrayEstimatorTest, ALensThatDoesNotFitLeavesNothingBehind) {
  Configuration configuration = whole_demo().configuration();
  const LensModel lens = configuration.lens;
  const std::array<ViewInput, 2> views = views_of(whole_demo(), GetParam());
  configuration.lens = LensChange{0.9}.of(lens);
  MeasuringBench bench(configuration);
  const auto first = numbers_of(bench.measure(views[0], views[1], 5));
  EXPECT_NE(first.front(), static_cast<double>(StatusCode::ok));
  if (GetParam()) {
    EXPECT_EQ(first.front(), static_cast<double>(StatusCode::lens_does_not_fit));
  }
  EXPECT_TRUE(have_equal_bits(first, numbers_of(bench.estimator.estimate(5))));
  std::array<ViewInput, 2> right = views;
  for (ViewInput& view : right) view.lens = lens;
  const auto measured = numbers_of(bench.measure(right[0], right[1], 5));
  MeasuringBench other(whole_demo().configuration());
  EXPECT_TRUE(have_equal_bits(measured, numbers_of(other.measure(views[0], views[1], 5))));
  EXPECT_TRUE(have_equal_bits(first, numbers_of(bench.measure(views[0], views[1], 5))));
}

// A pair that is doubted and measured keeps its volumes and heights while others are tried.
TEST_P(TrayEstimatorTest, LensesThatExplainNothingLeaveTheVolumesAlone) {
  Configuration configuration = demo().configuration();
  configuration.card.width_mm *= kDoubtedScale;
  configuration.card.height_mm *= kDoubtedScale;
  const auto measured_through = [&](const LensChange& change) {
    configuration.lens_doubt.tried.fill(change);
    MeasuringBench bench(configuration);
    const Measurement& measurement = bench.measure(views_[0], views_[1], 5);
    EXPECT_TRUE(is_measured(measurement) && may_be_the_lens(measurement));
    std::vector<double> numbers = numbers_of(measurement);
    for (const MeasuredSurface& surface : measurement.views.surfaces) {
      const ImageView<HeightCell>& cells = surface.heights.cells;
      for (int i = 0; i < cells.width * cells.height; ++i) numbers.push_back(cells.data[i].z_mm);
    }
    for (std::size_t view = 0; view < 2; ++view) {
      const ImageView<const std::uint8_t> labels = bench.estimator.labels(view);
      numbers.insert(numbers.end(), labels.data, labels.data + labels.width * labels.height);
    }
    return numbers;
  };
  const LensChange the_same{};
  const LensChange far_off{0.8, 0.0};
  EXPECT_TRUE(have_equal_bits(measured_through(the_same), measured_through(far_off)));
}

TEST_P(TrayEstimatorTest, ScratchMayBeOverwrittenBetweenCalls) {
  MeasuringBench bench(demo().configuration());
  const std::span<std::byte> scratch = bench.estimator.scratch();
  EXPECT_GT(scratch.size(), std::size_t{4} << 20U);
  const auto untouched = numbers_of(bench.measure(views_[0], views_[1], 5));
  for (const int filling : {0x00, 0x5C, 0xFF}) {
    const auto overwrite = [&] { std::memset(scratch.data(), filling, scratch.size()); };
    bench.estimator.reset();
    overwrite();
    for (const ViewInput& view : views_) {
      static_cast<void>(bench.estimator.add_view(view));
      overwrite();
    }
    EXPECT_TRUE(have_equal_bits(untouched, numbers_of(bench.estimator.estimate(5)))) << filling;
  }
}

TEST_P(TrayEstimatorTest, NothingIsWrittenBehindTheBlockAndNothingReadThatWasThere) {
  constexpr std::size_t kGuardBytes = std::size_t{1} << 20U;
  const Configuration configuration = demo().configuration();
  const std::size_t size = required_bytes(configuration);
  const TestBlock block(size + kGuardBytes);
  std::vector<double> numbers;
  for (const int filling : {0xA5, 0x00}) {
    std::memset(block.bytes().data(), filling, size);
    std::fill(block.bytes().begin() + static_cast<std::ptrdiff_t>(size), block.bytes().end(), kGuard);
    TrayEstimator estimator(block.bytes().first(size), configuration);
    for (const ViewInput& view : views_) ASSERT_TRUE(estimator.add_view(view).ok());
    const auto found = numbers_of(estimator.estimate(5));
    EXPECT_EQ(found.front(), static_cast<double>(StatusCode::ok));
    EXPECT_EQ(estimator.used_bytes(), size);
    const auto guard = block.bytes().subspan(size);
    EXPECT_TRUE(std::all_of(guard.begin(), guard.end(), [](std::byte byte) { return byte == kGuard; }));
    if (filling != 0) numbers = found;
    EXPECT_TRUE(have_equal_bits(numbers, found));
  }
}

TEST_P(TrayEstimatorTest, ViewsThatLackOrAreTooMany) {
  MeasuringBench bench(demo().configuration());
  EXPECT_EQ(bench.estimator.estimate(1).status.code(), StatusCode::frame_missing);
  ASSERT_TRUE(bench.estimator.add_view(views_[0]).ok());
  EXPECT_EQ(bench.estimator.estimate(1).status.code(), StatusCode::frame_missing);
  ASSERT_TRUE(bench.estimator.add_view(views_[1]).ok());
  const auto expected = numbers_of(bench.estimator.estimate(1));
  EXPECT_EQ(bench.estimator.add_view(views_[0]).code(), StatusCode::wrong_call);
  EXPECT_TRUE(have_equal_bits(expected, numbers_of(bench.estimator.estimate(1))))
      << "a third changes nothing";
}

// As a station meets them: the first thing that went wrong is what the measurement says.
TEST_P(TrayEstimatorTest, FramesThatCannotBeUsed) {
  MeasuringBench bench(demo().configuration());
  for (const int at : {0, 1}) {
    const auto status_with = [&](const FrameView& frame) {
      std::array<ViewInput, 2> views = views_;
      views[static_cast<std::size_t>(at)].frame = frame;
      return bench.measure(views[0], views[1]).status.code();
    };
    const FrameView good = views_[static_cast<std::size_t>(at)].frame;
    EXPECT_EQ(status_with({}), StatusCode::frame_missing) << at;
    FrameView narrow = good;
    --narrow.width;
    EXPECT_EQ(status_with(narrow), StatusCode::frame_size_mismatch) << at;
    const std::vector<std::uint8_t> black(
        static_cast<std::size_t>(good.stride_bytes) * static_cast<std::size_t>(good.height), 1);
    FrameView dark = good;
    dark.data = black.data();
    EXPECT_EQ(status_with(dark), StatusCode::frame_too_dark) << at;
  }
  EXPECT_TRUE(bench.measure(views_[0], views_[1]).status.ok()) << "and the next measurement is right";
}

TEST(TrayEstimatorExpectation, HoldsForTheTraysThatFollow) {
  const Configuration configuration = demo().configuration();
  MeasuringBench bench(configuration);
  const auto items = [&bench] {
    return bench.measure(demo().bare_view(0), demo().bare_view(1)).items.size();
  };
  const std::size_t found = items();
  ASSERT_GT(found, 1U);
  ASSERT_TRUE(bench.estimator.expect(configuration.dishes, 1).ok());
  EXPECT_EQ(items(), 1U);
  EXPECT_EQ(items(), 1U);
  ASSERT_TRUE(bench.estimator.expect(configuration.dishes, 0).ok());
  EXPECT_EQ(items(), found);
  DishModel other = configuration.dishes.front();
  for (double& size_mm : other.outer_size_mm) size_mm *= 0.5;
  ASSERT_TRUE(bench.estimator.expect({&other, 1}, 0).ok());
  EXPECT_FALSE(bench.measure(demo().view(0), demo().view(1)).status.ok())
      << "a dish that does not stand there";
}

TEST(TrayEstimatorExpectation, OfNoUseChangesNothing) {
  const Configuration configuration = demo().configuration();
  MeasuringBench bench(configuration);
  const auto expected = numbers_of(bench.measure(demo().view(0), demo().view(1)));
  EXPECT_EQ(bench.estimator.expect({}, 0).code(), StatusCode::invalid_configuration);
  EXPECT_EQ(bench.estimator.expect(configuration.dishes, -1).code(), StatusCode::invalid_configuration);
  EXPECT_EQ(bench.estimator.expect(configuration.dishes, 199).code(), StatusCode::invalid_configuration);
  bench.estimator.reset();
  ASSERT_TRUE(bench.estimator.add_view(demo().view(0)).ok());
  EXPECT_EQ(bench.estimator.expect(configuration.dishes, 1).code(), StatusCode::wrong_call);
  ASSERT_TRUE(bench.estimator.add_view(demo().view(1)).ok());
  EXPECT_TRUE(have_equal_bits(expected, numbers_of(bench.estimator.estimate(1))));
}

TEST(TrayEstimatorLabels, AreThoseThatWereMeasured) {
  MeasuringBench bench(demo().configuration());
  EXPECT_TRUE(bench.estimator.labels(0).empty());
  static_cast<void>(bench.measure(demo().view(0), demo().view(1)));
  EXPECT_EQ(bench.estimator.segmentation(), nullptr);
  EXPECT_EQ(bench.estimator.labels(1).data, demo().view(1).labels.data);
  const Measurement& found = bench.measure(demo().bare_view(0), demo().bare_view(1));
  ASSERT_NE(bench.estimator.segmentation(), nullptr);
  EXPECT_EQ(found.segmentation_ms, bench.estimator.segmentation()->total_ms());
  const ImageView<const std::uint8_t> labels = bench.estimator.labels(0);
  std::vector<bool> is_drawn(256);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) is_drawn[labels.at(x, y)] = true;
  }
  EXPECT_TRUE(is_drawn[kCardLabel] && is_drawn[kDishLabel]);
  for (const ItemResult& item : found.items) EXPECT_TRUE(is_drawn[item.label]) << int{item.label};
}

// A configuration that takes no memory for finding labels says what it lacks.
TEST(TrayEstimatorLabels, AreMissedWhereNoneCanBeFound) {
  Configuration configuration = demo().configuration();
  configuration.network = nullptr;
  EXPECT_LT(required_bytes(configuration), required_bytes(demo().configuration()));
  MeasuringBench bench(configuration);
  EXPECT_EQ(bench.measure(demo().bare_view(0), demo().bare_view(1)).status.code(),
            StatusCode::labels_size_mismatch);
  EXPECT_TRUE(bench.measure(demo().view(0), demo().view(1)).status.ok());
}

TEST(TrayEstimatorMemory, DefaultStaysWithinTheBudget) {
  Configuration configuration;
  configuration.network = demo().configuration().network;
  EXPECT_LE(required_bytes(configuration), kBudgetBytes);
}

TEST(TrayEstimatorMemory, RowsAddUp) {
  for (const int width : {1600, 640}) {
    for (const bool finds_labels : {true, false}) {
      Configuration configuration;
      configuration.limits.max_frame_width = width;
      if (finds_labels) configuration.network = demo().configuration().network;
      std::size_t kept = 0;
      std::size_t largest_shared = 0;
      for (const MemoryRow& row : describe_memory(configuration)) {
        if (finds_labels) {
          EXPECT_GT(row.bytes, 0U) << row.name;
        }
        kept += row.shared ? 0 : row.bytes;
        if (row.shared) largest_shared = std::max(largest_shared, row.bytes);
      }
      EXPECT_EQ(kept + largest_shared, required_bytes(configuration)) << width;
    }
  }
}

TEST(TrayEstimatorMemory, ABlockThatIsTooSmallIsOutOfMemory) {
  const Configuration configuration = demo().configuration();
  const std::size_t enough = required_bytes(configuration);
  const TestBlock block(enough);
  for (const std::size_t size : {enough - 1, enough / 2, std::size_t{64}, std::size_t{0}}) {
    TrayEstimator estimator(block.bytes().first(size), configuration);
    EXPECT_EQ(estimator.status().code(), StatusCode::out_of_memory) << size;
    EXPECT_EQ(estimator.add_view(demo().view(0)).code(), StatusCode::out_of_memory);
    EXPECT_EQ(estimator.estimate(1).status.code(), StatusCode::out_of_memory);
    estimator.reset();
    EXPECT_EQ(estimator.used_bytes(), 0U);
  }
}

TEST(TrayEstimatorMemory, HoldsTheHeightMapsOfAFullTray) {
  const Configuration configuration;
  const auto cells_of = [&](double side_mm) {
    const auto side = static_cast<std::size_t>(std::ceil(side_mm / configuration.height_map.cell_mm));
    return side * side;
  };
  EXPECT_LE(cells_of(260.0) + 3 * cells_of(160.0) + kMaxTrayPlaces * cells_of(150.0),
            configuration.pipeline.max_tray_cells);
}

// Wrong numbers that a person gives.
TEST(TrayEstimatorConfiguration, IsChecked) {
  const auto status_of = [](auto spoil) {
    Configuration configuration = demo().configuration();
    spoil(configuration);
    const TestBlock block(std::size_t{1} << 16U);  // refused before memory is looked at
    return TrayEstimator(block.bytes(), configuration).status().code();
  };
  constexpr StatusCode kInvalid = StatusCode::invalid_configuration;
  EXPECT_EQ(status_of([](Configuration& c) { c.lens.pinhole.fx_px = 0.0; }), kInvalid);
  EXPECT_EQ(status_of([](Configuration& c) { c.card.width_mm = -1.0; }), kInvalid);
  EXPECT_EQ(status_of([](Configuration& c) { c.card.pattern = {}; }), kInvalid);
  EXPECT_EQ(status_of([](Configuration& c) { c.limits.max_frame_width = 15; }), kInvalid);
  EXPECT_EQ(status_of([](Configuration& c) { c.dishes = {}; }), kInvalid);
}

}  // namespace
}  // namespace traygauge
