// The card in pictures without labels, rendered by OpenCV, and the corners by which it is found.
#include "core/card/card_search.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "core/card/card_hypotheses.hpp"
#include "core/card/compared_corners.hpp"
#include "core/image/resample.hpp"
#include "tests/core/card/card_render.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

const CardModelSize kSoughtCard{};

// Of pictures in which a pixel stands for `factor` x `factor`.
LensModel shrunken(LensModel lens, int factor) {
  lens.width /= factor;
  lens.height /= factor;
  PinholeCamera& camera = lens.pinhole;
  camera.fx_px /= factor;
  camera.fy_px /= factor;
  camera.cx_px = scale_coordinate(camera.cx_px, 1.0 / factor);
  camera.cy_px = scale_coordinate(camera.cy_px, 1.0 / factor);
  return lens;
}

struct CardSeeker {
  explicit CardSeeker(int shrink = 1)
      : lens(shrunken(render_lens(), shrink)), space(lens.width, lens.height, CardSearchParams{}) {}

  LensModel lens;
  CardSearchParams params;
  test::Allocated<CardSearchWorkspace> space;
  test::Allocated<CardPattern> pattern{CardPatternParams{}};
  test::Allocated<PrintCorners> print{CardSearchParams{}};

  Status learn(const cv::Mat1b& picture) {
    EXPECT_TRUE(prepare_card_pattern(test::view_of(picture), kSoughtCard, {}, *pattern).ok());
    return learn_print_corners(*pattern, params, *space, *print);
  }
  Result<std::array<Vec2, 4>> search(const cv::Mat1b& gray) {
    return search_card(test::view_of(gray), lens, kSoughtCard, *print, params, {}, *space);
  }
};

// The search says only about where the card lies.
void expect_near(const std::array<Vec2, 4>& corners, const Pose& truth, const LensModel& lens,
                 double most_px) {
  const std::array<Vec2, 4> places = print_corners_mm(kSoughtCard);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 seen = (truth * print_point_mm(places[i], kSoughtCard.thickness_mm)).hnormalized();
    EXPECT_LT((corners[i] - seen).norm() * lens.pinhole.fx_px, most_px) << i;
  }
}

TEST(CardSearch, FindsThePrintWhereverItLies) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const cv::Mat1b print = random_print(21);
  CardSeeker seeker;
  ASSERT_TRUE(seeker.learn(print).ok());
  int found = 0;
  constexpr int kRounds = 12;
  for (int round = 0; round < kRounds; ++round) {
    const Pose truth =
        look_at_card(kSoughtCard, 320.0 + 200.0 * unit(random), 30.0 * unit(random), 360.0 * unit(random),
                     360.0 * unit(random), Vec2(500.0 + 600.0 * unit(random), 400.0 + 400.0 * unit(random)));
    CardRender render = render_card(truth, kSoughtCard, print);
    add_noise(render.gray, 2.0, 100U + static_cast<unsigned>(round));
    const Result<std::array<Vec2, 4>> corners = seeker.search(render.gray);
    if (!corners.ok()) continue;
    ++found;
    expect_near(*corners, truth, seeker.lens, 20.0);
  }
  EXPECT_GE(found, kRounds - 1);
}

// A card of 50 to 80 pixels on a patterned table: most patches about its corners show some of the table.
TEST(CardSearch, FindsThePrintInSmallPictures) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr int kShrink = 3;
  const cv::Mat1b print = random_print(23);
  CardSeeker seeker(kShrink);
  ASSERT_TRUE(seeker.learn(print).ok());
  int found = 0;
  constexpr int kRounds = 12;
  for (int round = 0; round < kRounds; ++round) {
    const Pose truth =
        look_at_card(kSoughtCard, 500.0 + 200.0 * unit(random), 25.0 * unit(random), 360.0 * unit(random),
                     360.0 * unit(random), Vec2(500.0 + 600.0 * unit(random), 400.0 + 400.0 * unit(random)));
    const CardRender render = render_card(truth, kSoughtCard, print);
    cv::Mat1b large =
        test::textured_picture(kRenderWidth, kRenderHeight, 100U + static_cast<unsigned>(round));
    render.gray.copyTo(large, render.labels);
    cv::Mat1b gray;
    cv::resize(large, gray, {seeker.lens.width, seeker.lens.height}, 0.0, 0.0, cv::INTER_AREA);
    add_noise(gray, 2.0, 200U + static_cast<unsigned>(round));
    const Result<std::array<Vec2, 4>> corners = seeker.search(gray);
    if (!corners.ok()) continue;
    ++found;
    expect_near(*corners, truth, seeker.lens, 8.0);
  }
  EXPECT_GE(found, kRounds - 1);
}

