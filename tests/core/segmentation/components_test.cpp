// Connected cells, against OpenCV's.
#include "core/segmentation/components.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr int kColumns = 61;
constexpr int kRows = 43;
constexpr std::uint8_t kSource = 1;
constexpr std::uint8_t kThrough = 2;
constexpr std::uint8_t kElse = 3;

TEST(Components, SpreadOverCellsThatAreConnected) {
  std::mt19937 random(test::random_seed());
  std::vector<std::int32_t> queue(std::size_t{kColumns} * kRows);
  int reached = 0;
  int unreached = 0;
  for (int round = 0; round < 20; ++round) {
    cv::Mat1b cells(kRows, kColumns);
    for (std::uint8_t& cell : cells)
      cell = random() % 100 == 0 ? kSource : random() % 100 < 60 ? kThrough : kElse;
    const cv::Mat1b before = cells.clone();
    cv::Mat1i parts;
    cv::connectedComponents(before != kElse, parts, 4);
    std::vector<bool> has_seed(std::size_t{kColumns} * kRows, false);
    for (int cell = 0; cell < kColumns * kRows; ++cell) {
      if (before.data[cell] == kSource)
        has_seed[static_cast<std::size_t>(parts(cell / kColumns, cell % kColumns))] = true;
    }
    spread_through({cells.data, kColumns, kRows}, kSource, kThrough, queue);
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) {
        const bool is_reached = before(y, x) != kElse && has_seed[static_cast<std::size_t>(parts(y, x))];
        ASSERT_EQ(cells(y, x), is_reached ? kSource : before(y, x));
        reached += is_reached && before(y, x) == kThrough ? 1 : 0;
        unreached += !is_reached && before(y, x) == kThrough ? 1 : 0;
      }
    }
  }
  EXPECT_GT(reached, 1000);
  EXPECT_GT(unreached, 1000);
}

}  // namespace
}  // namespace traygauge
