// Photographed whole fruit through all of the product, its outlines given. Smooth food tells nothing of its
// height before it is matched: where too little height was searched, a third of it was missing.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "firmware/evaluate/protocol.hpp"
#include "firmware/evaluate/statistics.hpp"
#include "tests/evaluation/real/fruit_captures.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

struct FruitFigures {
  std::size_t captures = 0;
  std::size_t measured = 0;
  double mean_ml = 0.0;  // under the upper surface
  double deviation_percent = 0.0;
};

FruitFigures measure(const std::string& board, const BoardFruit& fruit) {
  const TemporaryFolder set;
  FruitFigures figures;
  figures.captures = write_fruit_captures(captures_folder() / "real" / board, fruit, set.path());
  ProtocolOptions options;
  options.runs = 1;
  std::vector<std::string> skipped;
  std::vector<double> columns_ml;
  for (const PairRuns& pair : run_protocol(set.path(), options, skipped, [](std::size_t, std::size_t) {})) {
    const Run& run = pair.runs.at(0);
    const ItemEstimate* const item = run.items.empty() ? nullptr : &run.items[0];
    const bool is_measured = item != nullptr && item->status == StatusCode::ok;
    if (is_measured) columns_ml.push_back(item->column_volume_ml);
    std::printf("%s: %s, %.0f ml\n", pair.capture.c_str(), name(run.status),
                is_measured ? item->column_volume_ml : 0.0);
  }
  EXPECT_TRUE(skipped.empty());
  figures.measured = columns_ml.size();
  figures.mean_ml = mean(columns_ml);
  figures.deviation_percent = 100.0 * population_deviation(columns_ml) / figures.mean_ml;
  std::printf("%s: %zu of %zu pairs measured, %.0f ml of %.0f (%+.1f %%), standard deviation %.1f %%\n",
              board.c_str(), figures.measured, figures.captures, figures.mean_ml, fruit.column_ml,
              100.0 * (figures.mean_ml / fruit.column_ml - 1.0), figures.deviation_percent);
  return figures;
}

TEST(FruitCaptures, AMangoIsNotCutOff) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  const FruitFigures mango = measure("fruit_board_mango", {470.0, 593.0});
  EXPECT_GE(mango.measured, 6U);  // of 10: the page is curled, and is taken for a card that was moved
  EXPECT_NEAR(mango.mean_ml, 593.0, 0.12 * 593.0);
  EXPECT_LT(mango.deviation_percent, 20.0);
}

TEST(FruitCaptures, AnAppleIsNotCutOff) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  const FruitFigures apple = measure("fruit_board_apple", {205.0, 328.0});
  EXPECT_GE(apple.measured, 25U);
  EXPECT_NEAR(apple.mean_ml, 328.0, 0.12 * 328.0);  // the silhouettes' hull: never less than the apple
  EXPECT_LT(apple.deviation_percent, 15.0);
}

}  // namespace
}  // namespace traygauge
