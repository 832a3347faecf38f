// `traygauge enrol-dish` on rendered captures of empty dishes: what it writes against what was rendered, and
// what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>

#include "firmware/config/dish_file.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "tests/firmware/command_runner.hpp"
#include "tests/support/empty_dish.hpp"
#include "tests/support/profile_difference.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using test::EmptyDishCapture;
using test::EmptyDishScene;

constexpr double kRimMm = 5.0;  // the rim's rounding carries no food

EmptyDishScene scene_of(const std::string& style) {
  EmptyDishScene scene;
  scene.dish = test::read_dish_model(style);
  scene.glaze_contrast = 0.5;
  scene.gloss = 60.0;
  return scene;
}

// Rendered once a program.
const EmptyDishCapture& capture_of(const std::string& style) {
  static std::map<std::string, std::unique_ptr<EmptyDishCapture>> captures;
  std::unique_ptr<EmptyDishCapture>& capture = captures[style];
  if (capture == nullptr) capture = std::make_unique<EmptyDishCapture>(scene_of(style));
  return *capture;
}

class EnrolDish : public ::testing::Test {
 protected:
  CommandResult enrol(const fs::path& capture, const std::string& style,
                      const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"enrol-dish", capture.string(), "--style",
                                          style,        "--out",          out_.path().string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  fs::path file(const std::string& style) const { return out_.path() / (style + ".toml"); }
  bool is_empty() const { return fs::is_empty(out_.path()); }

  // A copy that a test may spoil.
  fs::path copy_of(const std::string& style) {
    const fs::path folder = spoilt_.path() / style;
    fs::copy(capture_of(style).folder(), folder);
    return folder;
  }

  void expect_refused(const CommandResult& result, int status, const std::string& answer) const {
    EXPECT_EQ(result.status, status) << result.error << result.out;
    EXPECT_NE((result.out + result.error).find(answer), std::string::npos) << result.out << result.error;
    EXPECT_TRUE(is_empty());
  }

  TemporaryFolder out_;
  TemporaryFolder spoilt_;
};

void expect_like(const DishModel& found, const DishModel& truth, double worst_mm, double volume_ml,
                 double size_mm = 0.5) {
  for (std::size_t axis = 0; axis < 2; ++axis)
    EXPECT_NEAR(found.outer_size_mm[axis], truth.outer_size_mm[axis], size_mm);
  EXPECT_NEAR(found.rim_height_mm, truth.rim_height_mm, 0.5);
  EXPECT_NEAR(found.bottom_height_mm, truth.bottom_height_mm, 0.15);
  const test::ProfileDifference difference = test::compare_profiles(found, truth, kRimMm);
  EXPECT_LT(difference.worst_mm, worst_mm);
  EXPECT_LT(std::abs(difference.volume_ml), volume_ml);
}

TEST_F(EnrolDish, WritesTheDishThatWasRendered) {
  for (const std::string style : {"dinner", "soup", "oval"}) {
    SCOPED_TRACE(style);
    const CommandResult result = enrol(capture_of(style).folder(), style, {"--json"});
    ASSERT_EQ(result.status, 0) << result.error << result.out;
    EXPECT_EQ(result.error, "");
    const DishDescription written = read_dish_file(file(style));
    EXPECT_EQ(written.style, style);
    // 2 ml are 0.05 mm over the dish.
    expect_like(dish_of(written), test::read_dish_model(style), 0.7, 3.0);
    EXPECT_EQ(written.outer_size_mm[0] == written.outer_size_mm[1], style != "oval");

    const Json document = Json::parse(result.out);
    EXPECT_EQ(document["status"], "ok");
    EXPECT_EQ(document["file"], file(style).string());
    EXPECT_EQ(document["dish"]["bottom_height_mm"], written.bottom_height_mm);
    EXPECT_EQ(document["dish"]["profile"].size(), written.profile.size());
    EXPECT_LT(document["residual_mm"], 0.15);
    EXPECT_GT(document["known_fraction"], 0.9);
    EXPECT_LT(document["lean_deg"], 0.2);
    EXPECT_NEAR(document["relative_angle_deg"], 18.0, 1.0);
  }
}

TEST_F(EnrolDish, WhateverTheDishAndWhereverTheCameras) {
  std::mt19937 random(test::random_seed());
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (const std::string style : {"dinner", "soup", "oval"}) {
    EmptyDishScene scene = scene_of(style);
    const double size = draw(0.9, 1.1);
    const double depth = draw(0.7, 1.2);
    const double bottom_mm = scene.dish.bottom_height_mm;
    for (double& axis_mm : scene.dish.outer_size_mm) axis_mm *= size;
    for (DishProfilePoint& point : std::span(scene.dish.profile_points).first(scene.dish.profile_size))
      point.height_mm = bottom_mm + depth * (point.height_mm - bottom_mm);
    scene.dish.rim_height_mm = bottom_mm + depth * (scene.dish.rim_height_mm - bottom_mm);
    scene.glaze_contrast = draw(0.4, 1.0);
    scene.gloss = draw(0.0, 90.0);
    scene.noise_gray = draw(1.0, 2.5);
    scene.tilt_deg[0] = draw(2.0, 18.0);
    scene.tilt_deg[1] = scene.tilt_deg[0] + draw(9.0, 18.0);
    scene.turn_deg = draw(-12.0, 12.0);
    scene.azimuth_deg = draw(0.0, 180.0);
    scene.distance_mm = draw(460.0, 530.0);
    scene.seed = static_cast<std::uint32_t>(random());
    const EmptyDishCapture capture(scene);
    const CommandResult result = enrol(capture.folder(), style);
    ASSERT_EQ(result.status, 0) << style << result.error << result.out;
    SCOPED_TRACE(result.out);
    expect_like(dish_of(read_dish_file(file(style))), scene.dish, 1.2, 6.0);
  }
}

// A ruler is wrong by up to 3 mm of a length, and by 2 mm of the rim's height. The edge that this glaze shows
// lies a pixel, 0.5 mm, inside of the rim.
TEST_F(EnrolDish, OutlinesAreFoundWhereARulerSaysTheSize) {
  std::mt19937 random(test::random_seed());
  const auto ruled = [&random](double mm, double off_mm) {
    return std::to_string(mm + std::uniform_real_distribution<double>(-off_mm, off_mm)(random));
  };
  for (const std::string style : {"dinner", "soup", "oval"}) {
    const DishModel truth = test::read_dish_model(style);
    const std::string size = ruled(truth.outer_size_mm[0], 3.0) + "x" + ruled(truth.outer_size_mm[1], 3.0) +
                             "x" + ruled(truth.rim_height_mm, 2.0);
    const CommandResult result = enrol(capture_of(style).folder(), style, {"--size", size});
    ASSERT_EQ(result.status, 0) << style << " " << size << result.error << result.out;
    SCOPED_TRACE(size + "\n" + result.out);
    expect_like(dish_of(read_dish_file(file(style))), truth, 0.9, 6.0, 1.5);
  }
}

TEST_F(EnrolDish, WhereNoSuchDishIsItIsTold) {
  const fs::path folder = capture_of("soup").folder();
  for (const char* size :
       {"262", "262x262", "262x262x23x4", "2x2x1", "262x262x-3", "nanx262x23", "1e9x262x23"}) {
    expect_refused(enrol(folder, "soup", {"--size", size}), 2, "such as 262x262x23");
  }
  expect_refused(enrol(folder, "soup", {"--size", "400x400x30"}), 2, "an empty dish of that size");
  // Another card lies there than the capture says.
  const fs::path other = copy_of("soup");
  fs::copy_file(other / "view_0.png", other / "card.png", fs::copy_options::overwrite_existing);
  expect_refused(enrol(other, "soup", {"--size", "230x230x40"}), 2, "the card in both views");
}

TEST_F(EnrolDish, TheTableSaysHowSureItIs) {
  const CommandResult result = enrol(capture_of("dinner").folder(), "blue");
  ASSERT_EQ(result.status, 0) << result.error;
  for (const char* part : {"status   ok: ", "blue.toml", "inset mm", "outside  round, 2", "(± 0.", "rim ",
                           "bottom ", "surface  ± 0.", "lean "}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
  }
}

TEST_F(EnrolDish, ThePlainGlazeIsRefusedButItsSizeIsSaid) {
  EmptyDishScene scene = scene_of("dinner");
  scene.glaze_contrast = 0.0;
  const EmptyDishCapture plain(scene);
  const CommandResult result = enrol(plain.folder(), "white", {"--json"});
  expect_refused(result, 1, "too_little_depth");
  const Json document = Json::parse(result.out);
  EXPECT_TRUE(document["dish"].is_null());
  EXPECT_TRUE(document["file"].is_null());
  EXPECT_NEAR(document["edge"]["outer_size_mm"][0], 260.0, 0.5);
  EXPECT_NEAR(document["edge"]["height_mm"], 21.4, 0.5);
  EXPECT_LT(document["known_fraction"], 0.5);
  expect_refused(enrol(plain.folder(), "white"), 1, "Draw a fine pattern");
}

TEST_F(EnrolDish, ADishThatIsNotEmptyIsRefused) {
  const fs::path folder = copy_of("dinner");
  for (const int label : {2, 199, 201, 249}) {
    test::paint_labels(folder, 1, {500, 400, 20, 20}, static_cast<std::uint8_t>(label));
    expect_refused(enrol(folder, "dinner"), 2, "labels_1.png");
    expect_refused(enrol(folder, "dinner"), 2, "not empty, labels " + std::to_string(label));
    test::paint_labels(folder, 1, {500, 400, 20, 20}, 1);
  }
}

TEST_F(EnrolDish, NothingIsReplacedWithoutForce) {
  const fs::path folder = capture_of("dinner").folder();
  write_text(file("dinner"), "mine");
  const CommandResult refused = enrol(folder, "dinner");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.error.find("--force"), std::string::npos) << refused.error;
  EXPECT_EQ(read_text(file("dinner")), "mine");
  EXPECT_EQ(enrol(folder, "dinner", {"--force"}).status, 0);
  EXPECT_EQ(read_dish_file(file("dinner")).style, "dinner");
}

