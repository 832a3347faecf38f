// The segmentation's memory: none allocated, nothing behind the block, within the budget; and what the
// estimator lends meanwhile.
#include "core/pipeline/segmenter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>

#include "core/pipeline/memory_report.hpp"
#include "simulator/capture/capture.hpp"
#include "tests/core/pipeline/allocation_trap.hpp"
#include "tests/core/pipeline/measuring_bench.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kBudgetBytes = std::size_t{6} << 20U;  // at 1600 × 1200, the default
constexpr std::byte kGuard{0x5C};

static_assert(segmenter_bytes({}) <= kBudgetBytes);

// A capture of the demo with all that a segmenter is given.
class Demo {
 public:
  Demo() : Demo(read_capture(TRAYGAUGE_SOURCE_DIR "/simulator/demo/mash_and_meatballs")) {}

  const Configuration& configuration() const { return configuration_; }
  const Estimator& estimator() const { return *estimator_; }
  // With given labels. `between` is called before each of the estimator's calls.
  template <class Between>
  std::vector<double> measure(const Between& between) {
    estimator_->reset();
    for (const LoadedView& view : views_) {
      between();
      static_cast<void>(estimator_->add_view({view.picture.frame(), view.labels.gray(), {}, {}}));
    }
    between();
    return numbers_of(estimator_->estimate(5));
  }
  SegmentedView view(std::size_t i) {
    const PictureSize size = views_[i].picture.size;
    SegmentedView view;
    view.frame = views_[i].picture.frame();
    view.labels = {labels_[i].pixels.data(), size.width, size.height};
    view.gray = {gray_[i].pixels.data(), size.width, size.height};
    return view;
  }
  const Picture& labels(std::size_t i) const { return labels_[i]; }

 private:
  explicit Demo(const Capture& capture) : pattern_(load_pattern(capture.card)) {
    for (std::size_t i = 0; i < 2; ++i) {
      views_[i] = load_view(capture.views[i]);
      labels_[i] = gray_[i] = Picture(views_[i].picture.size, PixelFormat::gray8);
    }
    const CameraDescription& camera = capture.views[0].camera;
    const auto& [k1, k2, p1, p2, k3] = camera.distortion;
    configuration_.lens = {camera.size.width, camera.size.height, {}, k1, k2, p1, p2, k3};
    configuration_.lens.pinhole = {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px};
    configuration_.card = {capture.card.width_mm, capture.card.height_mm, capture.card.thickness_mm,
                           pattern_.gray()};
    const DishDescription& dish = capture.dishes.front();
    dishes_[0] = {dish.outer_size_mm, dish.rim_height_mm, dish.bottom_height_mm};
    configuration_.dishes = dishes_;
    configuration_.limits.max_frame_width = camera.size.width;
    configuration_.limits.max_frame_height = camera.size.height;
    block_ = std::make_unique<TestBlock>(required_bytes(configuration_));
    estimator_ = std::make_unique<Estimator>(block_->bytes(), configuration_);
  }

  Picture pattern_;
  std::array<LoadedView, 2> views_;
  std::array<Picture, 2> labels_;
  std::array<Picture, 2> gray_;
  std::array<DishModel, 1> dishes_;
  Configuration configuration_;
  std::unique_ptr<TestBlock> block_;
  std::unique_ptr<Estimator> estimator_;
};

TEST(EstimatorIdleMemory, MayBeOverwrittenBetweenCalls) {
  Demo demo;
  const std::span<std::byte> idle = demo.estimator().idle_memory();
  EXPECT_GT(idle.size(), std::size_t{8} << 20U);
  const auto untouched = demo.measure([] {});
  ASSERT_EQ(untouched.front(), static_cast<double>(StatusCode::ok));
  for (const int filling : {0x00, 0x5C, 0xFF})
    EXPECT_TRUE(have_equal_bits(untouched, demo.measure([&] {
      std::memset(idle.data(), filling, idle.size());
    }))) << filling;
}

TEST(SegmenterMemory, NothingIsAllocated) {
  Demo demo;
  const TestBlock block(segmenter_bytes(demo.configuration()));
  const std::array<SegmentedView, 2> views = {demo.view(0), demo.view(1)};
  std::array<Status, 2> results;
  int items = 0;
  arm_allocation_trap();
  Segmenter segmenter(block.bytes(), demo.configuration(), *demo.estimator().card_pattern());
  for (Status& result : results) {
    segmenter.reset();
    for (const SegmentedView& view : views) static_cast<void>(segmenter.add_view(view));
    result = segmenter.segment().status;
    items = segmenter.segment().items;
  }
  const int allocations = disarm_allocation_trap();
  for (const Status result : results) EXPECT_TRUE(result.ok()) << name(result.code());
  EXPECT_GT(items, 0);
  EXPECT_EQ(allocations, 0);
}

