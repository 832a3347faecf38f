// The camera's pose by the card's print, on pictures that OpenCV rendered with a known pose.
#include <gtest/gtest.h>

#include <functional>
#include <iostream>

#include "tests/core/card/card_render.hpp"

namespace traygauge {
namespace {

constexpr double kNoise = 3.0;  // grey values
constexpr double kFaintContrast = 0.1;
const CardModelSize kCard{85.60, 53.98, 0.8};
const double kFocalPx = render_lens().pinhole.mean_focal_px();

const cv::Mat1b& print() {
  static const cv::Mat1b picture = random_print(7);
  return picture;
}

Pose usual_pose() {
  return look_at_card(kCard, 480.0, 17.0, 35.0, 80.0, {1130.0, 420.0});
}

CardRender noisy(const Pose& pose, std::uint64_t seed, double blur_px = 0.3) {
  CardRender render = render_card(pose, kCard, print(), blur_px);
  add_noise(render.gray, kNoise, seed);
  return render;
}

// Paints label and grey value along the print, in mm.
void cover(CardRender& render, const Pose& pose, const std::vector<Vec2>& print_mm, std::uint8_t label,
           std::uint8_t gray) {
  std::vector<cv::Point> polygon;
  for (const Vec2& at : print_mm) {
    const Vec3 point = pose * print_point_mm(at, kCard.thickness_mm);
    const Vec2 pixel = render_lens().pinhole.pixel(point.hnormalized());
    polygon.emplace_back(cvRound(pixel.x()), cvRound(pixel.y()));
  }
  cv::fillPoly(render.labels, std::vector<std::vector<cv::Point>>{polygon}, label);
  cv::fillPoly(render.gray, std::vector<std::vector<cv::Point>>{polygon}, gray);
}

std::vector<Vec2> disc(const Vec2& centre, double radius) {
  std::vector<Vec2> points;
  for (int i = 0; i < 90; ++i) {
    const double angle = 2.0 * std::acos(-1.0) * i / 90.0;
    points.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

class CardAlignmentTest : public ::testing::Test {
 protected:
  CardAlignmentTest() { EXPECT_TRUE(aligner_.set_pattern(print(), kCard).ok()); }

  void expect_close(const CardRender& render, const Pose& pose, double max_px, double max_deg,
                    const std::string& what = "") {
    const Result<CardAlignment> alignment = aligner_.align(render);
    ASSERT_TRUE(alignment.ok()) << what << " " << name(alignment.code());
    const CardPoseError error = compare_poses(*alignment, pose, kCard, kFocalPx);
    EXPECT_LT(error.corner_rms_px, max_px) << what;
    EXPECT_LT(error.normal_deg, max_deg) << what;
    EXPECT_LT(error.normalised_square, 40.0) << what;  // one in two million by noise
  }

  CardAligner aligner_;
};

TEST_F(CardAlignmentTest, AnyPoseIsFound) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    cv::RNG random(seed);
    const double distance_mm = random.uniform(350.0, 700.0);
    const double tilt_deg = random.uniform(0.0, 50.0);
    const double azimuth_deg = random.uniform(0.0, 360.0);
    const double roll_deg = random.uniform(0.0, 360.0);
    const Vec2 pixel(random.uniform(400.0, 1200.0), random.uniform(350.0, 850.0));
    const Pose pose = look_at_card(kCard, distance_mm, tilt_deg, azimuth_deg, roll_deg, pixel);
    expect_close(noisy(pose, seed), pose, 0.05, 0.1, "seed " + std::to_string(seed));
  }
}

// From afar and nearly from above, upright in the picture.
Pose far_pose(std::uint64_t seed) {
  cv::RNG random(seed);
  const double distance_mm = random.uniform(600.0, 800.0);
  const double tilt_deg = random.uniform(8.0, 25.0);
  return look_at_card(kCard, distance_mm, tilt_deg, random.uniform(0.0, 360.0), 0.0, {800.0, 600.0});
}

// From there a card looks much the same from the other side of its normal.
TEST_F(CardAlignmentTest, TheMirrorPoseIsNotTakenForTheCards) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Pose pose = far_pose(seed);
    expect_close(noisy(pose, seed, 0.6), pose, 0.1, 0.5, "seed " + std::to_string(seed));
  }
}

// There the right pose is behind at some blurs and over some of the pixels.
TEST_F(CardAlignmentTest, TheMirrorPoseIsNotTakenForTheCardsWhereItIsAheadForAWhile) {
  for (const std::uint64_t seed : {1057U, 1191U, 2279U}) {
    cv::RNG random(seed);
    const double distance_mm = random.uniform(500.0, 800.0);
    const double tilt_deg = random.uniform(2.0, 25.0);
    const double azimuth_deg = random.uniform(0.0, 360.0);
    const double roll_deg = random.uniform(0.0, 360.0);
    const Vec2 pixel(random.uniform(200.0, 1400.0), random.uniform(150.0, 1050.0));
    const Pose pose = look_at_card(kCard, distance_mm, tilt_deg, azimuth_deg, roll_deg, pixel);
    expect_close(noisy(pose, seed, 0.6), pose, 0.1, 0.5, "seed " + std::to_string(seed));
  }
}

