// Every measurement of the demo's captures and of those in TRAYGAUGE_CAPTURES is, digit for digit, the one in
// the CSV files beside this test. TRAYGAUGE_GOLDEN_UPDATE=1 writes these files anew (`make golden`): the
// change is then reviewed as a diff.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "tests/golden/golden_rows.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge::golden {
namespace {

const std::filesystem::path kSource = TRAYGAUGE_SOURCE_DIR;
constexpr std::size_t kMaxShown = 20;

constexpr Route kRoutes[] = {{"best_given", Profile::best, LabelSource::given},
                             {"best_auto", Profile::best, LabelSource::automatic},
                             {"paper", Profile::paper, LabelSource::given}};

std::vector<std::string> read_lines(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void write_lines(const std::filesystem::path& file, const std::vector<std::string>& lines) {
  std::ofstream stream(file);
  for (const std::string& line : lines) stream << line << '\n';
}

std::string list_differences(const std::vector<std::string>& golden,
                             const std::vector<std::string>& measured) {
  std::string list;
  std::size_t shown = 0;
  for (std::size_t i = 0; i < std::max(golden.size(), measured.size()) && shown < kMaxShown; ++i) {
    const std::string before = i < golden.size() ? golden[i] : "";
    const std::string now = i < measured.size() ? measured[i] : "";
    if (before == now) continue;
    list += "- " + before + "\n+ " + now + "\n";
    ++shown;
  }
  return list;
}

void compare(const std::string& set, const std::filesystem::path& folder, const Route& route) {
  const std::filesystem::path file = kSource / "tests/golden" / (set + "_" + route.name + ".csv");
  std::vector<std::string> measured = measure_rows(folder, route);
  ASSERT_FALSE(measured.empty()) << "no captures in " << folder;
  measured.insert(measured.begin(), header_row());
  if (std::getenv("TRAYGAUGE_GOLDEN_UPDATE") != nullptr) write_lines(file, measured);
  const std::vector<std::string> golden = read_lines(file);
  EXPECT_TRUE(golden == measured) << file << " differs; if that is wanted: make golden, and review the diff\n"
                                  << list_differences(golden, measured);
}

class GoldenNumbers : public testing::TestWithParam<Route> {};
INSTANTIATE_TEST_SUITE_P(Routes, GoldenNumbers, testing::ValuesIn(kRoutes),
                         [](const auto& route) { return std::string(route.param.name); });

TEST_P(GoldenNumbers, OfTheDemo) {
  compare("demo", kSource / "simulator/demo", GetParam());
}

TEST_P(GoldenNumbers, OfTheCaptures) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  compare("captures", captures_folder(), GetParam());
}

}  // namespace
}  // namespace traygauge::golden