TEST_F(EnrolDish, WrongUseIsToldInOneLine) {
  const fs::path folder = capture_of("dinner").folder();
  for (const char* style : {"", "a/b", "../a", ".hidden", "a b", "ä"})
    expect_refused(enrol(folder, style), 2, "--style");
  expect_refused(enrol(folder, "dinner", {"--pair", "0,2"}), 2, "--pair");
  expect_refused(enrol(folder, "dinner", {"--seed", "-1"}), 2, "--seed");
  expect_refused(enrol(out_.path(), "dinner"), 2, "capture.json");
  expect_refused(run({"enrol-dish", folder.string(), "--style", "dinner", "--out", "/no/such/folder"}), 2,
                 "/no/such/folder");
  expect_refused(run({"enrol-dish", folder.string()}), 2, "--style");
}

TEST_F(EnrolDish, WhatCannotBeMeasuredIsRefused) {
  const fs::path cut = copy_of("dinner");
  test::paint_labels(cut, 0, {600, 0, 30, 3}, 1);
  expect_refused(enrol(cut, "dinner"), 1, "dish_cut_off");

  // The second view shows another dish.
  const fs::path mixed = copy_of("oval");
  for (const char* name : {"view_1.png", "labels_1.png"})
    fs::copy_file(capture_of("soup").folder() / name, mixed / name, fs::copy_options::overwrite_existing);
  const CommandResult result = enrol(mixed, "mixed");
  EXPECT_EQ(result.status, 1) << result.out << result.error;
  EXPECT_TRUE(is_empty());

  // Twice the same view.
  const fs::path same = copy_of("soup");
  for (const char* name : {"view_", "labels_"}) {
    fs::copy_file(same / (std::string(name) + "0.png"), same / (std::string(name) + "1.png"),
                  fs::copy_options::overwrite_existing);
  }
  EXPECT_EQ(enrol(same, "same").status, 1);
  EXPECT_TRUE(is_empty());

  const fs::path nothing = spoilt_.path() / "nothing";
  fs::copy(capture_of("dinner").folder(), nothing);
  test::paint_labels(nothing, 0, {0, 0, 1200, 900}, 0);
  expect_refused(enrol(nothing, "nothing"), 1, "no_dish_label");
}

}  // namespace
}  // namespace traygauge
