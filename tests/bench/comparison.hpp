// Ways of doing the same work, timed beside each other in one run of Google Benchmark.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace traygauge::bench {

// `run` does the work once and returns a figure of what came out (points, matches, …), so that a way that is
// fast because it does less is seen. Its data are prepared outside.
struct Method {
  std::string name;
  std::function<double()> run;
};

// The first method is ours; the ratio of the medians of each peer is printed beside it.
struct Comparison {
  std::string stage;
  std::string figure;  // what the methods return
  std::vector<Method> methods;
};

// Runs each comparison with its repetitions in random order, so that a machine that grows faster or slower
// meanwhile favours nobody, and prints the table of ratios. CPU time, one thread. `argv` may hold Google
// Benchmark's options. False when one of them is unknown or a method failed.
bool run_comparisons(const std::vector<Comparison>& comparisons, int argc, char** argv);

}  // namespace traygauge::bench
