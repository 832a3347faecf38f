// Measuring several pairs at the same time changes nothing but the time.
#include <gtest/gtest.h>

#include "firmware/evaluate/evaluation.hpp"

namespace traygauge {
namespace {

struct Outcome {
  std::string estimates;
  std::string items;
  std::string tables;
};

Outcome evaluate_demo(int jobs) {
  ProtocolOptions options;
  options.runs = 2;
  options.jobs = jobs;
  std::vector<std::string> skipped;
  std::size_t last_done = 0;
  std::size_t all = 0;
  const std::filesystem::path set = TRAYGAUGE_SOURCE_DIR "/simulator/demo";
  const std::vector<PairRuns> runs =
      run_protocol(set, options, skipped, [&](std::size_t done, std::size_t total) {
        EXPECT_EQ(done, last_done + 1);
        last_done = done;
        all = total;
      });
  EXPECT_TRUE(skipped.empty());
  EXPECT_EQ(all, 4U);
  EXPECT_EQ(last_done, all);
  const Evaluation evaluation = evaluate_runs(set, options, runs, skipped);
  EXPECT_EQ(evaluation.measurements, 4);
  EXPECT_GT(evaluation.groups.front().figures.estimates, 0);
  return {compose_estimates_csv(runs), compose_items_csv(evaluation), compose_tables(evaluation)};
}

// The tables without the times in them.
std::string from_items(const std::string& tables) {
  return tables.substr(tables.find("capture             item"));
}

TEST(EvaluateJobs, ResultsDoNotDependOnThem) {
  const Outcome one = evaluate_demo(1);
  const Outcome three = evaluate_demo(3);
  EXPECT_EQ(one.estimates, three.estimates);
  EXPECT_EQ(one.items, three.items);
  EXPECT_EQ(from_items(one.tables), from_items(three.tables));
}

}  // namespace
}  // namespace traygauge
