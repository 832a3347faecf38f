// What gnuplot makes of the CSV files, by the scripts in config/plots.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

#include "firmware/evaluate/evaluation_files.hpp"
#include "tests/firmware/evaluate/sample_runs.hpp"
#include "tests/firmware/evaluate/svg_check.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

constexpr const char* kBar = "<polygon";
constexpr const char* kDot = "'#gpPt6'";
constexpr const char* kSquare = "'#gpPt4'";
constexpr std::size_t kLegend = 1;  // marks of a curve in the legend

// By name, without ".svg".
using Plots = std::map<std::string, std::string>;

Plots draw(const std::vector<PairRuns>& runs) {
  const TemporaryFolder folder;
  write_evaluation_files(folder.path(), evaluate_sample(runs), runs);
  std::ostringstream error;
  Plots drawn;
  const std::vector<Plot> plots = plots_of_evaluation(TRAYGAUGE_SOURCE_DIR "/config/plots", folder.path());
  draw_plots(plots, error);
  EXPECT_EQ(error.str(), "");
  for (const Plot& plot : plots) {
    const std::string svg = read_text(plot.svg);
    EXPECT_EQ(find_svg_fault(svg), "") << plot.svg;
    for (const char* number : {"nan", "NaN", "inf"})
      EXPECT_EQ(svg.find(number), std::string::npos) << plot.svg;
    drawn[plot.svg.stem()] = svg;
  }
  EXPECT_EQ(drawn.size(), 4U);
  return drawn;
}

// One capture with one pair; a food of 100 ml that is measured so often.
std::vector<PairRuns> runs_of_volumes(const std::vector<double>& volumes_ml) {
  PairRuns pair = pair_runs("a", {{2, "food", "heightfield", 100.0, {}, {}}});
  for (const double volume_ml : volumes_ml)
    pair.runs.push_back(measured_run(1, 15.0, {{2, StatusCode::ok, volume_ml}}));
  return {pair};
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Heights of the bars, as shares of the first one.
std::vector<double> heights_of_bars(const std::string& svg) {
  static const std::regex bar("points = '[0-9.]+,([0-9.]+) [0-9.]+,[0-9.]+ [0-9.]+,([0-9.]+) ");
  std::vector<double> heights;
  for (std::sregex_iterator at(svg.begin(), svg.end(), bar), end; at != end; ++at)
    heights.push_back(std::stod((*at)[1]) - std::stod((*at)[2]));
  heights.erase(heights.begin());  // the legend's
  for (double& height : heights) height /= heights.back();
  return heights;
}

TEST(EvaluationPlots, ShowEveryVolume) {
  for (const double sigma_ml : {0.0, 5.0}) {
    Plots plots = draw(sample_runs(sigma_ml));
    EXPECT_EQ(count_in_curve(plots["signed_errors"], 1, kBar), 3 + kLegend) << "-1, +3, +7 %";
    EXPECT_TRUE(holds(plots["signed_errors"], "6 volumes: bias +3.00 %, 100.0 % within ±10 %"));
    EXPECT_EQ(count_in_curve(plots["variation"], 1, kBar), 1 + kLegend) << "both items alike";
    EXPECT_TRUE(holds(plots["variation"], "2 items: mean 3.17 %"));
    EXPECT_EQ(count_in_curve(plots["error_by_angle"], 1, kDot), 2 + kLegend);
    EXPECT_EQ(count_in_curve(plots["error_by_angle"], 2, kSquare), 1 + kLegend) << "one bin of angles";
    EXPECT_EQ(count_in_curve(plots["volumes"], 5, kDot), 2 + kLegend);
    EXPECT_EQ(count_in_curve(plots["volumes"], 6, kSquare), 2 + kLegend);
    EXPECT_EQ(count_in_curve(plots["volumes"], 4, " L") > 0, sigma_ml > 0.0) << "bars of sigma";
  }
}

TEST(EvaluationPlots, OneVolumeIsEnough) {
  Plots plots = draw(runs_of_volumes({100.0}));
  EXPECT_EQ(count_in_curve(plots["signed_errors"], 1, kBar), 1 + kLegend);
  EXPECT_EQ(count_in_curve(plots["error_by_angle"], 1, kDot), 1 + kLegend);
  EXPECT_EQ(count_in_curve(plots["volumes"], 5, kDot), 1 + kLegend);
  EXPECT_EQ(count_in_curve(plots["volumes"], 6, kSquare), 0U) << "no fruit";
  EXPECT_TRUE(holds(plots["variation"], "No data")) << "one volume has no variation";
}

TEST(EvaluationPlots, WithoutDataSaySo) {
  PairRuns refused = pair_runs("a", {{2, "food", "heightfield", 100.0, {}, {}}});
  refused.runs = {refused_run(1, StatusCode::pose_not_found)};
  for (const std::vector<PairRuns>& runs : {std::vector<PairRuns>{}, std::vector<PairRuns>{refused}}) {
    for (const auto& [name, svg] : draw(runs)) EXPECT_TRUE(holds(svg, "No data")) << name;
  }
}

TEST(EvaluationPlots, ErrorsBeyondTheAxisStandInItsLastBins) {
  const std::string svg = draw(runs_of_volumes({400.0, 101.0, 101.0, 0.0}))["signed_errors"];
  const std::vector<double> heights = heights_of_bars(svg);
  ASSERT_EQ(heights.size(), 3U);  // -50 to -45 %, 0 to 5 %, 45 to 50 %
  EXPECT_NEAR(heights[0], 1.0, 0.01);
  EXPECT_NEAR(heights[1], 2.0, 0.01);
  EXPECT_TRUE(holds(svg, "4 volumes: bias +50.50 %, 50.0 % within ±10 %"));
}

// A name that gnuplot takes for two fields.
TEST(EvaluationPlots, ARowThatCannotBeReadIsLeftOut) {
  std::vector<PairRuns> runs = runs_of_volumes({100.0, 101.0});
  PairRuns other = runs[0];
  other.capture = "b";
  other.truth.items[0].name = "\"brown\", rice";
  other.runs[0].items[0].volume_ml = 1000.0;
  runs.push_back(other);
  Plots plots = draw(runs);
  EXPECT_EQ(count_in_curve(plots["volumes"], 5, kDot), 1 + kLegend);
  EXPECT_TRUE(holds(plots["signed_errors"], "2 volumes: bias +0.50 %"));
}

TEST(SvgCheck, FindsFaults) {
  const std::string start = "<?xml version=\"1.0\" encoding=\"utf-8\"?>";
  EXPECT_EQ(find_svg_fault(start + "<svg b=\"c\" e = 'f'><d/>text</svg>\n"), "");
  for (const char* fault : {"<a/>", "<svg>", "<svg></b>", "<svg b=c/>", "<svg>x & y</svg>", "<svg/><svg/>",
                            "<svg b=\"<\"/>", "<svg b='/>", "text", ""})
    EXPECT_NE(find_svg_fault(start + fault), "") << fault;
  EXPECT_NE(find_svg_fault("<svg/>"), "");
}

}  // namespace
}  // namespace traygauge