// A print of little contrast to the grey of its ground, in noise of twice that.
TEST_F(CardAlignmentTest, AFaintPrintIsFound) {
  const Pose pose = usual_pose();
  CardRender render = render_card(pose, kCard, print(), 0.5);
  cv::Mat1b faint;
  render.gray.convertTo(faint, CV_8U, kFaintContrast, 128.0 * (1.0 - kFaintContrast));
  faint.copyTo(render.gray, render.labels == kCardLabel);
  add_noise(render.gray, 8.0, 3);
  const Result<CardAlignment> alignment = aligner_.align(render);
  ASSERT_TRUE(alignment.ok());
  EXPECT_LT(alignment->correlation, 0.5);
  expect_close(render, pose, 0.3, 0.6);
}

// 90 px wide: a sixteenth of its pixels would not hold the pose.
TEST_F(CardAlignmentTest, SmallCardIsFound) {
  for (const std::uint64_t seed : {4U, 20U, 25U, 40U, 55U}) {
    cv::RNG random(seed);
    const double distance_mm = random.uniform(1150.0, 1350.0);
    const double tilt_deg = random.uniform(0.0, 20.0);
    const double azimuth_deg = random.uniform(0.0, 360.0);
    const double roll_deg = random.uniform(0.0, 360.0);
    const Pose pose = look_at_card(kCard, distance_mm, tilt_deg, azimuth_deg, roll_deg, {800.0, 600.0});
    expect_close(noisy(pose, seed, 0.6), pose, 0.2, 3.0, "seed " + std::to_string(seed));
  }
}

// Stairs of the label that line up put two sides of the hull on one line.
TEST_F(CardAlignmentTest, SidesThatAreOneAreFoundAsOne) {
  for (const std::uint64_t seed : {158U, 180U, 194U, 220U, 315U}) {
    const Pose pose = far_pose(seed);
    expect_close(noisy(pose, seed, 0.6), pose, 0.1, 0.5, "seed " + std::to_string(seed));
  }
}

TEST_F(CardAlignmentTest, InformationMatchesTheScatterOfPoses) {
  CardAlignmentParams params;
  params.refinement.systematic_px = 0.0;  // the render has none
  CardAligner aligner(params);
  ASSERT_TRUE(aligner.set_pattern(print(), kCard).ok());
  const Pose pose = usual_pose();
  const CardRender clean = render_card(pose, kCard, print());
  constexpr int kRuns = 40;
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    CardRender render{clean.gray.clone(), clean.labels};
    add_noise(render.gray, 6.0, static_cast<std::uint64_t>(run) + 1);
    const Result<CardAlignment> alignment = aligner.align(render);
    ASSERT_TRUE(alignment.ok());
    sum += compare_poses(*alignment, pose, kCard, kFocalPx).normalised_square;
  }
  // Chi square of 6 degrees; the mean of 40 has a standard deviation of 0.55.
  std::cout << "mean normalised square " << sum / kRuns << "\n";
  EXPECT_GT(sum / kRuns, 3.5);
  EXPECT_LT(sum / kRuns, 9.0);
}

TEST_F(CardAlignmentTest, BlurIsFoundAndHarmless) {
  const Pose pose = usual_pose();
  for (const double blur_px : {0.0, 0.7, 1.5}) {
    const CardRender render = noisy(pose, 3, blur_px);
    const Result<CardAlignment> alignment = aligner_.align(render);
    ASSERT_TRUE(alignment.ok()) << blur_px;
    EXPECT_LT(compare_poses(*alignment, pose, kCard, kFocalPx).corner_rms_px, 0.05) << blur_px;
    const double total_px = std::hypot(blur_px, 0.29);  // with the pixel's own square
    EXPECT_LT(alignment->blur_px, std::max(0.75, 1.45 * total_px)) << blur_px;
    EXPECT_GT(alignment->blur_px, total_px / 1.45) << blur_px;
  }
}

TEST_F(CardAlignmentTest, LightThatChangesAcrossTheCardIsHarmless) {
  const Pose pose = usual_pose();
  CardRender render = render_card(pose, kCard, print());
  for (int y = 0; y < render.gray.rows; ++y) {
    for (int x = 0; x < render.gray.cols; ++x) {
      const double gain = 0.5 + 0.2 * (x - 1000.0) / 300.0;
      const double offset = 40.0 + 20.0 * (y - 400.0) / 150.0;
      render.gray(y, x) = cv::saturate_cast<std::uint8_t>(gain * render.gray(y, x) + offset);
    }
  }
  add_noise(render.gray, kNoise, 5);
  expect_close(render, pose, 0.05, 0.1);
}

