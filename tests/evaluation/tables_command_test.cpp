// `traygauge-paper-tables` on the fake estimator: what is measured, kept, printed and refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/evaluation/tables/paper_tables.hpp"
#include "tests/evaluation/tables/tables_command.hpp"
#include "tests/firmware/evaluate/search_path.hpp"
#include "tests/firmware/evaluate/svg_check.hpp"
#include "tests/firmware/fake/fake_meal.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge::tables {
namespace {

namespace fs = std::filesystem;

struct CommandResult {
  int status = 0;
  std::string out;
  std::string error;
};

CommandResult run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "traygauge-paper-tables");
  std::vector<const char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  std::ostringstream out;
  std::ostringstream error;
  const int status = run_tables_command(static_cast<int>(pointers.size()), pointers.data(), out, error);
  return {status, out.str(), error.str()};
}

constexpr int kPairs = 2;     // of the capture
constexpr int kVariants = 5;  // of Table IV

class TablesCommand : public FakeMeal {
 protected:
  TablesCommand()
      : FakeMeal(R"({"items": [
          {"label": 2, "name": "rice", "volume_ml": 100.0, "volume_above_bottom_plane_ml": 200.0},
          {"label": 3, "name": "peas", "volume_ml": 50.0, "volume_above_bottom_plane_ml": 50.0}], "poses": []})",
                 208.0) {}

  CommandResult table(const std::string& name, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {name, "--meals", files_.folder().string()};
    const auto names = [&](const char* option) {
      return std::find(more.begin(), more.end(), option) != more.end();
    };
    if (!names("--cache")) arguments.insert(arguments.end(), {"--cache", cache_.path().string()});
    if (!names("--runs")) arguments.insert(arguments.end(), {"--runs", "2"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  CommandResult report(const fs::path& out) const {
    return run({"report", "--out", out.string(), "--meals", files_.folder().string(), "--cache",
                cache_.path().string(), "--runs", "1", "--pairs", "1"});
  }

  // Measurements that the command made.
  int measured(const std::string& name, std::vector<std::string> more = {}) const {
    fake_estimator().estimates = 0;
    const CommandResult result = table(name, std::move(more));
    EXPECT_EQ(result.status, 0) << result.error;
    return fake_estimator().estimates;
  }

  std::vector<fs::path> stored() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(cache_.path())) files.push_back(entry.path());
    return files;
  }

  TemporaryFolder cache_;
};

TEST_F(TablesCommand, PrintsThePapersFiguresBesideOurs) {
  const CommandResult result = table("table-4");
  EXPECT_EQ(result.status, 0) << result.error;
  // 4 % and 0 % above the plane of the bottom; 250 ms.
  EXPECT_NE(
      result.out.find("2^13 points                                8.8     6.0    2.00   +2.00   0.250     0.0"
                      "    2.00       2       2\n"),
      std::string::npos)
      << result.out;
}

// Rice is 4 % too high over the plane, 108 % over the dish; the fake gives all rows the same.
TEST_F(TablesCommand, PrintsBothTruthsAndTheDifferenceToTheReference) {
  const CommandResult result = table("table-4");
  EXPECT_NE(result.out.find("the difference (95 %) to \"2^12 points\" on the items that both measured\n"),
            std::string::npos)
      << result.out;
  EXPECT_NE(
      result.out.find("2^13 points                               2.00   54.00    0.00       –       –    0.00"
                      "       –       –       2\n"),
      std::string::npos)
      << result.out;
  EXPECT_NE(
      result.out.find("2^12 points                               2.00   54.00       –       –       –       –"
                      "       –       –       –\n"),
      std::string::npos)
      << result.out;
}

TEST_F(TablesCommand, ChangesPicturesTheSameWayEveryTime) {
  const std::vector<std::string> worse = {"--noise-grey", "5", "--local-tone"};
  EXPECT_EQ(measured("table-4"), kVariants * kPairs * 2);
  EXPECT_EQ(measured("table-4", worse), kVariants * kPairs * 2);
  EXPECT_EQ(measured("table-4", worse), 0);
  EXPECT_EQ(measured("table-4", {"--noise-grey", "6"}), kVariants * kPairs * 2);
  EXPECT_EQ(table("table-4", {"--noise-grey", "-1"}).status, 2);
}

