#include "tests/bench/comparison.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>

namespace traygauge::bench {
namespace {

constexpr int kRepetitions = 9;
constexpr double kMinTimeS = 0.02;  // of a repetition
constexpr const char* kFigure = "figure";

struct Sample {
  std::vector<double> times_ms;
  double figure = 0.0;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Google Benchmark calls it `error_occurred` up to version 1.7, which Debian 12 has, then `skipped`.
template <class Run>
bool has_failed(const Run& run) {
  if constexpr (requires { run.skipped; }) {
    return static_cast<int>(run.skipped) != 0;
  } else {
    return run.error_occurred;
  }
}

// Collects the repetitions and prints nothing.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& /*context*/) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || has_failed(run)) continue;
      Sample& sample = samples[run.run_name.function_name];
      sample.times_ms.push_back(run.GetAdjustedCPUTime());
      sample.figure = run.counters.at(kFigure).value;
    }
  }

  std::map<std::string, Sample> samples;
};

std::string full_name(const Comparison& comparison, const Method& method) {
  return comparison.stage + ": " + method.name;
}

void register_method(const Comparison& comparison, const Method& method) {
  const auto work = [run = method.run](benchmark::State& state) {
    double figure = 0.0;
    for (auto _ : state) {
      benchmark::DoNotOptimize(figure = run());
      benchmark::ClobberMemory();
    }
    state.counters[kFigure] = figure;
  };
  benchmark::RegisterBenchmark(full_name(comparison, method).c_str(), work)
      ->Unit(benchmark::kMillisecond)
      ->MinTime(kMinTimeS)
      ->Repetitions(kRepetitions);
}

void print_heading() {
  std::printf("\nCPU time of one thread: median of %d interleaved repetitions, and their range.\n\n",
              kRepetitions);
  std::printf("%-16s %-30s %24s %10s %21s %12s\n", "stage", "method", "result", "median ms", "range ms",
              "ours / peer");
}

void print_row(const Comparison& comparison, const Method& method, const Sample& sample, double ours_ms) {
  const auto [low, high] = std::minmax_element(sample.times_ms.begin(), sample.times_ms.end());
  const double ms = median(sample.times_ms);
  const bool is_ours = &method == comparison.methods.data();
  std::printf("%-16s %-30s %9.4g %-14s %10.3f %10.3f…%10.3f ", is_ours ? comparison.stage.c_str() : "",
              method.name.c_str(), sample.figure, comparison.figure.c_str(), ms, *low, *high);
  if (is_ours) {
    std::printf("%12s\n", "");
  } else {
    std::printf("%12.3f\n", ours_ms / ms);
  }
  std::fflush(stdout);
}

// False when a method that was to run left no time.
bool print_comparison(const Comparison& comparison, const Collector& collector) {
  double ours_ms = 0.0;
  for (const Method& method : comparison.methods) {
    const auto found = collector.samples.find(full_name(comparison, method));
    if (found == collector.samples.end()) return false;
    if (&method == comparison.methods.data()) ours_ms = median(found->second.times_ms);
    print_row(comparison, method, found->second, ours_ms);
  }
  return true;
}

}  // namespace

bool run_comparisons(const std::vector<Comparison>& comparisons, int argc, char** argv) {
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.insert(arguments.begin() + 1, interleave.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return false;
  bool complete = true;
  print_heading();
  for (const Comparison& comparison : comparisons) {
    benchmark::ClearRegisteredBenchmarks();
    for (const Method& method : comparison.methods) register_method(comparison, method);
    Collector collector;
    benchmark::RunSpecifiedBenchmarks(&collector, ".");
    if (!print_comparison(comparison, collector)) complete = false;
  }
  benchmark::Shutdown();
  return complete;
}

}  // namespace traygauge::bench