TEST_F(CardAlignmentTest, GlareAndCutleryLabelledAsCardAreHarmless) {
  const Pose pose = usual_pose();
  CardRender render = noisy(pose, 6);
  cover(render, pose, disc({60.0, 20.0}, 9.0), kCardLabel, 255);
  cover(render, pose, {{10.0, 0.5}, {16.0, 0.5}, {34.0, 53.5}, {28.0, 53.5}}, kCardLabel, 30);
  expect_close(render, pose, 0.1, 0.2);
}

TEST_F(CardAlignmentTest, CutleryAcrossTheCardIsHarmless) {
  const Pose pose = usual_pose();
  CardRender render = noisy(pose, 6);
  cover(render, pose, {{10.0, -5.0}, {20.0, -5.0}, {60.0, 60.0}, {50.0, 60.0}}, 0, 30);
  expect_close(render, pose, 0.05, 0.1);
}

TEST_F(CardAlignmentTest, CoveredCornerSideOrHalfStillAligns) {
  const Pose pose = usual_pose();
  const std::vector<std::pair<const char*, std::vector<Vec2>>> covers = {
      {"corner", disc({0.0, 0.0}, 25.0)},
      {"far corner", disc({85.6, 54.0}, 30.0)},
      {"short side by a plate", disc({140.0, 27.0}, 90.0)},
      {"long side by a plate", disc({43.0, -90.0}, 110.0)},
      {"40 % of the length", {{-5.0, -5.0}, {34.0, -5.0}, {34.0, 60.0}, {-5.0, 60.0}}},
      {"slanting", {{50.0, -5.0}, {95.0, -5.0}, {95.0, 60.0}, {70.0, 60.0}}},
  };
  for (const auto& [what, polygon] : covers) {
    CardRender render = noisy(pose, 8);
    cover(render, pose, polygon, 1, 200);
    expect_close(render, pose, 0.1, 0.2, what);
  }
}

TEST_F(CardAlignmentTest, LabelsThatAreTooWideOrTooNarrowAreHarmless) {
  const Pose pose = usual_pose();
  const CardRender render = noisy(pose, 9);
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_ELLIPSE, {7, 7});
  CardRender wide{render.gray, {}};
  cv::dilate(render.labels, wide.labels, kernel);
  expect_close(wide, pose, 0.05, 0.1, "wide");
  CardRender narrow{render.gray, {}};
  cv::erode(render.labels, narrow.labels, kernel);
  expect_close(narrow, pose, 0.05, 0.1, "narrow");
}

TEST_F(CardAlignmentTest, NoCardIsFoundWhereThereIsNone) {
  const Pose pose = usual_pose();
  CardRender unlabelled = noisy(pose, 10);
  unlabelled.labels.setTo(0);
  EXPECT_EQ(aligner_.align(unlabelled).code(), StatusCode::card_not_found);

  CardRender mostly_covered = noisy(pose, 10);
  cover(mostly_covered, pose, {{-5.0, -5.0}, {62.0, -5.0}, {62.0, 60.0}, {-5.0, 60.0}}, 1, 200);
  EXPECT_EQ(aligner_.align(mostly_covered).code(), StatusCode::card_not_found);

  CardRender other = render_card(pose, kCard, random_print(8));
  EXPECT_EQ(aligner_.align(other).code(), StatusCode::card_not_found);

  CardRender blank = render_card(pose, kCard, print());
  blank.gray.setTo(170, blank.labels);
  EXPECT_EQ(aligner_.align(blank).code(), StatusCode::card_not_found);

  CardRender mirrored = render_card(pose, kCard, print());
  cv::flip(mirrored.gray, mirrored.gray, 1);
  cv::flip(mirrored.labels, mirrored.labels, 1);
  EXPECT_EQ(aligner_.align(mirrored).code(), StatusCode::card_not_found);
}

TEST_F(CardAlignmentTest, AnyLabelsEndWithAStatus) {
  const Pose pose = usual_pose();
  const CardRender render = noisy(pose, 11);
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    cv::RNG random(seed);
    cv::Mat1b labels(render.labels.size(), static_cast<std::uint8_t>(0));
    const int shapes = random.uniform(1, 4);
    for (int i = 0; i < shapes; ++i) {
      const cv::Point a(random.uniform(-50, 1650), random.uniform(-50, 1250));
      const cv::Point b(random.uniform(-50, 1650), random.uniform(-50, 1250));
      cv::line(labels, a, b, kCardLabel, random.uniform(1, 120));
    }
    const Result<CardAlignment> alignment = aligner_.align(render.gray, labels, render_lens());
    if (!alignment.ok()) continue;
    EXPECT_LT(compare_poses(*alignment, pose, kCard, kFocalPx).corner_rms_px, 1.0) << "seed " << seed;
  }
  cv::Mat1b everything(render.labels.size(), kCardLabel);
  EXPECT_FALSE(aligner_.align(render.gray, everything, render_lens()).ok());
  LensModel other = render_lens();
  other.width = 800;
  EXPECT_EQ(aligner_.align(render.gray, render.labels, other).code(), StatusCode::labels_size_mismatch);
}

}  // namespace
}  // namespace traygauge
