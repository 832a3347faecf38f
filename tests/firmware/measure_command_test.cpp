// `traygauge measure`: options, exit statuses, what reaches the estimator, what reaches the caller.
#include "firmware/measure/measure_command.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "firmware/command/command_line.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "tests/firmware/command_runner.hpp"
#include "tests/firmware/fake/fake_estimator.hpp"
#include "tests/firmware/fake/synthetic_scene.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::json;

class MeasureCommand : public testing::Test {
 protected:
  MeasureCommand() : scene_(TemporaryCapture::kWidth, TemporaryCapture::kHeight) {
    fake_estimator() = {};
    fake_estimator().measurement = scene_.measurement();
    fake_estimator().pictures = scene_.pictures();
  }

  CommandResult measure(std::vector<std::string> options) const {
    options.insert(options.begin(), {"measure", files_.folder().string()});
    return run(options);
  }

  // Wrong use: exit status 2, nothing on standard output, one line that holds `text`.
  void expect_wrong_use(const std::vector<std::string>& options, const std::string& text) const {
    std::vector<std::string> with_json = options;
    with_json.emplace_back("--json");
    for (const auto& variant : {options, with_json}) {
      const CommandResult result = measure(variant);
      EXPECT_EQ(result.status, 2) << text;
      EXPECT_EQ(result.out, "");
      EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
      EXPECT_NE(result.error.find(text), std::string::npos) << result.error;
    }
    EXPECT_EQ(fake_estimator().estimates, 0);
  }

  TemporaryCapture files_;
  SyntheticScene scene_;
};

TEST_F(MeasureCommand, GivesTheCaptureToTheEstimator) {
  const CommandResult result = measure({"--pair", "1,2", "--seed", "18446744073709551615"});
  EXPECT_EQ(result.status, 0) << result.error;
  EXPECT_EQ(result.error, "");
  const FakeEstimator& fake = fake_estimator();
  EXPECT_EQ(fake.seed, 18446744073709551615ULL);
  EXPECT_EQ(fake.limits.max_frame_width, 320);
  EXPECT_EQ(fake.limits.max_frame_height, 240);
  EXPECT_EQ(fake.lens.pinhole.fx_px, 300.0);
  EXPECT_EQ(fake.card.thickness_mm, 0.8);
  EXPECT_EQ(fake.card.pattern.width, 160);
  ASSERT_EQ(fake.dishes.size(), 1U);
  EXPECT_EQ(fake.dishes[0].rim_height_mm, 22.0);
  ASSERT_EQ(fake.dishes[0].profile().size(), 3U);
  EXPECT_EQ(fake.dishes[0].profile()[2].inset_mm, 49.0);
  EXPECT_EQ(fake.dishes[0].profile()[1].height_mm, 22.0);
  ASSERT_EQ(fake.views.size(), 2U);
  EXPECT_EQ(fake.views[0].arm_angle_deg, 18.0);
  EXPECT_FALSE(fake.views[1].arm_angle_deg.has_value());
  EXPECT_FALSE(fake.views[1].lens.has_value());
  EXPECT_EQ(fake.views[1].frame.format, PixelFormat::rgb8);
}

TEST_F(MeasureCommand, AViewMayHaveACameraOfItsOwn) {
  files_.document["views"][1]["camera"] = files_.document["camera"];
  files_.document["views"][1]["camera"]["fy"] = 280.0;
  files_.store();
  ASSERT_EQ(measure({}).status, 0);
  EXPECT_FALSE(fake_estimator().views[0].lens.has_value());
  ASSERT_TRUE(fake_estimator().views[1].lens.has_value());
  EXPECT_EQ(fake_estimator().views[1].lens->pinhole.fy_px, 280.0);
}

TEST_F(MeasureCommand, WithoutADishEveryDishOfTheSiteIsACandidate) {
  files_.document.erase("dish");
  files_.store();
  const CommandResult result = measure({"--config", TRAYGAUGE_SOURCE_DIR "/config"});
  ASSERT_EQ(result.status, 0) << result.error;
  ASSERT_EQ(fake_estimator().dishes.size(), 3U);
  EXPECT_EQ(fake_estimator().dishes[1].outer_size_mm[1], 210.0);  // dinner, oval, soup
}