TEST_F(TablesCommand, NamesTheProgramInItsResults) {
  ASSERT_EQ(measured("table-4"), kVariants * kPairs * 2);
  const std::string result = read_text(stored().front());
  for (const char* part : {"core ", "firmware ", "simulator ", "methods ", "OpenCV " CV_VERSION})
    EXPECT_NE(result.find(part), std::string::npos) << part;
}

TEST_F(TablesCommand, CountsRefusals) {
  items_[1].status = StatusCode::item_hidden;
  answer(StatusCode::partial);
  const CommandResult result = table("table-4");
  EXPECT_NE(result.out.find("4.00   +4.00   0.250    50.0   52.00"), std::string::npos) << result.out;
}

TEST_F(TablesCommand, SaysWhenNothingCouldBeMeasured) {
  answer(StatusCode::card_not_found);
  for (ItemResult& item : items_) item.status = StatusCode::card_not_found;
  EXPECT_EQ(table("table-4").status, 1);
}

TEST_F(TablesCommand, MeasuresOnceAndKeepsTheResults) {
  EXPECT_EQ(measured("table-4"), kVariants * kPairs * 2);
  const std::string first = table("table-4").out;
  EXPECT_EQ(measured("table-4"), 0);
  EXPECT_EQ(table("table-4").out, first);
  EXPECT_EQ(measured("table-1", {"--pairs", "1"}), 8 * 2)
      << "eight of the nine rows; one is what Table IV measured";
  EXPECT_EQ(stored().size(), static_cast<std::size_t>(kVariants * kPairs + 8));
}

TEST_F(TablesCommand, GoesOnWhereItWasStopped) {
  ASSERT_EQ(measured("table-4"), kVariants * kPairs * 2);
  fs::remove(stored().front());
  EXPECT_EQ(measured("table-4"), 2);
  EXPECT_EQ(measured("table-4", {"--runs", "3"}), kVariants * kPairs) << "the third seed of each pair";
  EXPECT_EQ(measured("table-4"), 0) << "fewer seeds are there";
}

TEST_F(TablesCommand, MeasuresAgainWhatCannotBeRead) {
  ASSERT_EQ(measured("table-4"), kVariants * kPairs * 2);
  const fs::path file = stored().front();
  const std::string whole = read_text(file);
  for (const std::string& damaged : {whole.substr(0, whole.size() / 2), std::string(), std::string("[1, 2]"),
                                     std::string(R"({"key": "another", "runs": []})")}) {
    write_text(file, damaged);
    EXPECT_EQ(measured("table-4"), 2) << damaged;
    EXPECT_EQ(read_text(file), whole);
  }
}

TEST_F(TablesCommand, MeasuresAgainWhenTheCaptureChanges) {
  ASSERT_EQ(measured("table-4"), kVariants * kPairs * 2);
  cv::imwrite(files_.file("view_0.jpg").string(), draw_noise(320, 240, CV_8UC3, 77));
  EXPECT_EQ(measured("table-4"), kVariants * 2) << "the pair of view 0";
  cv::imwrite(files_.file("labels_2.png").string(), draw_labels(320, 240) & 254);
  EXPECT_EQ(measured("table-4"), kVariants * 2) << "the pair of view 2";
  files_.document["dish"]["bottom_height_mm"] = 4.6;
  files_.document["dish"]["profile"][2][1] = 4.6;
  files_.store();
  EXPECT_EQ(measured("table-4"), kVariants * kPairs * 2);
  write_text(files_.file("truth.json"),
             R"({"items": [{"label": 2, "name": "rice", "volume_ml": 104.0}], "poses": []})");
  EXPECT_EQ(measured("table-4"), 0) << "no measurement depends on the truth";
  EXPECT_NE(table("table-4").out.find("100.00 +100.00"), std::string::npos) << "but its figures do";
}

