// The card in a picture without labels, on pictures that OpenCV rendered with a known pose.
#include "core/card/card_location.hpp"

#include <gtest/gtest.h>

#include "tests/core/card/card_render.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge {
namespace {

const CardModelSize kCardSize{85.60, 53.98, 0.8};

// Owns the memory of a search.
class CardLocatorUnderTest {
 public:
  CardLocatorUnderTest(const cv::Mat1b& print, const CardLocationParams& params)
      : params_(params), memory_(kRenderWidth, kRenderHeight, params) {
    EXPECT_TRUE(learn_card(test::view_of(print), kCardSize, params, *memory_).ok());
  }

  Result<CardAlignment> locate(const cv::Mat1b& gray) {
    cv::Mat1b labels(gray.size());
    return locate_card(test::view_of(gray), {labels.data, labels.cols, labels.rows}, render_lens(), params_,
                       *memory_);
  }

 private:
  CardLocationParams params_;
  test::Allocated<CardLocationWorkspace> memory_;
};

// Discs about the card, with corners as strong as the print's.
void scatter_discs(CardRender& render, std::uint64_t seed) {
  cv::RNG random(seed);
  for (int i = 0; i < 1500; ++i) {
    const cv::Point at(random.uniform(0, kRenderWidth), random.uniform(0, kRenderHeight));
    const cv::Rect about(at - cv::Point(20, 20), cv::Size(40, 40));
    if (cv::countNonZero(render.labels(about & cv::Rect({}, render.labels.size()))) > 0) continue;
    const cv::Size half(random.uniform(2, 16), random.uniform(2, 16));
    const int turn_deg = random.uniform(0, 180);
    cv::ellipse(render.gray, at, half, turn_deg, 0, 360, cv::Scalar(random.uniform(20, 240)), cv::FILLED,
                cv::LINE_AA);
  }
}

// Half the picture at most.
CardLocationParams half_size_params() {
  CardLocationParams params;
  params.search.search_px = {480'000, 480'000};
  return params;
}

// Half of the picture tells about where a small card lies, and no more; a finer picture of that place alone
// shows it.
TEST(CardLocation, CloserLookShowsASmallCard) {
  const cv::Mat1b print = random_print(7);
  CardLocationParams without = half_size_params();
  without.search.close_px_per_mm = 0.0;
  CardLocatorUnderTest closer(print, half_size_params());
  CardLocatorUnderTest coarse(print, without);
  constexpr int kRounds = 16;
  int found = 0;
  int found_without = 0;
  for (int i = 0; i < kRounds; ++i) {
    const int k = i % 8;
    const Pose pose = look_at_card(kCardSize, 900.0, 10.0 + 4.0 * k, 40.0 * k + 7.0 * (i / 8), 25.0 * k,
                                   {500.0 + 80.0 * k, 800.0 - 60.0 * k});
    CardRender render = render_card(pose, kCardSize, print, 0.8);
    add_noise(render.gray, 3.0, static_cast<std::uint64_t>(i));
    found_without += coarse.locate(render.gray).ok() ? 1 : 0;
    const Result<CardAlignment> alignment = closer.locate(render.gray);
    if (!alignment.ok()) continue;
    ++found;
    const CardPoseError error =
        compare_poses(*alignment, pose, kCardSize, render_lens().pinhole.mean_focal_px());
    EXPECT_LT(error.corner_rms_px, 0.3) << i;
  }
  std::printf("%d of %d found, %d without a closer look\n", found, kRounds, found_without);
  // Of 96 such pictures 72 % are found, 11 % without; the bound lies 2.5 standard deviations below, because
  // each machine rounds differently.
  EXPECT_GE(found, 7);
  EXPECT_GE(found, 2 * found_without);
}

// From above, an outline that is off by two pixels leads as well to the pose tilted the other way, whose
// print correlates by 0.9 and more: a second start finds the true one.
TEST(CardLocation, TiltIsRightSeenFromAbove) {
  const cv::Mat1b print = random_print(7);
  CardLocatorUnderTest locator(print, {});
  for (int i = 0; i < 3; ++i) {
    const Pose pose = look_at_card(kCardSize, 700.0, 10.0 + 4.0 * i, 40.0 * i, 25.0 * i,
                                   {500.0 + 60.0 * i, 800.0 - 45.0 * i});
    CardRender render = render_card(pose, kCardSize, print, 0.6);
    scatter_discs(render, static_cast<std::uint64_t>(100 + i));
    add_noise(render.gray, 3.0, static_cast<std::uint64_t>(i));
    const Result<CardAlignment> alignment = locator.locate(render.gray);
    ASSERT_TRUE(alignment.ok()) << i;
    const CardPoseError error =
        compare_poses(*alignment, pose, kCardSize, render_lens().pinhole.mean_focal_px());
    EXPECT_LT(error.corner_rms_px, 0.3) << i << ": " << alignment->correlation;
  }
}

}  // namespace
}  // namespace traygauge
