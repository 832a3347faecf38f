// Pieces and holes of random blots, against OpenCV's connected components.
#include "core/volume/outline_rows.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <random>

namespace traygauge {
namespace {

constexpr std::uint8_t kLabel = 7;
constexpr std::uint8_t kOther = 3;

ImageView<const std::uint8_t> view_of(const cv::Mat& picture) {
  return {picture.data, picture.cols, picture.rows};
}

TEST(OutlineRows, CountPiecesLessHoles) {
  constexpr unsigned kSeed = 417;
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> place(-5, 65);
  std::uniform_int_distribution<int> radius(1, 14);
  int in_pieces = 0;
  int with_holes = 0;
  for (int i = 0; i < 300; ++i) {
    cv::Mat labels(60, 60, CV_8U, cv::Scalar(0));
    for (int blot = 0; blot < 8; ++blot) {
      const bool is_own = blot % 3 != 2;  // others take bites out of it
      cv::circle(labels, {place(random), place(random)}, radius(random), cv::Scalar(is_own ? kLabel : kOther),
                 cv::FILLED);
    }
    // A frame around it, so that all that surrounds the label is one component.
    cv::Mat framed;
    cv::copyMakeBorder(labels == kLabel, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
    cv::Mat numbers;
    const int pieces = cv::connectedComponents(framed, numbers, 4) - 1;
    const int holes = cv::connectedComponents(framed == 0, numbers, 8) - 2;
    EXPECT_EQ(count_pieces(view_of(labels), kLabel), pieces - holes) << i;
    in_pieces += pieces > 1 ? 1 : 0;
    with_holes += holes > 0 ? 1 : 0;
  }
  EXPECT_GT(in_pieces, 50);
  EXPECT_GT(with_holes, 5);
}

TEST(OutlineRows, CountNoPiecesOfWhatIsNotThere) {
  const cv::Mat labels(20, 30, CV_8U, cv::Scalar(kOther));
  EXPECT_EQ(count_pieces(view_of(labels), kLabel), 0);
  EXPECT_EQ(count_pieces(view_of(labels), kOther), 1);
}

}  // namespace
}  // namespace traygauge