TEST(SegmenterMemory, NothingIsWrittenBehindTheBlockAndNothingReadThatWasThere) {
  constexpr std::size_t kGuardBytes = std::size_t{1} << 20U;
  Demo demo;
  const std::size_t size = segmenter_bytes(demo.configuration());
  const TestBlock block(size + kGuardBytes);
  std::array<std::vector<std::uint8_t>, 2> first_labels;
  for (const int filling : {0xA5, 0x00}) {
    std::memset(block.bytes().data(), filling, size);
    std::fill(block.bytes().begin() + static_cast<std::ptrdiff_t>(size), block.bytes().end(), kGuard);
    Segmenter segmenter(block.bytes().first(size), demo.configuration(), *demo.estimator().card_pattern());
    for (const std::size_t i : {0U, 1U}) ASSERT_TRUE(segmenter.add_view(demo.view(i)).ok());
    ASSERT_TRUE(segmenter.segment().status.ok());
    const auto guard = block.bytes().subspan(size);
    EXPECT_TRUE(std::all_of(guard.begin(), guard.end(), [](std::byte byte) { return byte == kGuard; }));
    for (const std::size_t i : {0U, 1U}) {
      if (filling != 0) first_labels[i] = demo.labels(i).pixels;
      EXPECT_EQ(demo.labels(i).pixels, first_labels[i]);
    }
  }
}

TEST(SegmenterMemory, ABlockThatIsTooSmallIsOutOfMemory) {
  Demo demo;
  const std::size_t enough = segmenter_bytes(demo.configuration());
  const TestBlock block(enough);
  for (const std::size_t size : {enough - 1, enough / 2, std::size_t{64}, std::size_t{0}}) {
    Segmenter segmenter(block.bytes().first(size), demo.configuration(), *demo.estimator().card_pattern());
    EXPECT_EQ(segmenter.status().code(), StatusCode::out_of_memory) << size;
    EXPECT_EQ(segmenter.add_view(demo.view(0)).code(), StatusCode::out_of_memory);
    EXPECT_EQ(segmenter.segment().status.code(), StatusCode::out_of_memory);
  }
}

TEST(SegmenterMemory, RowsAddUp) {
  for (const int width : {1600, 640}) {
    Configuration configuration;
    configuration.limits.max_frame_width = width;
    std::size_t kept = 0;
    std::size_t largest_shared = 0;
    for (const MemoryRow& row : describe_segmenter(configuration)) {
      EXPECT_GT(row.bytes, 0U) << row.name;
      kept += row.shared ? 0 : row.bytes;
      if (row.shared) largest_shared = std::max(largest_shared, row.bytes);
    }
    EXPECT_EQ(kept + largest_shared, segmenter_bytes(configuration));
  }
}

TEST(SegmenterViews, OneOrThreeAreRefused) {
  Demo demo;
  const TestBlock block(segmenter_bytes(demo.configuration()));
  Segmenter segmenter(block.bytes(), demo.configuration(), *demo.estimator().card_pattern());
  EXPECT_EQ(segmenter.segment().status.code(), StatusCode::frame_missing);
  segmenter.reset();
  ASSERT_TRUE(segmenter.add_view(demo.view(0)).ok());
  ASSERT_TRUE(segmenter.add_view(demo.view(1)).ok());
  EXPECT_EQ(segmenter.add_view(demo.view(0)).code(), StatusCode::wrong_call);
  EXPECT_TRUE(segmenter.segment().status.ok());
  segmenter.reset();
  SegmentedView narrow = demo.view(0);
  --narrow.labels.width;
  EXPECT_EQ(segmenter.add_view(narrow).code(), StatusCode::labels_size_mismatch);
  EXPECT_EQ(segmenter.segment().status.code(), StatusCode::labels_size_mismatch);
}

// What the estimator is told about gray values and card is what it would find: with the labels that were
// drawn it measures the same, to what the card's second alignment moves.
TEST(SegmentedViews, AreMeasuredWithoutAligningTheCardAgain) {
  Demo demo;
  const TestBlock block(segmenter_bytes(demo.configuration()));
  Segmenter segmenter(block.bytes(), demo.configuration(), *demo.estimator().card_pattern());
  for (const std::size_t i : {0U, 1U}) ASSERT_TRUE(segmenter.add_view(demo.view(i)).ok());
  const Segmentation& segmentation = segmenter.segment();
  ASSERT_TRUE(segmentation.status.ok());
  const auto count = static_cast<std::size_t>(segmentation.items);
  std::array<std::array<double, kMaxItems>, 2> volumes_ml{};
  for (const bool is_shared : {false, true}) {
    MeasuringBench bench(demo.configuration());
    std::array<ViewInput, 2> inputs;
    for (std::size_t i = 0; i < 2; ++i) {
      inputs[i].frame = demo.view(i).frame;
      inputs[i].labels = demo.view(i).labels;
      if (!is_shared) continue;
      inputs[i].gray = demo.view(i).gray;
      inputs[i].card = &segmenter.card(i);
    }
    const Measurement& measurement = bench.measure(inputs[0], inputs[1]);
    ASSERT_TRUE(measurement.status.ok()) << name(measurement.status.code());
    ASSERT_EQ(measurement.items.size(), count);
    for (std::size_t k = 0; k < count; ++k) volumes_ml[is_shared ? 1 : 0][k] = measurement.items[k].volume_ml;
  }
  const auto sum_ml = [](const auto& items) { return std::accumulate(items.begin(), items.end(), 0.0); };
  const double all_ml = sum_ml(volumes_ml[0]);
  EXPECT_NEAR(sum_ml(volumes_ml[1]), all_ml, 0.005 * all_ml);
  for (std::size_t k = 0; k < count; ++k)
    EXPECT_NEAR(volumes_ml[1][k], volumes_ml[0][k], 0.005 * all_ml) << k;
}

}  // namespace
}  // namespace traygauge
