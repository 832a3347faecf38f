// The cards that Traygauge makes, told apart by core's finder in pictures rendered by OpenCV.
#include "firmware/card/known_cards.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "firmware/card/card_drawing.hpp"
#include "firmware/card/card_finder.hpp"
#include "firmware/check/view_check.hpp"
#include "tests/core/card/card_render.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

const CardModelSize kPrintedSize{};

cv::Mat1b fine_print(int number) {
  const Picture picture = picture_of(draw_card(number), {1712, 1080}, 3);
  cv::Mat1b print(picture.size.height, picture.size.width);
  std::copy(picture.pixels.begin(), picture.pixels.end(), print.begin());
  return print;
}

// Each card lies in another way.
Pose pose_of_card(int number) {
  return look_at_card(kPrintedSize, 380.0 + 15.0 * number, 8.0 + 2.0 * number, 67.0 * number, 131.0 * number,
                      Vec2(600.0 + 30.0 * number, 700.0 - 20.0 * number));
}

cv::Mat1b photograph_card(int number) {
  CardRender render = render_card(pose_of_card(number), kPrintedSize, fine_print(number), 0.6);
  add_noise(render.gray, 3.0, static_cast<std::uint64_t>(number));
  return render.gray;
}

FrameView frame_of(const cv::Mat1b& gray) {
  return {gray.data, gray.cols, gray.rows, static_cast<std::ptrdiff_t>(gray.step[0]), PixelFormat::gray8};
}

ReferenceCard reference_card(const Picture& picture) {
  ReferenceCard card;
  card.pattern = picture.gray();
  return card;
}

TEST(KnownCards, PictureIsKnownAgainThoughNoiseIsOnIt) {
  std::mt19937 random(test::random_seed());
  for (const int number : {1, 7, kCardPatterns}) {
    Picture picture = card_picture(number);
    EXPECT_EQ(number_of_card(picture.gray()), number);
    for (std::uint8_t& pixel : picture.pixels)
      pixel = static_cast<std::uint8_t>(pixel + static_cast<int>(random() % 21U) - 10);
    EXPECT_EQ(number_of_card(picture.gray()), number);
  }
}

TEST(KnownCards, OtherPicturesAreNoKnownCard) {
  Picture turned = card_picture(1);
  std::reverse(turned.pixels.begin(), turned.pixels.end());
  EXPECT_EQ(number_of_card(turned.gray()), std::nullopt);
  EXPECT_EQ(number_of_card(picture_of(draw_card(1), {428, 270}, 2).gray()), std::nullopt);
  Picture blank(kCardPictureSize, PixelFormat::gray8);
  EXPECT_EQ(number_of_card(blank.gray()), std::nullopt);
  std::fill(blank.pixels.begin(), blank.pixels.end(), kPaperGray);
  EXPECT_EQ(number_of_card(blank.gray()), std::nullopt);
}

TEST(KnownCards, EachIsFoundByItsOwnPictureAlone) {
  std::vector<cv::Mat1b> photographs;
  for (int number = 1; number <= kCardPatterns; ++number) photographs.push_back(photograph_card(number));
  CardFinder finder(kRenderWidth, kRenderHeight);
  for (int sought = 1; sought <= kCardPatterns; ++sought) {
    const Picture picture = card_picture(sought);
    ASSERT_TRUE(finder.learn(reference_card(picture)).ok()) << card_id(sought);
    for (int lying = 1; lying <= kCardPatterns; ++lying) {
      CardAlignment found;
      const Status status =
          finder.find(frame_of(photographs[static_cast<std::size_t>(lying - 1)]), render_lens(), found);
      EXPECT_EQ(status.ok(), sought == lying) << card_id(sought) << " sought, lying " << card_id(lying);
      if (!status.ok() || sought != lying) continue;
      const CardPoseError error = compare_poses(found, pose_of_card(lying), kPrintedSize, 1390.0);
      EXPECT_LT(error.corner_rms_px, 0.05) << card_id(lying);
      EXPECT_LT(error.normal_deg, 0.1) << card_id(lying);
    }
  }
}

TEST(KnownCards, AnotherOneIsNamed) {
  const cv::Mat1b photograph = photograph_card(5);
  const Picture picture = card_picture(3);
  const ReferenceCard expected = reference_card(picture);
  const cv::Mat1b empty(kRenderHeight, kRenderWidth, std::uint8_t{60});
  // In the second of two pictures.
  const std::array<CardSight, 2> sights{
      {{frame_of(empty), render_lens()}, {frame_of(photograph), render_lens()}}};
  ASSERT_EQ(find_other_card(sights, expected), 5);
  EXPECT_EQ(
      tell_other_card(5, expected, "card.png"),
      "Card TG-05 lies there, but TG-03 was expected, whose picture is card.png: lay TG-03 there, or name "
      "the picture that traygauge card --pattern 5 makes.");
  const Picture bought(kCardPictureSize, PixelFormat::gray8);
  EXPECT_EQ(
      tell_other_card(5, reference_card(bought), "card.png"),
      "Card TG-05 lies there, but card.png is the picture of another card: lay that one there, or name the "
      "picture that traygauge card --pattern 5 makes.");
}

TEST(KnownCards, NoneIsNamedWhereNoOtherLies) {
  const Picture picture = card_picture(5);
  const cv::Mat1b own = photograph_card(5);
  const cv::Mat1b empty(kRenderHeight, kRenderWidth, std::uint8_t{60});
  const std::array<CardSight, 2> sights{{{frame_of(own), render_lens()}, {frame_of(empty), render_lens()}}};
  EXPECT_EQ(find_other_card(sights, reference_card(picture)), std::nullopt);
}

TEST(KnownCards, CheckSaysWhichCardLiesThere) {
  const cv::Mat1b photograph = photograph_card(2);
  const Picture picture = card_picture(9);
  std::optional<Pose> camera_from_table;
  const CheckResult other =
      check_card(frame_of(photograph), render_lens(), reference_card(picture), camera_from_table);
  EXPECT_FALSE(other.is_good);
  EXPECT_NE(other.text.find("Card TG-02 lies there, but TG-09 was expected"), std::string::npos)
      << other.text;
  const cv::Mat1b empty(kRenderHeight, kRenderWidth, std::uint8_t{60});
  const CheckResult none =
      check_card(frame_of(empty), render_lens(), reference_card(picture), camera_from_table);
  EXPECT_NE(none.text.find("not in view"), std::string::npos) << none.text;
  EXPECT_FALSE(camera_from_table);
}

}  // namespace
}  // namespace traygauge
