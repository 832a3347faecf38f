// Corners found in pictures of a board against where they are.
#include "firmware/calibrate/chessboard.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/calibrate/board_views.hpp"

namespace traygauge {
namespace {

using namespace test;

// The corners may begin at the other end.
double rms_px(const BoardSighting& found, const BoardSighting& truth, Vec2& bias_px) {
  const std::size_t count = truth.corners_px.size();
  double least = 1e9;
  for (const bool reversed : {false, true}) {
    double sum = 0.0;
    Vec2 mean = Vec2::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 off = found.corners_px[i] - truth.corners_px[reversed ? count - 1 - i : i];
      sum += off.squaredNorm();
      mean += off / static_cast<double>(count);
    }
    if (std::sqrt(sum / static_cast<double>(count)) >= least) continue;
    least = std::sqrt(sum / static_cast<double>(count));
    bias_px = mean;
  }
  return least;
}

TEST(Chessboard, CornersAreFoundToHundredthsOfAPixel) {
  const LensModel lens = phone_lens(0.4);
  const auto poses = hold_board(kBoard, lens, {6, 30.0, true}, 3);
  Vec2 mean_bias_px = Vec2::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    BoardSighting found;
    ASSERT_TRUE(find_chessboard(draw_board(kBoard, lens, poses[i], i).gray(), kBoard, found)) << i;
    Vec2 bias_px = Vec2::Zero();
    EXPECT_LT(rms_px(found, project_board(kBoard, lens, poses[i], 0.0, 0), bias_px), 0.15) << i;
    mean_bias_px += bias_px / static_cast<double>(poses.size());
  }
  EXPECT_LT(mean_bias_px.norm(), 0.03);
}

TEST(Chessboard, NeitherAnotherBoardNorAnEmptyPictureIsFound) {
  const LensModel lens = phone_lens(0.4);
  const Picture picture = draw_board(kBoard, lens, hold_board(kBoard, lens, {1, 10.0, false}, 1)[0], 1);
  BoardSighting found;
  EXPECT_FALSE(find_chessboard(picture.gray(), {8, 5}, found));
  EXPECT_FALSE(find_chessboard(Picture({640, 480}, PixelFormat::gray8).gray(), kBoard, found));
}

}  // namespace
}  // namespace traygauge