TEST_F(MeasureCommand, BadDishFilesAreNamed) {
  files_.document.erase("dish");
  files_.store();
  const auto dishes = files_.file("config") / "dishes";
  expect_wrong_use({"--config", files_.file("config").string()}, "expected a folder");
  std::filesystem::create_directories(dishes);
  expect_wrong_use({"--config", files_.file("config").string()}, "expected a *.toml");
  const std::string good = read_text(TRAYGAUGE_SOURCE_DIR "/config/dishes/soup.toml");
  for (const auto& [text, problem] :
       std::vector<std::pair<std::string, std::string>>{{good + "rim_hight_mm = 3\n", "rim_hight_mm"},
                                                        {"rim_height_mm = [", "line 1"},
                                                        {"rim_height_mm = 3.0", "outer_size_mm"},
                                                        {"outer_size_mm = [nan, 3.0]", "outer_size_mm[0]"},
                                                        {"style = 1979-05-27", "style"}}) {
    write_text(dishes / "a.toml", text);
    expect_wrong_use({"--config", files_.file("config").string()}, problem);
  }
}

TEST_F(MeasureCommand, ThePairIsTypedOrTheFirstOrZeroAndOne) {
  EXPECT_EQ(Json::parse(measure({"--json", "--pair", "2,0"}).out)["pair"], Json({2, 0}));
  files_.document["pairs"] = {{2, 1}, {0, 1}};
  files_.store();
  EXPECT_EQ(Json::parse(measure({"--json"}).out)["pair"], Json({2, 1}));
  files_.document.erase("pairs");
  files_.store();
  EXPECT_EQ(Json::parse(measure({"--json"}).out)["pair"], Json({0, 1}));
}

TEST_F(MeasureCommand, WrongOptionsAreNamed) {
  for (const char* pair : {"0", "0,", ",1", "0,3", "-1,0", "a,b", "0,1,2", "0;1", "0, 1", "0,99999999999"}) {
    expect_wrong_use({"--pair", pair}, "--pair");
  }
  for (const char* seed : {"-1", "1.5", "x", "18446744073709551616", "1 "})
    expect_wrong_use({"--seed", seed}, "--seed");
  expect_wrong_use({"--profile", "worst"}, "--profile");
  expect_wrong_use({"--labels", "none"}, "--labels");
  expect_wrong_use({"--unknown"}, "--unknown");
  expect_wrong_use({"second"}, "second");
}

TEST_F(MeasureCommand, WrongCommandsAreNamed) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {}, {"weigh"}, {"measure"}, {"measure", "/absent/folder"}, {"--fast"}}) {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
  EXPECT_EQ(run({"--help"}).status, 0);
  EXPECT_NE(run({"measure", "--help"}).out.find("--pair"), std::string::npos);
}

TEST_F(MeasureCommand, MistypedCommandsAreNamedWithWhatMayHaveBeenMeant) {
  for (const auto& [typed, meant] :
       std::vector<std::pair<std::string, std::string>>{{"mesure", "measure"},
                                                        {"evalute", "evaluate"},
                                                        {"segmetn", "segment"},
                                                        {"calib", "calibrate"},
                                                        {"Station", "station"},
                                                        {"enroldish", "enrol-dish"}}) {
    const CommandResult result = run({typed, files_.folder().string()});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.error, "traygauge: Unknown command " + typed + ": did you mean " + meant + "?\n");
  }
  EXPECT_EQ(run({"config", "chek"}).error, "traygauge: Unknown command chek: did you mean check?\n");
  EXPECT_NE(run({"weigh"}).error.find("Unknown command weigh: expected one of measure, evaluate"),
            std::string::npos);
}

