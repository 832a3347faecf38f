#include "firmware/simulate/simulate_command.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "simulator/capture/capture.hpp"
#include "simulator/scenes/scene_file.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

struct Result {
  int status = 0;
  std::string out;
  std::string error;
};

Result simulate(const std::vector<std::string>& arguments) {
  std::vector<const char*> pointers = {"traygauge-simulate"};
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  std::ostringstream out;
  std::ostringstream error;
  const int status = run_simulate(static_cast<int>(pointers.size()), pointers.data(), out, error);
  return {status, out.str(), error.str()};
}

std::filesystem::path example() {
  return std::filesystem::path(TRAYGAUGE_SOURCE_DIR) / "config/scenes/example.toml";
}

TEST(SimulateCommand, ListsTheSets) {
  const Result result = simulate({"list"});
  EXPECT_EQ(result.status, 0);
  for (const char* set : {"meals-45", "angles-13", "plates-18", "meals-14", "trays-8", "moved-4"})
    EXPECT_NE(result.out.find(set), std::string::npos) << set;
}

TEST(SimulateCommand, TellsWhatIsWrong) {
  const TemporaryFolder folder;
  write_text(folder.path() / "a.toml", "sead = 1\n");
  write_text(folder.path() / "file", "");
  const std::string out = folder.path().string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{"render", "meals-46", "--out", out}, "meals-46"},
      {{"render", "meals-45"}, "--out"},
      {{"render", "meals-45", "--out", out, "--only", "m99"}, "m99"},
      {{"render", "meals-45", "--out", out, "--samples", "1"}, "--samples"},
      {{"render", "meals-45", "--out", out, "--quick", "--reduced"}, "--quick"},
      {{"render", example().string(), "--out", out, "--quick"}, "--quick"},
      {{"render", (folder.path() / "b.toml").string(), "--out", out}, "b.toml"},
      {{"render", (folder.path() / "a.toml").string(), "--out", out}, "sead"},
      {{"render", example().string(), "--out", (folder.path() / "file").string()}, "file"},
      {{}, "--help"},
  };
  for (const auto& [arguments, named] : mistakes) {
    const Result result = simulate(arguments);
    EXPECT_EQ(result.status, 2) << named;
    EXPECT_NE(result.error.find(named), std::string::npos) << named << ": " << result.error;
  }
}

void replace_first(std::string& text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
}

// The example in pictures of a tenth of its size.
std::string small_scene() {
  std::string scene = read_text(example());
  replace_first(scene, "width = 1600", "width = 160");
  replace_first(scene, "height = 1200", "height = 120");
  replace_first(scene, "fx = 1400.0", "fx = 140.0");
  replace_first(scene, "../dishes/dinner.toml", TRAYGAUGE_SOURCE_DIR "/config/dishes/dinner.toml");
  return scene;
}

TEST(SimulateCommand, BareDishesShowTheDishWhereFoodWas) {
  const TemporaryFolder folder;
  write_text(folder.path() / "scene.toml", small_scene());
  std::vector<std::string> command = {"render", (folder.path() / "scene.toml").string(), "--kinds", "--out",
                                      (folder.path() / "served").string()};
  ASSERT_EQ(simulate(command).status, 0);
  command.back() = (folder.path() / "bare").string();
  command.emplace_back("--bare");
  ASSERT_EQ(simulate(command).status, 0);
  for (const char* view : {"kinds_0.png", "kinds_1.png"}) {
    const cv::Mat1b served = cv::imread(folder.path() / "served/example" / view, cv::IMREAD_GRAYSCALE);
    const cv::Mat1b bare = cv::imread(folder.path() / "bare/example" / view, cv::IMREAD_GRAYSCALE);
    ASSERT_EQ(served.size(), cv::Size(160, 120));
    ASSERT_EQ(bare.size(), served.size());
    const cv::Mat food = served == 2;
    EXPECT_GT(cv::countNonZero(food), 100);
    EXPECT_EQ(cv::countNonZero(bare == 2), 0);
    EXPECT_EQ(cv::countNonZero(((bare == 3) | (bare == 4)) & food), cv::countNonZero(food));
    EXPECT_EQ(cv::countNonZero((bare != served) & ~food), 0);
  }
}

TEST(SimulateCommand, KeepsCapturesThatAreComplete) {
  const TemporaryFolder folder;
  std::string scene = small_scene();
  write_text(folder.path() / "scene.toml", scene);
  const std::vector<std::string> command = {"render", (folder.path() / "scene.toml").string(), "--out",
                                            folder.path().string()};
  const Result first = simulate(command);
  EXPECT_EQ(first.status, 0) << first.error;
  EXPECT_NE(first.out.find("1 captures rendered"), std::string::npos) << first.out;
  EXPECT_EQ(read_capture(folder.path() / "example").views.size(), 2U);
  const Result second = simulate(command);
  EXPECT_NE(second.out.find("1 were complete already"), std::string::npos) << second.out;
  // Another scene of that name is not taken for it.
  replace_first(scene, "seed = 12", "seed = 13");
  write_text(folder.path() / "scene.toml", scene);
  const Result changed = simulate(command);
  EXPECT_NE(changed.out.find("1 captures rendered"), std::string::npos) << changed.out;
}

TEST(SimulateCommand, ExampleSceneIsRead) {
  const SceneDescription scene = read_scene_file(example());
  EXPECT_EQ(scene.foods.size(), 2U);
  EXPECT_EQ(scene.views.size(), 2U);
}

}  // namespace
}  // namespace traygauge
