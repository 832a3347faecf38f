// Rendered meals are what they say: pictures, poses, labels and volumes fit each other, by a measurement that
// knows nothing of the renderer.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/evaluate/accuracy.hpp"
#include "firmware/evaluate/stage_analysis.hpp"
#include "simulator/scenes/capture_writer.hpp"
#include "simulator/scenes/scene_sets.hpp"
#include "tests/evaluation/tables/tables_command.hpp"
#include "tests/firmware/command_runner.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kAsMeasured = 0;
constexpr std::size_t kAllTrue = kStageVariants - 1;

// The first two views of one of a set's reduced scenes.
void render_pair(const char* set, const char* name, const std::filesystem::path& folder,
                 std::uint64_t seed = 1) {
  for (SceneDescription& scene : make_scenes(set, seed, SetSize::reduced)) {
    if (scene.name != name) continue;
    scene.views.resize(2);
    scene.pairs = {{0, 1}};
    render_capture(scene, folder / name, {}, [](double) {});
    return;
  }
  FAIL() << set << " has no reduced scene " << name;
}

struct Bounds {  // per cent
  double mape;
  double bias;
  double worst;
};
// Measured on these five foods in small pictures: MAPE 2.8, bias -0.2, worst -3.8. Half as much again, and
// for the bias a third of the MAPE, is left for what another compiler or a better stage may change.
constexpr Bounds kAsMeasuredBounds{4.2, 1.5, 7.0};
// With all stages true 0.8, -0.2 and -1.3: what remains are flanks that no view sees, and the renderer.
constexpr Bounds kAllTrueBounds{1.3, 0.8, 2.5};

void expect_within(const std::vector<PairRuns>& runs, const Bounds& most, const char* what) {
  const SetFigures figures = set_figures(collect_series(runs, TruthVolume::above_dish, false));
  EXPECT_EQ(figures.items, 5) << what;
  EXPECT_EQ(figures.refused, 0) << what;
  EXPECT_LE(figures.mape, most.mape) << what;
  EXPECT_LE(std::abs(figures.bias), most.bias) << what;
  EXPECT_LE(std::abs(figures.worst), most.worst) << what;
}

void expect_tables(const std::string& folder, const std::string& cache) {
  const std::array<const char*, 8> arguments = {"traygauge-paper-tables",
                                                "table-2",
                                                "--meals",
                                                folder.c_str(),
                                                "--cache",
                                                cache.c_str(),
                                                "--runs",
                                                "1"};
  std::ostringstream out;
  std::ostringstream error;
  EXPECT_EQ(tables::run_tables_command(static_cast<int>(arguments.size()), arguments.data(), out, error), 0)
      << error.str();
  for (const char* part : {"ORB  ", "SIFT  ", "SURF  ", "shared"})
    EXPECT_NE(out.str().find(part), std::string::npos) << out.str();
}

// Two sets; each further scene costs as much as all measurements together.
TEST(RenderedMeal, IsMeasuredAndItsTruthFitsItsPictures) {
  const TemporaryFolder folder;
  const TemporaryFolder cache;
  render_pair("meals-45", "m02", folder.path());
  render_pair("plates-18", "c01_oval", folder.path());
  std::vector<std::string> skipped;
  const StageRuns runs = run_stages(folder.path(), {}, skipped, [](std::size_t, std::size_t) {});
  EXPECT_TRUE(skipped.empty());
  ASSERT_EQ(runs.variants[kAsMeasured].size(), 2U);
  expect_within(runs.variants[kAsMeasured], kAsMeasuredBounds, "as measured");
  expect_within(runs.variants[kAllTrue], kAllTrueBounds, "all stages true");
  expect_tables(folder.path().string(), cache.path().string());
}

// The small picture of a card tells the table's slope roughly: where it says that the dishes lie, one would
// be 2.2 mm too high. Their rims, read in the same pictures, know better.
TEST(RenderedTray, DishesThatWereFoundStandAsHighAsDescribed) {
  constexpr double kMostOff_mm = 0.8;
  const TemporaryFolder folder;
  render_pair("station-40", "k02", folder.path(), 108);
  const CommandResult result =
      run({"measure", (folder.path() / "k02").string(), "--labels", "auto", "--json"});
  ASSERT_EQ(result.status, 0) << result.error;
  int dishes = 0;
  const nlohmann::json document = nlohmann::json::parse(result.out);
  for (const nlohmann::json& check : document.at("checks")) {
    if (check.at("name").get<std::string>() != "dish_height_mm") continue;
    ++dishes;
    EXPECT_LE(std::abs(check.at("value").get<double>()), kMostOff_mm) << check;
  }
  EXPECT_EQ(dishes, 2);
}

}  // namespace
}  // namespace traygauge