TEST_F(TablesCommand, WritesAReport) {
  TemporaryFolder out;
  nlohmann::json truth = nlohmann::json::parse(read_text(files_.file("truth.json")));
  truth["origin"] = "meals-45, seed 7";
  write_truth(truth.dump());
  fs::create_directory(files_.file("bare"));  // a capture without truth
  for (const auto& entry : fs::directory_iterator(files_.folder())) {
    if (entry.is_regular_file() && entry.path().filename() != "truth.json")
      fs::copy(entry.path(), files_.file("bare"));
  }
  const CommandResult result =
      run({"report", "--out", out.path().string(), "--meals", files_.folder().string(), "--plates",
           files_.folder().string(), "--cache", cache_.path().string(), "--runs", "1", "--pairs", "1"});
  EXPECT_EQ(result.status, 0) << result.error;
  EXPECT_NE(result.error.find("angles-13"), std::string::npos) << result.error;
  const std::string report = read_text(out.path() / "report.md");
  for (const Table& own : paper_tables()) {
    if (own.command == "table-5") continue;  // its set was not named
    EXPECT_NE(report.find("## " + own.title), std::string::npos) << own.title;
    EXPECT_EQ(find_svg_fault(read_text(out.path() / (own.command + ".svg"))), "") << own.command;
  }
  EXPECT_EQ(report.find("Table V."), std::string::npos);
  for (const char* part : {"meals-45: `", "1 captures, 1 of 2 pairs; 1 of origin “meals-45, seed 7”",
                           "Seeds 1 to 1 of each pair", "noise 0 grey values", "core ", "OpenCV ",
                           "`--jobs 1`", "Left out: bare: no truth.json"})
    EXPECT_NE(report.find(part), std::string::npos) << part << "\n" << report;
  for (const char* plot : {"paper/signed_errors.svg", "best/volumes.svg"}) {
    EXPECT_EQ(find_svg_fault(read_text(out.path() / plot)), "") << plot;
    EXPECT_NE(report.find("](" + std::string(plot) + ")"), std::string::npos) << plot;
  }
}

// Rows with a number as a curve, others below each other by their titles.
TEST_F(TablesCommand, DrawsEveryRowWhereThereIsGnuplot) {
  const TemporaryFolder out;
  CommandResult result = report(out.path());
  EXPECT_EQ(result.status, 0) << result.error;
  const std::string meshes = read_text(out.path() / "table-4.svg");
  for (const int curve : {1, 2})  // the paper's and ours
    EXPECT_EQ(count_in_curve(meshes, curve, "<use"), std::size_t{kVariants} + 1) << curve;
  const std::string poses = read_text(out.path() / "table-3.svg");
  EXPECT_EQ(count_in_curve(poses, 2, "<use"), 6U + 1U);
  EXPECT_NE(poses.find(">RANSAC, LO, adaptive [30], LM<"), std::string::npos);

  const SearchPath nothing_there(out.path());
  result = report(out.path());
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.error.find("no plots: gnuplot is not installed"), std::string::npos) << result.error;
  EXPECT_EQ(result.error.find("no plots: "), result.error.rfind("no plots: ")) << "once: " << result.error;
  EXPECT_FALSE(fs::exists(out.path() / "table-4.svg"));
  EXPECT_TRUE(fs::exists(out.path() / "table-4.csv"));
}

TEST_F(TablesCommand, RefusesWrongUse) {
  const std::string meals = files_.folder().string();
  struct Case {
    std::vector<std::string> arguments;
    const char* named;  // in the message
  };
  for (const Case& own : std::vector<Case>{{{}, "subcommand"},
                                           {{"table-8", "--meals", meals}, "table-8"},
                                           {{"table-4"}, "meals-45"},
                                           {{"table-4", "--meals", "/absent"}, "--meals /absent"},
                                           {{"table-4", "--sets", "/absent"}, "--sets /absent"},
                                           {{"table-5", "--meals", meals}, "angles-13"},
                                           {{"table-4", "--meals", meals, "--runs", "0"}, "runs"},
                                           {{"table-4", "--meals", meals, "--pairs", "many"}, "pairs"},
                                           {{"table-4", "--meals", cache_.path().string()}, "captures"},
                                           {{"report", "--meals", meals}, "--out"},
                                           {{"report", "--out", cache_.path().string()}, "--sets"}}) {
    const CommandResult result = run(own.arguments);
    EXPECT_EQ(result.status, 2) << own.named;
    EXPECT_NE(result.error.find(own.named), std::string::npos) << result.error;
    EXPECT_EQ(result.out, "");
  }
  write_text(cache_.path() / "file", "");
  EXPECT_EQ(table("table-4", {"--cache", (cache_.path() / "file").string()}).status, 2);
}

}  // namespace
}  // namespace traygauge::tables
