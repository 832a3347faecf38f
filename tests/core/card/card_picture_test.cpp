// The card's grey values under a pose, on pictures that OpenCV rendered: how well they agree, in which tone,
// and where the pose has to move.
#include "core/card/card_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/card/card_refinement.hpp"
#include "tests/core/card/card_render.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

const CardModelSize kPicturedCard{};

struct PicturedCard {
  Pose truth = look_at_card(kPicturedCard, 400.0, 20.0, 40.0, 15.0, Vec2(760.0, 610.0));
  CardRender render = render_card(truth, kPicturedCard, random_print(5));
  test::Allocated<CardPattern> pattern{CardPatternParams{}};
  test::Allocated<CardPicture> picture{CardPictureParams{}};
  CardRefinementParams params;
  LensModel lens = render_lens();
  CardRefinement refinement{lens, *pattern, params, *picture};

  PicturedCard() {
    EXPECT_TRUE(prepare_card_pattern(test::view_of(random_print(5)), kPicturedCard, {}, *pattern).ok());
    load();
  }
  void load() {
    const LabelRegions regions = measure_regions(test::view_of(render.labels));
    EXPECT_TRUE(
        picture->load(test::view_of(render.gray), test::view_of(render.labels), regions.card, lens).ok());
  }
  const CardPatternLevel& level() const { return refinement.level_for(truth, 0.6); }
  CardCorrelation correlate(const Pose& pose) {
    refinement.select(pose, level());
    return picture->correlate(pose, kPicturedCard, level(), CardSampling::all, {});
  }
};

TEST(CardPicture, AgreesWithThePrintWhereItLies) {
  PicturedCard card;
  EXPECT_EQ(card.picture->labelled_pixels(), cv::countNonZero(card.render.labels == kCardLabel));
  const CardCorrelation here = card.correlate(card.truth);
  EXPECT_GT(here.correlation, 0.98);
  EXPECT_GT(here.samples, card.picture->labelled_pixels() * 0.7);
  EXPECT_EQ(here.samples, card.picture->used_pixels());
  double last = here.correlation;
  for (const double shift_mm : {0.3, 0.8, 2.0}) {
    const double there =
        card.correlate({card.truth.rotation, card.truth.translation + shift_mm * Vec3::UnitX()}).correlation;
    EXPECT_LT(there, last);
    last = there;
  }
  EXPECT_LT(last, 0.6);
}

// A picture with half the contrast, and lighter: OpenCV's arithmetic comes out as gain and offset.
TEST(CardPicture, KnowsItsTone) {
  PicturedCard card;
  const CardCorrelation before = card.correlate(card.truth);
  card.render.gray.convertTo(card.render.gray, CV_8U, 0.5, 70.0);
  card.load();
  const CardCorrelation after = card.correlate(card.truth);
  EXPECT_NEAR(after.tone[0], 0.5 * before.tone[0], 0.005);
  EXPECT_NEAR(after.tone[3], 0.5 * before.tone[3] + 70.0, 0.6);
  EXPECT_NEAR(after.correlation, before.correlation, 0.005);
  EXPECT_NEAR(after.rms_gray, 0.5 * before.rms_gray, 0.2);
}

TEST(CardPicture, SamplesThinOut) {
  PicturedCard card;
  card.correlate(card.truth);
  const auto samples = [&](CardSampling sampling) {
    return card.picture->correlate(card.truth, kPicturedCard, card.level(), sampling, {}).samples;
  };
  const double all = samples(CardSampling::all);
  EXPECT_NEAR(samples(CardSampling::half) / all, 0.5, 0.02);
  EXPECT_NEAR(samples(CardSampling::quarter) / all, 0.25, 0.02);
  EXPECT_NEAR(samples(CardSampling::sixteenth) / all, 1.0 / 16.0, 0.02);
}

// Without a cutoff that bites the sums are those of least squares: what the tone's step changes of the slope
// is the normal matrix times the step, exactly; the pose's, to a third, because Gauss and Newton leave out
// how the residuals bend.
TEST(CardPicture, SlopesChangeAsTheNormalMatrixSays) {
  PicturedCard card;
  const CardCorrelation start = card.correlate(card.truth);
  const auto linearise = [&](const Pose& pose, const CardTone& tone) {
    return card.picture->linearise(pose, kPicturedCard, card.level(), tone, 1e6, CardSampling::all);
  };
  const CardLinearisation here = linearise(card.truth, start.tone);
  const NormalEquations<12>::Matrix hessian = here.equations.hessian.selfadjointView<Eigen::Lower>();
  for (int i = 0; i < 12; ++i) {
    const double size = i < 3 ? 2e-5 : i < 6 ? 5e-3 : i < 9 ? 0.05 : 1.0;
    const NormalEquations<12>::Vector step = size * NormalEquations<12>::Vector::Unit(i);
    const CardLinearisation above = linearise(moved(card.truth, step.head<6>()), start.tone + step.tail<6>());
    const CardLinearisation below =
        linearise(moved(card.truth, -step.head<6>()), start.tone - step.tail<6>());
    const NormalEquations<12>::Vector change = 0.5 * (above.equations.gradient - below.equations.gradient);
    const NormalEquations<12>::Vector unit = hessian.diagonal().cwiseSqrt();
    const double of_own = hessian(i, i) * size / unit[i];
    for (int j = i < 6 ? 0 : 6; j < 12; ++j) {
      EXPECT_NEAR(change[j] / unit[j], hessian(j, i) * size / unit[j], (i < 6 ? 0.4 : 0.005) * of_own)
          << i << j;
    }
  }
}

