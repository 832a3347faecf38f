// Which seed a cell belongs to: against OpenCV's distances in one colour, and its components across edges.
#include "core/segmentation/geodesic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "tests/support/allocated.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr int kFieldWidth = 80;
constexpr int kFieldHeight = 60;
constexpr std::uint8_t kOtherSeed = 7;

struct SeedField {
  std::vector<CellColour> colours{std::size_t{kFieldWidth} * kFieldHeight, CellColour{120, 100, 90}};
  cv::Mat1b owners = cv::Mat1b(kFieldHeight, kFieldWidth, kNoOwner);
  test::Allocated<GeodesicWorkspace> space{kFieldWidth * kFieldHeight};

  CellColour& colour(int x, int y) { return colours[static_cast<std::size_t>(y * kFieldWidth + x)]; }
  void spread() {
    spread_owners({colours.data(), kFieldWidth, kFieldHeight}, *space,
                  {owners.data, kFieldWidth, kFieldHeight});
  }
};

cv::Mat1f steps_to(const cv::Mat1b& owners, std::uint8_t seed) {
  cv::Mat1f steps;
  cv::distanceTransform(owners != seed, steps, cv::DIST_L1, 3);
  return steps;
}

TEST(Geodesic, NearestSeedWinsInOneColour) {
  std::mt19937 random(test::random_seed());
  std::uniform_int_distribution<int> column(0, kFieldWidth - 1);
  std::uniform_int_distribution<int> line(0, kFieldHeight - 1);
  for (int round = 0; round < 20; ++round) {
    SeedField field;
    for (int i = 0; i < 6; ++i)
      field.owners(line(random), column(random)) = i % 2 == 0 ? kGlazeSeed : kFoodSeed;
    const cv::Mat1f to_glaze = steps_to(field.owners, kGlazeSeed);
    const cv::Mat1f to_food = steps_to(field.owners, kFoodSeed);
    field.spread();
    for (int y = 0; y < kFieldHeight; ++y) {
      for (int x = 0; x < kFieldWidth; ++x) {
        if (to_glaze(y, x) < to_food(y, x)) {
          ASSERT_EQ(field.owners(y, x), kGlazeSeed);
        } else if (to_food(y, x) < to_glaze(y, x)) {
          ASSERT_EQ(field.owners(y, x), kFoodSeed);
        } else {
          ASSERT_NE(field.owners(y, x), kNoOwner);
        }
      }
    }
  }
}

// Blots of a colour of their own, one of them with a seed: it keeps to its blot however near it is to others.
TEST(Geodesic, ColourHoldsASeedInItsOwnBlot) {
  std::mt19937 random(test::random_seed());
  std::uniform_int_distribution<int> column(12, kFieldWidth - 13);
  std::uniform_int_distribution<int> line(12, kFieldHeight - 13);
  std::uniform_int_distribution<int> radius(4, 10);
  for (int round = 0; round < 20; ++round) {
    SeedField field;
    cv::Mat1b blots(kFieldHeight, kFieldWidth, std::uint8_t{0});
    const cv::Point middle(column(random), line(random));
    cv::circle(blots, middle, radius(random), cv::Scalar(255), cv::FILLED);
    cv::circle(blots, {column(random), line(random)}, radius(random), cv::Scalar(255), cv::FILLED);
    for (int y = 0; y < kFieldHeight; ++y) {
      for (int x = 0; x < kFieldWidth; ++x) {
        if (blots(y, x) != 0) field.colour(x, y) = {60, 200, 60};
      }
    }
    cv::Mat1i parts;
    cv::connectedComponents(blots, parts, 4);
    cv::Mat1i around;
    cv::connectedComponents(blots == 0, around, 4);
    field.owners(middle.y, middle.x) = kFoodSeed;
    field.owners(0, 0) = kGlazeSeed;
    field.spread();
    for (int y = 0; y < kFieldHeight; ++y) {
      for (int x = 0; x < kFieldWidth; ++x) {
        if (parts(y, x) == parts(middle)) {
          ASSERT_EQ(field.owners(y, x), kFoodSeed);
        }
        if (around(y, x) == around(0, 0)) {  // not shut in between blots
          ASSERT_EQ(field.owners(y, x), kGlazeSeed);
        }
      }
    }
  }
}

TEST(Geodesic, NothingIsReachedBehindBars) {
  std::mt19937 random(test::random_seed());
  std::uniform_int_distribution<int> column(0, kFieldWidth - 1);
  std::uniform_int_distribution<int> line(0, kFieldHeight - 1);
  int unreached = 0;
  for (int round = 0; round < 20; ++round) {
    SeedField field;
    for (int i = 0; i < 12; ++i) {
      cv::line(field.owners, {column(random), line(random)}, {column(random), line(random)},
               cv::Scalar(kBarred), 1, 4);
    }
    const cv::Mat free = field.owners != kBarred;
    cv::Mat1i parts;
    cv::connectedComponents(free, parts, 4);
    const cv::Point seed(column(random), line(random));
    if (free.at<std::uint8_t>(seed) == 0) continue;
    field.owners(seed) = kOtherSeed;
    field.spread();
    for (int y = 0; y < kFieldHeight; ++y) {
      for (int x = 0; x < kFieldWidth; ++x) {
        const std::uint8_t wanted = free.at<std::uint8_t>(y, x) == 0 ? kBarred
                                    : parts(y, x) == parts(seed)     ? kOtherSeed
                                                                     : kNoOwner;
        ASSERT_EQ(field.owners(y, x), wanted);
        unreached += wanted == kNoOwner ? 1 : 0;
      }
    }
  }
  EXPECT_GT(unreached, 1000);
}

// A shadow's slope of a few grey values from cell to cell is no edge, the same fall at once is.
TEST(Geodesic, SlopesAreCheapAndStepsAreNot) {
  for (const bool is_step : {false, true}) {
    SeedField field;
    for (int y = 0; y < kFieldHeight; ++y) {
      for (int x = 0; x < kFieldWidth; ++x) {
        const int down = is_step ? (x > 30 ? 120 : 0) : 3 * std::clamp(x - 10, 0, 40);
        field.colour(x, y).luma = static_cast<std::uint8_t>(200 - down);
      }
    }
    field.owners(30, 5) = kGlazeSeed;
    field.owners(30, 75) = kFoodSeed;
    field.spread();
    EXPECT_EQ(field.owners(30, 28), kGlazeSeed);
    EXPECT_EQ(field.owners(30, 38), is_step ? kFoodSeed : kGlazeSeed);
    EXPECT_EQ(field.owners(30, 42), kFoodSeed);
  }
}

TEST(Geodesic, WithoutSeedsNobodyOwnsAnything) {
  SeedField field;
  field.spread();
  EXPECT_EQ(cv::countNonZero(field.owners), 0);
}

}  // namespace
}  // namespace traygauge