TEST_F(MeasureCommand, HelpThatCannotBeWrittenIsAnError) {
  for (const char* option : {"--help", "--version"}) {
    std::ofstream full("/dev/full");
    if (!full) GTEST_SKIP() << "no /dev/full";
    std::ostringstream error;
    const std::array<const char*, 2> arguments = {"traygauge", option};
    EXPECT_EQ(run_command_line(2, arguments.data(), full, error), 2) << option;
    EXPECT_NE(error.str().find("could not be written"), std::string::npos) << error.str();
  }
}

TEST_F(MeasureCommand, UnusableCapturesAreNamed) {
  files_.document["camera"]["fx"] = 0;
  files_.store();
  expect_wrong_use({}, "camera.fx");
  files_.document["camera"]["fx"] = 300;
  files_.document["views"][1].erase("labels");
  files_.store();
  expect_wrong_use({}, "views[1].labels");
  expect_wrong_use({"--labels", "given"}, "views[1].labels");
  EXPECT_NE(measure({"--labels", "auto"}).status, 2);
  EXPECT_EQ(measure({"--pair", "0,2"}).status, 0);  // the views that are used have labels
  fake_estimator().estimates = 0;
  files_.document["views"] = Json::array({files_.document["views"][0]});
  files_.document.erase("pairs");
  files_.store();
  expect_wrong_use({}, "at least two views");
}

TEST_F(MeasureCommand, ProfilePaperRefusesSeveralDishes) {
  Json dish = files_.document["dish"];
  files_.document.erase("dish");
  dish["label"] = 1;
  files_.document["dishes"] = {dish};
  files_.store();
  EXPECT_EQ(measure({}).status, 0);
  fake_estimator().estimates = 0;
  dish["label"] = 201;
  files_.document["dishes"].push_back(dish);
  files_.store();
  expect_wrong_use({"--profile", "paper"}, "profile paper measures one dish");
}

TEST_F(MeasureCommand, EveryDishOfATrayReachesTheConfigurationWithItsLabel) {
  Json dish = files_.document["dish"];
  files_.document.erase("dish");
  for (const int label : {201, 1, 249}) {
    dish["label"] = label;
    dish.erase("profile");
    dish["rim_height_mm"] = 20.0 + label / 10.0;
    files_.document["dishes"].push_back(dish);
  }
  files_.store();
  const Capture capture = read_capture(files_.folder());
  const PairSetup setup = set_up_pair(capture, {0, 1}, choose_dishes(capture, ""));
  const Configuration configuration = configure(setup);
  ASSERT_EQ(configuration.dishes.size(), 3U);
  EXPECT_EQ(configuration.dishes[0].label, 201);
  EXPECT_EQ(configuration.dishes[1].label, 1);
  EXPECT_EQ(configuration.dishes[2].label, 249);
  EXPECT_EQ(configuration.dishes[2].rim_height_mm, 44.9);
}

TEST_F(MeasureCommand, ProfilesThatDoNotFitAreRefusedNotCut) {
  Json& profile = files_.document["dish"]["profile"];
  profile = Json::array();
  for (int i = 0; i < 33; ++i) profile.push_back({1.5 * i, 22.0 - 17.5 * i / 32.0});
  files_.store();
  expect_wrong_use({}, "dish.profile: expected an array of 2 to 32");
}

TEST_F(MeasureCommand, BadPicturesAreNamed) {
  const std::string jpeg = read_text(files_.file("view_0.jpg"));
  write_text(files_.file("view_0.jpg"), jpeg.substr(0, jpeg.size() / 2));
  expect_wrong_use({}, "view_0.jpg: views[0].image");
  write_text(files_.file("view_0.jpg"), jpeg);
  std::filesystem::copy_file(files_.file("view_2.png"), files_.file("labels_1.png"),
                             std::filesystem::copy_options::overwrite_existing);
  expect_wrong_use({}, "labels_1.png: views[1].labels");
  std::filesystem::remove(files_.file("labels_1.png"));
  expect_wrong_use({}, "labels_1.png: views[1].labels");
  cv::imwrite(files_.file("labels_1.png").string(), draw_labels(160, 120));
  expect_wrong_use({}, "320x240");
  cv::imwrite(files_.file("labels_1.png").string(), draw_labels(320, 240));
  write_text(files_.file("card.png"), "no picture");
  expect_wrong_use({}, "card.png: card.pattern");
}