// Where the pose costs least: the same for what tone and pose share.
TEST(CardPicture, ToneMovesThePoseAsTheNormalMatrixSays) {
  PicturedCard card;
  CardTone tone = card.correlate(card.truth).tone;
  Pose pose = card.truth;
  const auto linearise = [&](const CardTone& with) {
    return card.picture->linearise(pose, kPicturedCard, card.level(), with, 1e6, CardSampling::all);
  };
  for (int i = 0; i < 6; ++i) {
    NormalEquations<12>::Vector step;
    ASSERT_TRUE(linearise(tone).equations.solve(0.0, step));
    pose = moved(pose, step.head<6>());
    tone += step.tail<6>();
  }
  const CardLinearisation here = linearise(tone);
  for (const int i : {6, 9, 10, 11}) {
    const CardTone step = (i < 9 ? 0.05 : 1.0) * CardTone::Unit(i - 6);
    const NormalEquations<12>::Vector change =
        0.5 * (linearise(tone + step).equations.gradient - linearise(tone - step).equations.gradient);
    const Eigen::Matrix<double, 6, 1> expected =
        here.equations.hessian.row(i).head<6>().transpose() * step.norm();
    EXPECT_LT((change.head<6>() - expected).norm(), 0.05 * expected.norm()) << i;
  }
}

TEST(CardPicture, RefinesAPoseThatIsOffByPixels) {
  const std::uint32_t seed = test::random_seed();
  PicturedCard card;
  for (std::uint32_t round = 0; round < 10; ++round) {
    CardFitState state;
    state.camera_from_table = test::perturbed(card.truth, 0.1, 0.3, seed + round);
    const auto off_px = [&](const Pose& pose) {
      const Vec3 corner = print_point_mm({0.0, 0.0}, kPicturedCard.thickness_mm);
      return ((pose * corner).hnormalized() - (card.truth * corner).hnormalized()).norm() * 1390.0;
    };
    for (const double blur_px : {2.5, 1.2, 0.6}) {
      const CardPatternLevel& level = card.refinement.level_for(state.camera_from_table, blur_px);
      card.refinement.select(state.camera_from_table, level);
      ASSERT_TRUE(card.refinement.refine(level, CardSampling::all, 10, state));
    }
    EXPECT_LT(off_px(state.camera_from_table), 0.1);
    PoseInformation information;
    ASSERT_TRUE(card.refinement.inform(card.level(), CardSampling::all, state, information));
    EXPECT_GT(information.selfadjointView<Eigen::Lower>().toDenseMatrix().determinant(), 0.0);
  }
}

TEST(CardPicture, KnowsWhichPosesArePossibleAndHowLargeTheyLook) {
  PicturedCard card;
  EXPECT_TRUE(card.refinement.is_possible(card.truth));
  EXPECT_TRUE(
      card.refinement.is_possible(look_at_card(kPicturedCard, 400.0, 75.0, 0.0, 0.0, Vec2(803.0, 597.0))));
  EXPECT_FALSE(
      card.refinement.is_possible(look_at_card(kPicturedCard, 400.0, 84.0, 0.0, 0.0, Vec2(803.0, 597.0))));
  EXPECT_FALSE(
      card.refinement.is_possible(look_at_card(kPicturedCard, 400.0, 160.0, 0.0, 0.0, Vec2(803.0, 597.0))));
  EXPECT_FALSE(card.refinement.is_possible({card.truth.rotation, -card.truth.translation}));
  std::vector<cv::Point2f> seen;
  const cv::Mat1b print = random_print(5);
  const std::vector<cv::Point2f> corners = {
      {-0.5F, -0.5F}, {1711.5F, -0.5F}, {1711.5F, 1079.5F}, {-0.5F, 1079.5F}};
  cv::perspectiveTransform(corners, seen, picture_from_print(card.truth, kPicturedCard, print));
  EXPECT_NEAR(card.refinement.projected_px2(card.truth), cv::contourArea(seen),
              0.002 * cv::contourArea(seen));
}

TEST(CardPicture, FindsNoCardInAPictureWithoutItsLabel) {
  PicturedCard card;
  card.render.labels.setTo(0);
  EXPECT_EQ(
      card.picture->load(test::view_of(card.render.gray), test::view_of(card.render.labels), {}, card.lens)
          .code(),
      StatusCode::card_not_found);
}

}  // namespace
}  // namespace traygauge
