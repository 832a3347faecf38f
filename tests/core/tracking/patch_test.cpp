// Search and alignment of single patches: against OpenCV's template matching, and against a texture in closed
// form seen through a known affine map.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "core/tracking/patch_alignment.hpp"
#include "core/tracking/patch_search.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

using test::view_of;

using Mat2 = Eigen::Matrix2d;

// Sum of waves of 5 px and more, so that a pixel's area does not matter.
class Texture {
 public:
  explicit Texture(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> turn(0.0, 2.0 * M_PI);
    std::uniform_real_distribution<double> length(5.0, 14.0);
    for (Wave& wave : waves_) {
      const double direction = turn(random);
      const double frequency = 2.0 * M_PI / length(random);
      wave = {frequency * std::cos(direction), frequency * std::sin(direction), turn(random)};
    }
  }
  double operator()(const Vec2& p) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::sin(wave.x * p.x() + wave.y * p.y() + wave.phase);
    return 120.0 + 18.0 * sum;
  }

 private:
  struct Wave {
    double x = 0.0;
    double y = 0.0;
    double phase = 0.0;
  };
  std::array<Wave, 12> waves_;
};

constexpr int kSide = 96;

// The texture at origin + map · pixel, with gain, offset and noise.
cv::Mat1b picture_of(const Texture& texture, const Vec2& origin, const Mat2& map, double gain = 1.0,
                     double offset = 0.0, double noise = 0.0, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> grey(0.0, 1.0);
  cv::Mat1b picture(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double value = gain * texture(origin + map * Vec2(x, y)) + offset + noise * grey(random);
      picture(y, x) = cv::saturate_cast<std::uint8_t>(value);
    }
  }
  return picture;
}

TEST(PatchSearch, FindsWhatOpenCvsTemplateMatchingFinds) {
  const cv::Mat1b first = picture_of(Texture(1), {0.0, 0.0}, Mat2::Identity());
  const cv::Mat1b second = picture_of(Texture(1), {3.0, -5.0}, Mat2::Identity(), 0.8, 20.0, 3.0);
  test::Allocated<PatchSearchWorkspace> memory;
  PatchSearch search(view_of(first), view_of(second), *memory);
  search.begin();
  // Its centre lies between pixels, as the patch's side is even.
  const Vec2 centre(40.5, 44.5);
  SearchBand band;
  band.begin = Vec2(30.5, 42.5);
  band.end = Vec2(46.5, 52.5);
  band.margin_px = 6.0;
  ASSERT_TRUE(search.search(centre, band));
  FoundPatch found;
  ASSERT_TRUE(search.find_best(found));

  const cv::Mat patch = first(cv::Rect(37, 41, kSearchSide, kSearchSide));
  cv::Mat1f scores;
  cv::matchTemplate(second, patch, scores, cv::TM_CCOEFF_NORMED);
  cv::Point best;
  double correlation = 0.0;
  cv::minMaxLoc(scores, nullptr, &correlation, nullptr, &best);
  EXPECT_NEAR(found.correlation, correlation, 1e-4);
  EXPECT_NEAR(found.pixel.x(), best.x + 0.5 * (kSearchSide - 1), 0.5);
  EXPECT_NEAR(found.pixel.y(), best.y + 0.5 * (kSearchSide - 1), 0.5);
  EXPECT_NEAR(found.pixel.x(), centre.x() - 3.0, 0.2);
  EXPECT_NEAR(found.pixel.y(), centre.y() + 5.0, 0.2);
}

TEST(PatchSearch, NotesRepeatedTexture) {
  cv::Mat1b gray(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x)
      gray(y, x) = cv::saturate_cast<std::uint8_t>(128 + 50 * std::sin(x * 0.7) * std::cos(y * 0.7));
  }
  test::Allocated<PatchSearchWorkspace> memory;
  PatchSearch search(view_of(gray), view_of(gray), *memory);
  search.begin();
  SearchBand band;
  band.begin = Vec2(30.0, 48.0);
  band.end = Vec2(66.0, 48.0);
  ASSERT_TRUE(search.search({48.5, 48.5}, band));
  FoundPatch found;
  ASSERT_TRUE(search.find_best(found));
  EXPECT_GT(found.runner_up, 0.95F * found.correlation);
}

TEST(PatchSearch, RefusesWhatItCannotSearch) {
  const cv::Mat1b textured = picture_of(Texture(1), {0.0, 0.0}, Mat2::Identity());
  const cv::Mat1b flat(kSide, kSide, std::uint8_t{90});
  test::Allocated<PatchSearchWorkspace> memory;
  SearchBand band;
  band.begin = band.end = Vec2(48.0, 48.0);
  FoundPatch found;
  PatchSearch of_flat(view_of(flat), view_of(textured), *memory);
  of_flat.begin();
  EXPECT_FALSE(of_flat.search({48.0, 48.0}, band));
  PatchSearch in_flat(view_of(textured), view_of(flat), *memory);
  in_flat.begin();
  EXPECT_TRUE(in_flat.search({48.0, 48.0}, band));
  EXPECT_FALSE(in_flat.find_best(found));
  PatchSearch search(view_of(textured), view_of(textured), *memory);
  search.begin();
  EXPECT_FALSE(search.search({2.0, 48.0}, band));  // outside of the first picture
  band.end = Vec2(-1e6, std::nan(""));
  EXPECT_FALSE(search.search({48.0, 48.0}, band));
  EXPECT_FALSE(search.find_best(found));
}

