// `traygauge evaluate` on the fake estimator: what is measured, what counts as refused, what is written.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/firmware/command_runner.hpp"
#include "tests/firmware/evaluate/search_path.hpp"
#include "tests/firmware/evaluate/svg_check.hpp"
#include "tests/firmware/fake/fake_meal.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::json;

std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// One capture with two pairs; item 2 holds 100 ml, item 3 holds 50 ml.
class EvaluateCommand : public FakeMeal {
 protected:
  EvaluateCommand()
      : FakeMeal(R"({"items": [{"label": 2, "name": "rice", "volume_ml": 100.0},
                               {"label": 3, "name": "peas", "volume_ml": 50.0}], "poses": []})",
                 104.0) {}

  CommandResult evaluate(std::vector<std::string> options) const {
    options.insert(options.begin(), {"evaluate", files_.folder().string(), "--runs", "3"});
    const bool has_config = std::find(options.begin(), options.end(), "--config") != options.end();
    // Beside a test's program lies none.
    if (!has_config) options.insert(options.end(), {"--config", TRAYGAUGE_SOURCE_DIR "/config"});
    return run(options);
  }

  Json evaluate_json() const {
    const CommandResult result = evaluate({"--json"});
    EXPECT_EQ(result.error, "");
    return Json::parse(result.out);
  }

  TemporaryFolder out_;
};

TEST_F(EvaluateCommand, MeasuresEveryPairWithEverySeed) {
  const CommandResult result = evaluate({});
  EXPECT_EQ(result.status, 0) << result.error;
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(fake_estimator().estimates, 6);
  EXPECT_EQ(fake_estimator().seed, 3U);
  EXPECT_NE(result.out.find("1 captures (0 skipped), 2 pairs, 3 seeds each, 6 measurements"),
            std::string::npos)
      << result.out;
}

TEST_F(EvaluateCommand, AnItemWithoutVolumeIsARefusal) {
  items_[1].status = StatusCode::item_hidden;
  answer(StatusCode::partial);
  const Json document = evaluate_json();
  const Json& foods = document["groups"]["foods"];
  EXPECT_EQ(foods["items"], 1);
  EXPECT_EQ(foods["items_tried"], 2);
  EXPECT_EQ(foods["estimates"], 6);
  EXPECT_EQ(foods["refused"], 6);
  EXPECT_NEAR(foods["mape_percent"], 4.0, 1e-12);
  EXPECT_NEAR(foods["mape_refusals_as_100_percent"], 52.0, 1e-12);
  ASSERT_EQ(document["refusals"].size(), 1U);
  EXPECT_EQ(document["refusals"].begin().value(), 6);
  EXPECT_NE(document["refusals"].begin().key().find(": item 3 item_hidden"), std::string::npos);
}

TEST_F(EvaluateCommand, AnItemThatIsNotReportedIsARefusal) {
  items_.pop_back();
  answer(StatusCode::ok);
  const Json document = evaluate_json();
  EXPECT_EQ(document["groups"]["foods"]["refused"], 6);
  EXPECT_NE(document["refusals"].begin().key().find(": item 3 not_reported"), std::string::npos);
}

TEST_F(EvaluateCommand, AFailedMeasurementRefusesAllItems) {
  items_.clear();
  answer(StatusCode::card_not_found);
  const CommandResult result = evaluate({"--json"});
  EXPECT_EQ(result.status, 1);
  const Json document = Json::parse(result.out);
  EXPECT_EQ(document["groups"]["foods"]["refused"], 12);
  EXPECT_EQ(document["groups"]["foods"]["mape_refusals_as_100_percent"], 100.0);
  EXPECT_TRUE(document["groups"]["foods"]["mape_percent"].is_null());
  EXPECT_EQ(document["refusals"].begin().value(), 6) << "measurements";
}

TEST_F(EvaluateCommand, SigmaReachesTheFigures) {
  items_[0].sigma_ml = 2.0;  // the error is 4 ml
  items_[1].sigma_ml = 1.0;
  answer(StatusCode::ok);
  const Json sigma = evaluate_json()["groups"]["foods"]["sigma"];
  EXPECT_EQ(sigma["within_two_sigma_percent"], 100.0);
  items_[0].sigma_ml = 1.9;
  EXPECT_EQ(evaluate_json()["groups"]["foods"]["sigma"]["within_two_sigma_percent"], 50.0);
}

TEST_F(EvaluateCommand, WritesFilesThatParse) {
  const auto folder = out_.path() / "new" / "it's a \"folder\"";
  const CommandResult result = evaluate({"--out", folder.string()});
  ASSERT_EQ(result.status, 0) << result.error;
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(count_lines(read_text(folder / "estimates.csv")), 13U);
  EXPECT_EQ(count_lines(read_text(folder / "pairs.csv")), 5U);
  EXPECT_EQ(count_lines(read_text(folder / "runs.csv")), 7U);
  EXPECT_EQ(count_lines(read_text(folder / "items.csv")), 3U);
  EXPECT_EQ(count_lines(read_text(folder / "captures.csv")), 3U);
  EXPECT_EQ(Json::parse(read_text(folder / "summary.json"))["profile"], "best");
  for (const char* plot : {"signed_errors.svg", "variation.svg", "error_by_angle.svg", "volumes.svg"})
    EXPECT_EQ(find_svg_fault(read_text(folder / plot)), "") << plot;
  EXPECT_EQ(count_in_curve(read_text(folder / "volumes.svg"), 5, "'#gpPt6'"), 4U + 1U);
}