TEST(CardSearch, FindsNoneAmongOtherThings) {
  CardSeeker seeker;
  ASSERT_TRUE(seeker.learn(random_print(21)).ok());
  const auto search = [&](const cv::Mat1b& gray) { return seeker.search(gray).code(); };
  EXPECT_EQ(search(cv::Mat1b(kRenderHeight, kRenderWidth, std::uint8_t{120})), StatusCode::card_not_found);
  EXPECT_EQ(search(test::textured_picture(kRenderWidth, kRenderHeight, 8)), StatusCode::card_not_found);
  const Pose pose = look_at_card(kSoughtCard, 400.0, 10.0, 0.0, 30.0, Vec2(800.0, 600.0));
  EXPECT_EQ(search(render_card(pose, kSoughtCard, random_print(22)).gray), StatusCode::card_not_found);
}

TEST(CardSearch, LearnsNothingFromABlankPrint) {
  CardSeeker seeker;
  EXPECT_EQ(seeker.learn(cv::Mat1b(540, 856, std::uint8_t{200})).code(), StatusCode::invalid_configuration);
}

TEST(CardSearch, PicturesAreResizedAsOpenCvDoes) {
  const cv::Mat1b picture = test::textured_picture(640, 480, 9);
  std::vector<std::uint8_t> storage(1280 * 960);
  for (const double scale : {0.5, 0.4, 0.75, 1.0, 1.37, 2.0}) {
    const ImageView<std::uint8_t> resized = resize_into(test::view_of(picture), scale, storage);
    ASSERT_EQ(resized.width, static_cast<int>(640 * scale));
    ASSERT_EQ(resized.height, static_cast<int>(480 * scale));
    cv::Mat1b truth;
    cv::resize(picture, truth, {resized.width, resized.height}, 0.0, 0.0,
               scale > 1.0 ? cv::INTER_LINEAR : cv::INTER_AREA);
    int most = 0;
    for (int y = 0; y < resized.height; ++y) {
      for (int x = 0; x < resized.width; ++x) most = std::max(most, std::abs(resized.at(x, y) - truth(y, x)));
    }
    EXPECT_LE(most, 1) << scale;
  }
}

// The print itself, turned: what looks like a corner of it is that corner, so large and turned so far.
TEST(CardSearch, CornersOfATurnedPrintAreItsOwn) {
  const cv::Mat1b print = random_print(21);
  CardSeeker seeker;
  ASSERT_TRUE(seeker.learn(print).ok());
  constexpr double kPxPerMm = 1.4;
  for (const double turn_deg : {0.0, 37.0, 160.0}) {
    const double turn = turn_deg * CV_PI / 180.0;
    cv::Mat1b small;
    cv::resize(print, small, {120, 76}, 0.0, 0.0, cv::INTER_AREA);
    const cv::Matx23d map(std::cos(turn), -std::sin(turn),
                          100.0 - 59.5 * std::cos(turn) + 37.5 * std::sin(turn), std::sin(turn),
                          std::cos(turn), 100.0 - 59.5 * std::sin(turn) - 37.5 * std::cos(turn));
    cv::Mat1b picture;
    cv::warpAffine(small, picture, map, {200, 200}, cv::INTER_CUBIC, cv::BORDER_CONSTANT, cv::Scalar(60));
    ComparedCorners& compared = seeker.space->whole;
    std::copy(picture.begin(), picture.end(), compared.picture_storage.begin());
    const ImageView<const std::uint8_t> view{compared.picture_storage.data(), 200, 200};
    find_compared_corners(view, seeker.params, seeker.space->corner_search, compared);
    EXPECT_TRUE(compared.matches.empty());
    match_corners(compared.corners.items(), *seeker.print, seeker.params, compared);
    ASSERT_GT(compared.matches.size(), 15U) << turn_deg;
    std::size_t right = 0;
    for (const CardSearchMatch& match : compared.matches) {
      const Vec2 at = (match.pattern_mm * kPxPerMm * (120.0 / (85.6 * kPxPerMm))).array() - 0.5;
      const Vec2 seen(map(0, 0) * at.x() + map(0, 1) * at.y() + map(0, 2),
                      map(1, 0) * at.x() + map(1, 1) * at.y() + map(1, 2));
      if ((seen - match.pixel).norm() > 3.0) continue;
      ++right;
      EXPECT_GT(match.turn.dot(Vec2(std::cos(turn), std::sin(turn))), 0.9);
      EXPECT_GT(match.clarity, 0.0);
    }
    EXPECT_GT(right, compared.matches.size() * 3 / 10) << turn_deg;  // by chance one in 300
  }
}

}  // namespace
}  // namespace traygauge