TEST_F(MeasureCommand, ConfigurationsThatTheEstimatorRefusesAreWrongUse) {
  const Json straight = files_.document["camera"]["distortion"];
  files_.document["camera"]["distortion"] = {-5.0, 0.0, 0.0, 0.0, 0.0};  // folds the picture over
  files_.store();
  expect_wrong_use({}, "camera.distortion");
  files_.document["camera"]["distortion"] = straight;
  files_.store();
  fake_estimator().construction = StatusCode::invalid_configuration;
  expect_wrong_use({}, "capture.json");
}

TEST_F(MeasureCommand, OutputsThatCannotBeWrittenAreWrongUse) {
  expect_wrong_use({"--picture", "/absent/folder/out.png"}, "/absent/folder/out.png");
  expect_wrong_use({"--mesh", files_.folder().string()}, "it is a folder");
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const char* option : {"--mesh", "--picture"}) {
    const CommandResult result = measure({"--profile", "paper", option, "/dev/full", "--json"});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.error.find("/dev/full"), std::string::npos) << result.error;
    EXPECT_TRUE(std::filesystem::exists("/dev/full"));
  }
}

TEST_F(MeasureCommand, AFailedMeasurementStillAnswers) {
  fake_estimator().measurement = {};
  fake_estimator().measurement.status = StatusCode::too_few_matches;
  const std::string mesh = files_.file("out.ply").string();
  const CommandResult result = measure({"--json", "--mesh", mesh});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(Json::parse(result.out)["status"], "too_few_matches");
  EXPECT_FALSE(std::filesystem::exists(mesh));
  EXPECT_NE(result.error.find("out.ply was not written"), std::string::npos);
}

TEST_F(MeasureCommand, DoubtsAboutTheInputAreWarnings) {
  cv::Mat labels = draw_labels(TemporaryCapture::kWidth, TemporaryCapture::kHeight);
  labels.row(labels.rows - 1).setTo(251);
  cv::imwrite(files_.file("labels_1.png").string(), labels);
  files_.document["card"]["width_mm"] = 53.98;
  files_.document["card"]["height_mm"] = 85.60;
  files_.store();
  const CommandResult result = measure({"--json"});
  ASSERT_EQ(result.status, 0) << result.error;
  const Json warnings = Json::parse(result.out)["warnings"];
  ASSERT_EQ(warnings.size(), 2U) << warnings;
  EXPECT_EQ(warnings[0]["code"], "labels_without_meaning");
  EXPECT_TRUE(warnings[0]["label"].is_null());
  EXPECT_EQ(warnings[1]["code"], "card_proportions_differ");
  EXPECT_NE(warnings[0]["message"].get<std::string>().find("labels_1.png"), std::string::npos);
  EXPECT_NE(warnings[0]["message"].get<std::string>().find("(251)"), std::string::npos);
  EXPECT_NE(warnings[1]["message"].get<std::string>().find("proportions"), std::string::npos);
}

TEST_F(MeasureCommand, TruthIsNeverRead) {
  write_text(files_.file("truth.json"), "not even JSON");
  EXPECT_EQ(measure({}).status, 0);
}

TEST(MemoryCommand, SumsThePartsAndCountsFramesApart) {
  const CommandResult result = run({"memory", "--width", "640", "--height", "480"});
  EXPECT_EQ(result.status, 0) << result.error;
  EXPECT_NE(result.out.find("stereo"), std::string::npos);
  EXPECT_NE(result.out.find("3072000"), std::string::npos) << result.out;  // the fake: 10 bytes a pixel
  EXPECT_NE(result.out.find("2457600"), std::string::npos) << result.out;  // two frames and labels
  for (const char* width : {"0", "15", "8193", "a", "-640"})
    EXPECT_EQ(run({"memory", "--width", width}).status, 2);
}

}  // namespace
}  // namespace traygauge