TEST_F(EvaluateCommand, WithoutGnuplotAllButThePlotsIsWritten) {
  const SearchPath nothing_there(out_.path());
  const CommandResult result = evaluate({"--json", "--out", out_.path().string()});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.error, "no plots: gnuplot is not installed; install the package gnuplot-nox\n");
  EXPECT_EQ(Json::parse(result.out)["measurements"], 6);
  EXPECT_EQ(count_lines(read_text(out_.path() / "pairs.csv")), 5U);
  for (const auto& entry : std::filesystem::directory_iterator(out_.path()))
    EXPECT_NE(entry.path().extension(), ".svg");
}

// A site's own plots come before those of the program.
TEST_F(EvaluateCommand, APlotThatFailsIsSaidAfterTheResults) {
  const auto plots = out_.path() / "config" / "plots";
  std::filesystem::create_directories(plots);
  write_text(plots / "common.gp", "");
  write_text(plots / "signed_errors.gp", "plot no_such_variable\n");
  const auto folder = out_.path() / "folder";
  const CommandResult result = evaluate({"--out", folder.string(), "--config", plots.parent_path().string()});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(count_lines(result.error), 1U) << result.error;
  EXPECT_NE(result.error.find("signed_errors.svg: not drawn: gnuplot failed"), std::string::npos)
      << result.error;
  EXPECT_NE(result.error.find("no_such_variable"), std::string::npos) << result.error;
  EXPECT_NE(result.out.find("6 measurements"), std::string::npos) << result.out;
  EXPECT_EQ(count_lines(read_text(folder / "estimates.csv")), 13U);
}

// 2 pairs with 3 seeds, then once for each of 7 variants; the fake estimator shows no stage.
TEST_F(EvaluateCommand, StagesMeasureEveryPairOnceAVariant) {
  write_truth(R"({"items": [{"label": 2, "name": "rice", "volume_ml": 100.0},
                            {"label": 3, "name": "peas", "volume_ml": 50.0}],
                  "poses": [[[1,0,0,0],[0,-1,0,0],[0,0,-1,400],[0,0,0,1]],
                            [[1,0,0,9],[0,-1,0,0],[0,0,-1,400],[0,0,0,1]],
                            [[1,0,0,0],[0,-1,0,9],[0,0,-1,400],[0,0,0,1]]]})");
  const CommandResult result = evaluate({"--stages", "--out", out_.path().string()});
  EXPECT_EQ(result.status, 0) << result.error;
  EXPECT_EQ(fake_estimator().estimates, 2 * (3 + 7));
  EXPECT_EQ(fake_estimator().seed, 1U);
  const std::string stages = read_text(out_.path() / "stages.csv");
  EXPECT_EQ(count_lines(stages), 5U);
  EXPECT_NE(
      stages.find(",2,rice,heightfield,100.000,104.000,104.000,104.000,104.000,104.000,104.000,104.000\n"),
      std::string::npos)
      << stages;
  EXPECT_EQ(count_lines(read_text(out_.path() / "heights.csv")), 1U) << "no surface was seen";
}

TEST_F(EvaluateCommand, StagesNeedPoses) {
  const CommandResult result = evaluate({"--stages", "--out", out_.path().string()});
  EXPECT_EQ(result.status, 0) << result.error;
  EXPECT_EQ(fake_estimator().estimates, 6) << "the usual ones";
  EXPECT_NE(read_text(out_.path() / "stages.csv").find(",2,rice,heightfield,100.000,,,,,,,\n"),
            std::string::npos);
}

TEST_F(EvaluateCommand, ATrayIsSkippedByAProfileThatMeasuresOneDish) {
  Json dish = files_.document["dish"];
  files_.document.erase("dish");
  dish["label"] = 1;
  Json other = dish;
  other["label"] = 201;
  files_.document["dishes"] = {dish, other};
  files_.store();
  const CommandResult result = evaluate({"--profile", "paper"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(fake_estimator().estimates, 0);
  EXPECT_NE(result.out.find("0 captures (1 skipped)"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("several dishes; profile paper measures one"), std::string::npos) << result.out;
}

TEST_F(EvaluateCommand, ACaptureWithoutTruthIsSkipped) {
  std::filesystem::remove(files_.file("truth.json"));
  const CommandResult result = evaluate({});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("no truth.json"), std::string::npos) << result.out;
}

TEST_F(EvaluateCommand, WrongUseIsNamed) {
  write_text(out_.path() / "file", "");
  for (const auto& [options, text] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--profile", "worst"}, "--profile"},
           {{"--labels", "none"}, "--labels"},
           {{"--jobs", "0"}, "--jobs"},
           {{"--stages", "--profile", "paper"}, "leave --profile paper out"},
           {{"--stages", "--json"}, "name a folder with --out instead of --json"},
           {{"--out", (out_.path() / "file").string()}, "file"},
           {{"--out", (out_.path() / "file" / "below").string()}, "below"}}) {
    const CommandResult result = evaluate(options);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(count_lines(result.error), 1U) << result.error;
    EXPECT_NE(result.error.find(text), std::string::npos) << result.error;
  }
  EXPECT_EQ(fake_estimator().estimates, 0);
  EXPECT_EQ(run({"evaluate", out_.path().string()}).status, 2) << "no captures there";
}

}  // namespace
}  // namespace traygauge
