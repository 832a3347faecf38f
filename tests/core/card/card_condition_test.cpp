// Whether a card is seen whole and flat, on pictures that OpenCV rendered: every size, blur and noise of a
// card that is, and cards that are covered or bent.
#include "core/card/card_condition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/core/card/card_render.hpp"

namespace traygauge {
namespace {

const CardModelSize kJudgedCard{};

// Places and turns of the card as photographs have them.
Pose judged_pose(int round, double distance_mm) {
  return look_at_card(kJudgedCard, distance_mm, 12.0 + 5.0 * (round % 4), 37.0 * round, 61.0 * round,
                      {700.0 + 40.0 * (round % 5), 500.0 + 30.0 * (round % 7)});
}

Vec2 judged_pixel(const Pose& pose, const Vec2& print_mm) {
  return render_lens().pinhole.pixel(
      (pose * print_point_mm(print_mm, kJudgedCard.thickness_mm)).hnormalized());
}

// A patch of one grey value over a part of the print.
void cover(CardRender& render, const Pose& pose, const cv::Rect2d& part_mm, double gray) {
  std::vector<cv::Point> polygon;
  const cv::Point2d end = part_mm.br();
  for (const Vec2& corner :
       {Vec2(part_mm.x, part_mm.y), Vec2(end.x, part_mm.y), Vec2(end.x, end.y), Vec2(part_mm.x, end.y)}) {
    const Vec2 pixel = judged_pixel(pose, corner);
    polygon.emplace_back(cvRound(pixel.x()), cvRound(pixel.y()));
  }
  cv::fillConvexPoly(render.gray, polygon, cv::Scalar(gray));
}

// The card bent to a parabola along its length, whose ends lie `rise_mm` above its middle: each point of the
// picture takes what the print shows where its ray meets the card.
CardRender render_bent(const Pose& pose, const cv::Mat1b& print, double rise_mm, double blur_px) {
  const PinholeCamera& camera = render_lens().pinhole;
  const double px_per_mm = print.cols / kJudgedCard.width_mm;
  CardRender render = render_card(pose, kJudgedCard, print, blur_px);
  cv::Mat1f x(render.gray.size(), -1.0F);
  cv::Mat1f y(render.gray.size(), -1.0F);
  const Pose table_from_camera = pose.inverse();
  std::vector<cv::Point> pixels;
  cv::findNonZero(render.labels, pixels);
  const cv::Rect box = cv::boundingRect(pixels) + cv::Size(40, 40) - cv::Point(20, 20);
  for (int row = box.y; row < box.br().y; ++row) {
    for (int column = box.x; column < box.br().x; ++column) {
      const Vec3 along = table_from_camera.rotation * camera.ray(Vec2(column, row)).homogeneous();
      double height_mm = 0.0;
      Vec3 point = Vec3::Zero();
      for (int i = 0; i < 6; ++i) {
        const double depth =
            (kJudgedCard.thickness_mm + height_mm - table_from_camera.translation.z()) / along.z();
        point = table_from_camera.translation + depth * along;
        const double u = 2.0 * point.x() / kJudgedCard.width_mm - 1.0;
        height_mm = rise_mm * u * u;
      }
      x(row, column) = static_cast<float>(point.x() * px_per_mm - 0.5);
      y(row, column) = static_cast<float>(-point.y() * px_per_mm - 0.5);
    }
  }
  cv::Mat1b smooth;
  cv::GaussianBlur(print, smooth, {}, 0.4 * px_per_mm * 500.0 / render_lens().pinhole.fx_px);
  const cv::Mat1b table(render.gray.size(), static_cast<std::uint8_t>(60));
  render.gray = table.clone();
  cv::remap(smooth, render.gray, x, y, cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
  cv::GaussianBlur(render.gray, render.gray, {}, blur_px);
  const cv::Mat1b whole(print.size(), kCardLabel);
  render.labels = 0;
  cv::remap(whole, render.labels, x, y, cv::INTER_NEAREST, cv::BORDER_TRANSPARENT);
  return render;
}

class CardConditionTest : public ::testing::Test {
 protected:
  CardConditionTest() { EXPECT_TRUE(aligner_.set_pattern(print_, kJudgedCard).ok()); }

  CardCondition condition_of(const CardRender& render) {
    const Result<CardAlignment> alignment = aligner_.align(render);
    EXPECT_TRUE(alignment.ok());
    return alignment.ok() ? alignment->condition : CardCondition();
  }

  cv::Mat1b print_ = random_print(7);
  CardAligner aligner_;
};

TEST_F(CardConditionTest, DoesNotDoubtACleanCard) {
  int round = 0;
  for (const double distance_mm : {350.0, 600.0, 1200.0}) {
    for (const double blur_px : {0.3, 0.6, 1.0}) {
      for (const double noise : {1.0, 5.0, 12.0}) {
        CardRender render = render_card(judged_pose(round, distance_mm), kJudgedCard, print_, blur_px);
        add_noise(render.gray, noise, static_cast<std::uint64_t>(round));
        const CardCondition condition = condition_of(render);
        EXPECT_FALSE(condition.is_doubtful)
            << distance_mm << " mm, blur " << blur_px << ", noise " << noise << ": hidden "
            << condition.hidden_fraction << ", bend " << condition.bend_mm << ", " << condition.bend_square;
        ++round;
      }
    }
  }
}

TEST_F(CardConditionTest, LightThatChangesOverTheCardIsNoDoubt) {
  for (int round = 0; round < 4; ++round) {
    const Pose pose = judged_pose(round, 700.0);
    CardRender render = render_card(pose, kJudgedCard, print_, 0.5);
    const Vec2 shine = judged_pixel(pose, {20.0 + 15.0 * round, 25.0});
    for (int y = 0; y < render.gray.rows; ++y) {
      for (int x = 0; x < render.gray.cols; ++x) {
        const double off = (Vec2(x, y) - shine).squaredNorm() / (2.0 * 30.0 * 30.0);
        const double lit = (0.6 + 0.2 * x / render.gray.cols) * render.gray(y, x) + 50.0 * std::exp(-off);
        render.gray(y, x) = cv::saturate_cast<std::uint8_t>(lit);
      }
    }
    add_noise(render.gray, 3.0, static_cast<std::uint64_t>(round));
    const CardCondition condition = condition_of(render);
    EXPECT_FALSE(condition.is_doubtful) << condition.hidden_fraction << " " << condition.bend_square;
  }
}

TEST_F(CardConditionTest, DoubtsACoveredCardOfAnySize) {
  int round = 0;
  for (const double distance_mm : {350.0, 600.0, 1200.0}) {
    for (const double share : {0.1, 0.2, 0.3}) {
      const Pose pose = judged_pose(round, distance_mm);
      CardRender render = render_card(pose, kJudgedCard, print_, 0.5);
      // From the left edge or the right one, over the height of the card or half of it.
      const bool is_half = round % 2 == 0 && share < 0.15;
      const double wide_mm = share * kJudgedCard.width_mm * (is_half ? 2.0 : 1.0);
      const double left_mm = round % 4 < 2 ? 0.0 : kJudgedCard.width_mm - wide_mm;
      cover(render, pose, {left_mm, 0.0, wide_mm, kJudgedCard.height_mm * (is_half ? 0.5 : 1.0)}, 170.0);
      add_noise(render.gray, 4.0, static_cast<std::uint64_t>(round));
      const CardCondition condition = condition_of(render);
      EXPECT_TRUE(condition.is_doubtful) << distance_mm << " mm, " << share;
      EXPECT_GT(condition.hidden_fraction, 0.3 * share) << distance_mm;
      EXPECT_LT(condition.hidden_fraction, 1.5 * share) << distance_mm;
      ++round;
    }
  }
}

TEST_F(CardConditionTest, MeasuresHowFarACardIsBent) {
  for (const double distance_mm : {400.0, 800.0}) {
    for (const double rise_mm : {0.0, 0.75, 1.5}) {
      const Pose pose = look_at_card(kJudgedCard, distance_mm, 25.0, 40.0, 30.0, {760.0, 610.0});
      CardRender render = render_bent(pose, print_, rise_mm, 0.5);
      add_noise(render.gray, 3.0, 3);
      const CardCondition condition = condition_of(render);
      EXPECT_NEAR(condition.bend_mm, rise_mm, 0.15 + 0.15 * rise_mm) << distance_mm;
      EXPECT_EQ(condition.is_doubtful, rise_mm > 0.0) << distance_mm << ", square " << condition.bend_square;
    }
  }
}

TEST_F(CardConditionTest, PlainPrintIsNotToldHidden) {
  cv::Mat1b print = random_print(7);
  print(cv::Rect(0, 0, print.cols / 3, print.rows)) = 190;
  ASSERT_TRUE(aligner_.set_pattern(print, kJudgedCard).ok());
  for (int round = 0; round < 4; ++round) {
    CardRender render = render_card(judged_pose(round, 700.0), kJudgedCard, print, 0.5);
    add_noise(render.gray, 5.0, static_cast<std::uint64_t>(round));
    EXPECT_EQ(condition_of(render).hidden_fraction, 0.0);
  }
}

}  // namespace
}  // namespace traygauge