struct AlignmentCase {
  const char* name;
  PatchMotion motion;
  double turn;     // radians
  double stretch;  // along x
  double shear;
  double map_error;  // of the start
  double gain;
  double noise;
  double max_rms_px;
};

class PatchAlignmentOfTexture : public ::testing::TestWithParam<AlignmentCase> {};

TEST_P(PatchAlignmentOfTexture, FindsTheTruePlace) {
  const AlignmentCase& c = GetParam();
  Mat2 map;  // first_from_second
  map << c.stretch * std::cos(c.turn), -std::sin(c.turn) + c.shear, std::sin(c.turn), std::cos(c.turn);
  constexpr int kTrials = 60;
  double squares = 0.0;
  double normalised = 0.0;
  Vec2 mean = Vec2::Zero();
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE(::testing::Message() << "seed " << trial);
    std::mt19937_64 random(trial);
    std::uniform_real_distribution<double> offset(-1.0, 1.0);
    const Texture texture(trial);
    const cv::Mat1b first = picture_of(texture, Vec2::Zero(), Mat2::Identity(), 1.0, 0.0, c.noise, trial);
    const Vec2 first_pixel(48.5, 48.5);
    const Vec2 truth = Vec2(48.0, 48.0) + Vec2(offset(random), offset(random));
    const cv::Mat1b second =
        picture_of(texture, first_pixel - map * truth, map, c.gain, 10.0, c.noise, trial + 1000);
    PatchAlignment alignment;
    alignment.pixel = truth + 0.7 * Vec2(offset(random), offset(random));
    alignment.first_from_second = map;
    alignment.first_from_second(0, 0) += c.map_error;
    alignment.first_from_second(1, 0) -= c.map_error;
    ASSERT_TRUE(align_patch(view_of(first), first_pixel, view_of(second), c.motion, {}, alignment));
    const Vec2 error = alignment.pixel - truth;
    mean += error / kTrials;
    squares += 0.5 * error.squaredNorm();
    normalised += 0.5 * error.squaredNorm() / (alignment.sigma_px * alignment.sigma_px);
    EXPECT_GT(alignment.correlation, 0.9);
    if (c.motion == PatchMotion::affine) {
      EXPECT_LT((alignment.first_from_second - map).cwiseAbs().maxCoeff(), 0.02 + 0.005 * c.noise);
    }
  }
  const double rms = std::sqrt(squares / kTrials);
  EXPECT_LT(rms, c.max_rms_px);
  // No bias: the mean of so many is that much more accurate.
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 3.5 * rms / std::sqrt(1.0 * kTrials) + 0.002);
  // sigma_px allows for noise that is not white, here it is: it may be up to twice too large.
  if (c.noise > 0.0) {
    EXPECT_LT(std::sqrt(normalised / kTrials), 1.15);
    EXPECT_GT(std::sqrt(normalised / kTrials), 0.4);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, PatchAlignmentOfTexture,
    ::testing::Values(AlignmentCase{"shift", PatchMotion::shift, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.01},
                      AlignmentCase{"turned", PatchMotion::shift, 0.6, 0.85, 0.1, 0.0, 1.3, 0.0, 0.02},
                      AlignmentCase{"noisy", PatchMotion::shift, 0.3, 1.1, 0.0, 0.0, 0.8, 4.0, 0.05},
                      AlignmentCase{"affine", PatchMotion::affine, 0.4, 0.9, 0.1, 0.08, 1.2, 0.0, 0.02},
                      AlignmentCase{"noisy_affine", PatchMotion::affine, 0.4, 0.9, 0.1, 0.08, 0.9, 4.0,
                                    0.05}),
    [](const auto& test) { return test.param.name; });

TEST(PatchAlignment, RefusesEdgesFlatPatchesAndStrangers) {
  const cv::Mat1b textured = picture_of(Texture(1), {0.0, 0.0}, Mat2::Identity());
  const cv::Mat1b flat(kSide, kSide, std::uint8_t{90});
  cv::Mat1b edge(kSide, kSide, std::uint8_t{60});
  edge(cv::Rect(0, 0, 48, kSide)) = 160;
  PatchAlignment alignment;
  const auto align = [&](const cv::Mat1b& first, const cv::Mat1b& second, const Vec2& pixel,
                         const Vec2& start) {
    alignment = {};
    alignment.pixel = start;
    return align_patch(view_of(first), pixel, view_of(second), PatchMotion::affine, {}, alignment);
  };
  const Vec2 middle(48.0, 48.0);
  EXPECT_TRUE(align(textured, textured, middle, middle));
  EXPECT_FALSE(align(flat, flat, middle, middle));
  EXPECT_FALSE(align(edge, edge, middle, middle));
  EXPECT_FALSE(align(textured, textured, {5.0, 48.0}, middle));
  EXPECT_FALSE(align(textured, textured, middle, {92.0, 48.0}));
  EXPECT_FALSE(align(textured, textured, middle, {std::nan(""), 48.0}));
  cv::Mat1b negative;
  cv::bitwise_not(textured, negative);
  EXPECT_FALSE(align(textured, negative, middle, middle));
}

}  // namespace
}  // namespace traygauge
