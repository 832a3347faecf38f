// capture.json and truth.json: what is read, and what each mistake in them is called.
#include "simulator/capture/capture.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "simulator/capture/truth.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::json;

InputProblem problem_of(const std::function<void()>& reading) {
  try {
    reading();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_NE(text.find("expected"), std::string::npos) << text;
    EXPECT_FALSE(error.problem().hint.empty()) << text;
    return error.problem();
  }
  ADD_FAILURE() << "no error";
  return {};
}

InputProblem problem_of(const TemporaryCapture& capture) {
  capture.store();
  return problem_of([&] { read_capture(capture.folder()); });
}

TEST(Capture, ReadsEveryKeyOfTheFormat) {
  TemporaryCapture files;
  files.document["views"][2]["camera"] = files.document["camera"];
  files.document["views"][2]["camera"]["fx"] = 250.0;
  files.document["note"] = {{"unknown", "ignored"}};
  files.store();
  const Capture capture = read_capture(files.folder());
  ASSERT_EQ(capture.views.size(), 3U);
  EXPECT_EQ(capture.views[0].camera.size, (PictureSize{320, 240}));
  EXPECT_EQ(capture.views[0].camera.fx_px, 300.0);
  EXPECT_EQ(capture.views[0].arm_angle_deg, 0.0);
  EXPECT_EQ(capture.views[1].arm_angle_deg, 18.0);
  EXPECT_FALSE(capture.views[2].arm_angle_deg.has_value());
  EXPECT_EQ(capture.views[2].camera.fx_px, 250.0);
  EXPECT_EQ(capture.views[1].labels->path.filename(), "labels_1.png");
  EXPECT_EQ(capture.card.thickness_mm, 0.8);
  ASSERT_EQ(capture.dishes.size(), 1U);
  EXPECT_EQ(capture.dishes[0].style, "dinner");
  EXPECT_EQ(capture.dishes[0].profile.back().inset_mm, 49.0);
  EXPECT_EQ(capture.pairs, (std::vector<std::array<int, 2>>{{0, 1}, {1, 2}}));
}

TEST(Capture, OptionalKeysMayBeAbsent) {
  TemporaryCapture files;
  files.document.erase("dish");
  files.document.erase("pairs");
  for (Json& view : files.document["views"]) {
    view.erase("labels");
    view["camera"] = files.document["camera"];
  }
  files.document.erase("camera");
  files.store();
  const Capture capture = read_capture(files.folder());
  EXPECT_TRUE(capture.dishes.empty());
  EXPECT_TRUE(capture.pairs.empty());
  EXPECT_FALSE(capture.views[0].labels.has_value());
}

TEST(Capture, SeveralDishesKeepTheirLabels) {
  TemporaryCapture files;
  Json dish = files.document["dish"];
  files.document.erase("dish");
  dish["label"] = 1;
  files.document["dishes"] = {dish, dish};
  files.document["dishes"][1]["label"] = 201;
  files.store();
  const Capture capture = read_capture(files.folder());
  ASSERT_EQ(capture.dishes.size(), 2U);
  EXPECT_EQ(capture.dishes[1].label, 201);
  files.document["dishes"][1]["label"] = 1;
  EXPECT_EQ(problem_of(files).key, "dishes[1].label");
  files.document["dishes"][1]["label"] = 7;
  EXPECT_EQ(problem_of(files).key, "dishes[1].label");
}

struct Mistake {
  const char* pointer;  // into the document
  Json value;
  const char* key;  // that the error names
};

class CaptureMistake : public testing::TestWithParam<Mistake> {};

TEST_P(CaptureMistake, IsNamed) {
  const Mistake& mistake = GetParam();
  TemporaryCapture files;
  files.document[Json::json_pointer(mistake.pointer)] = mistake.value;
  const InputProblem problem = problem_of(files);
  EXPECT_EQ(problem.file, files.file("capture.json"));
  EXPECT_EQ(problem.key, mistake.key);
}

INSTANTIATE_TEST_SUITE_P(
    Values, CaptureMistake,
    testing::Values(
        Mistake{"/version", 2, "version"}, Mistake{"/version", "1", "version"},
        Mistake{"/camera", 3, "camera"}, Mistake{"/camera/width", 15, "camera.width"},
        Mistake{"/camera/width", 320.5, "camera.width"}, Mistake{"/camera/width", "320", "camera.width"},
        Mistake{"/camera/height", 8193, "camera.height"},
        Mistake{"/camera/height", 18446744073709551615ULL, "camera.height"},
        Mistake{"/camera/height", -240, "camera.height"}, Mistake{"/camera/fx", 0, "camera.fx"},
        Mistake{"/camera/fx", -300.0, "camera.fx"}, Mistake{"/camera/fy", "NaN", "camera.fy"},
        Mistake{"/camera/fy", nullptr, "camera.fy"}, Mistake{"/camera/fy", true, "camera.fy"},
        Mistake{"/camera/cx", 320, "camera.cx"}, Mistake{"/camera/cy", -1, "camera.cy"},
        Mistake{"/camera/distortion", Json::array({0, 0, 0}), "camera.distortion"},
        Mistake{"/camera/distortion/2", "0", "camera.distortion[2]"}, Mistake{"/card", Json::array(), "card"},
        Mistake{"/card/pattern", "", "card.pattern"}, Mistake{"/card/pattern", 5, "card.pattern"},
        Mistake{"/card/pattern", "/etc/passwd", "card.pattern"},
        Mistake{"/card/pattern", "../card.png", "card.pattern"},
        Mistake{"/card/width_mm", 9.9, "card.width_mm"}, Mistake{"/card/height_mm", 501, "card.height_mm"},
        Mistake{"/card/thickness_mm", -0.1, "card.thickness_mm"},
        Mistake{"/dish/outer_size_mm", 260, "dish.outer_size_mm"},
        Mistake{"/dish/outer_size_mm/1", 0, "dish.outer_size_mm[1]"},
        Mistake{"/dish/rim_height_mm", 201, "dish.rim_height_mm"},
        Mistake{"/dish/bottom_height_mm", 23, "dish.bottom_height_mm"},
        Mistake{"/dish/profile", Json::array(), "dish.profile"},
        Mistake{"/dish/profile/1", Json::array({0.0, 10.0}), "dish.profile[1][0]"},
        Mistake{"/dish/profile/0", Json::array({0.0}), "dish.profile[0]"},
        Mistake{"/dish/profile/2/0", 131, "dish.profile[2][0]"},
        Mistake{"/dish/profile/0/0", 0.5, "dish.profile[0][0]"},
        Mistake{"/dish/profile/1/0", 49, "dish.profile[2][0]"},
        Mistake{"/dish/profile/1/1", 23.1, "dish.profile[1][1]"},  // above the rim
        Mistake{"/dish/profile/1/1", 3.4, "dish.profile[1][1]"},   // below the bottom
        Mistake{"/dish/profile/1/1", nullptr, "dish.profile[1][1]"},
        Mistake{"/dish/profile/2/1", 5.6, "dish.profile"},  // ends on the wall
        Mistake{"/dish/style", 1, "dish.style"}, Mistake{"/dishes", Json::array(), "dishes"},
        Mistake{"/views", Json::array(), "views"}, Mistake{"/views", Json::object(), "views"},
        Mistake{"/views/0", "view_0.jpg", "views[0]"},
        Mistake{"/views/1/image", "a/../../b.jpg", "views[1].image"},
        Mistake{"/views/1/labels", Json::array(), "views[1].labels"},
        Mistake{"/views/1/arm_angle_deg", 361, "views[1].arm_angle_deg"},
        Mistake{"/views/1/camera", Json::object(), "views[1].camera.width"},
        Mistake{"/pairs/0/1", 3, "pairs[0][1]"}, Mistake{"/pairs/0/1", -1, "pairs[0][1]"},
        Mistake{"/pairs/1", Json::array({0, 1, 2}), "pairs[1]"}, Mistake{"/pairs", "0,1", "pairs"}));

TEST(Capture, AProfileHoldsUpTo32Points) {
  TemporaryCapture files;
  Json& profile = files.document["dish"]["profile"];
  profile = Json::array();
  for (int i = 0; i < 32; ++i) profile.push_back({1.5 * i, 22.0 - 17.5 * i / 31.0});
  files.store();
  EXPECT_EQ(read_capture(files.folder()).dishes[0].profile.size(), 32U);
  profile.push_back({60.0, 4.5});
  const InputProblem problem = problem_of(files);
  EXPECT_EQ(problem.key, "dish.profile");
  EXPECT_NE(problem.expected.find("32"), std::string::npos) << problem.expected;
}

TEST(Capture, AProfileEndsWithinAMillimetreOfTheBottomAndTurnsWithinOneOfTheRim) {
  TemporaryCapture files;
  files.document["dish"]["profile"] = {{0, 22.9}, {1.6, 23.0}, {130.0, 5.5}};
  files.store();
  EXPECT_EQ(read_capture(files.folder()).dishes[0].profile.back().inset_mm, 130.0);
  files.document["dish"]["profile"] = {{0, 3.5}, {2.0, 3.5}};
  files.store();
  EXPECT_EQ(read_capture(files.folder()).dishes[0].profile.size(), 2U);
}

TEST(Capture, EveryAbsentKeyIsNamed) {
  for (const char* pointer :
       {"/version", "/camera", "/camera/width", "/camera/height", "/camera/fx", "/camera/fy", "/camera/cx",
        "/camera/cy", "/camera/distortion", "/card", "/card/pattern", "/card/width_mm", "/card/height_mm",
        "/card/thickness_mm", "/dish/outer_size_mm", "/dish/rim_height_mm", "/dish/bottom_height_mm",
        "/views", "/views/1/image"}) {
    TemporaryCapture files;
    const Json::json_pointer key(pointer);
    files.document[key.parent_pointer()].erase(key.back());
    const InputProblem problem = problem_of(files);
    EXPECT_NE(problem.key.find(key.back()), std::string::npos) << pointer << " gave " << problem.key;
    EXPECT_EQ(problem.found, "nothing") << pointer;
  }
}

TEST(Capture, NumbersThatAreNotFiniteAreRefused) {
  const TemporaryCapture files;
  const std::string good = read_text(files.file("capture.json"));
  for (const char* number : {"1e999", "-1e999", "NaN", "nan", "Infinity", "0x10", "1e"}) {
    std::string bad = good;
    bad.replace(bad.find("300.0"), 5, number);
    write_text(files.file("capture.json"), bad);
    EXPECT_EQ(problem_of([&] { read_capture(files.folder()); }).file, files.file("capture.json")) << number;
  }
}

TEST(Capture, FoldersAndFilesThatCannotBeRead) {
  const TemporaryCapture files;
  EXPECT_EQ(problem_of([&] { read_capture(files.file("absent")); }).file, files.file("absent"));
  EXPECT_EQ(problem_of([&] { read_capture(files.file("card.png")); }).file, files.file("card.png"));
  EXPECT_EQ(problem_of([&] { read_capture(""); }).file, "");
  std::filesystem::remove(files.file("capture.json"));
  EXPECT_EQ(problem_of([&] { read_capture(files.folder()); }).file, files.file("capture.json"));
  std::filesystem::create_directory(files.file("capture.json"));
  EXPECT_EQ(problem_of([&] { read_capture(files.folder()); }).found, "a folder or device");
  std::filesystem::remove(files.file("capture.json"));
  ASSERT_EQ(mkfifo(files.file("capture.json").c_str(), 0600), 0);  // opening it must not wait for a writer
  EXPECT_EQ(problem_of([&] { read_capture(files.folder()); }).found, "a folder or device");
}

TEST(Capture, AFolderWithoutPermissionIsNamed) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const TemporaryCapture files;
  std::filesystem::permissions(files.folder(), std::filesystem::perms::none);
  const InputProblem problem = problem_of([&] { read_capture(files.folder()); });
  std::filesystem::permissions(files.folder(), std::filesystem::perms::owner_all);
  EXPECT_EQ(problem.file, files.file("capture.json"));
}

TEST(Capture, SizeAndNestingAreLimited) {
  const TemporaryCapture files;
  for (const std::string& text :
       {std::string((1U << 20U) + 1U, ' '), std::string(1U << 20U, '['), std::string("")}) {
    write_text(files.file("capture.json"), text);
    EXPECT_EQ(problem_of([&] { read_capture(files.folder()); }).expected, "a JSON document");
  }
  write_text(files.file("capture.json"), std::string(40, '[') + std::string(40, ']'));
  EXPECT_NE(problem_of([&] { read_capture(files.folder()); }).found.find("nesting"), std::string::npos);
}

TEST(Truth, IsOptionalAndChecked) {
  const TemporaryCapture files;
  EXPECT_FALSE(read_truth(files.folder()).has_value());
  const Json identity = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  Json truth = {
      {"items", {{{"label", 2}, {"name", "peas"}, {"volume_ml", 73.0}, {"column_volume_ml", 80.0}}}},
      {"poses", {identity}}};
  write_text(files.file("truth.json"), truth.dump());
  const std::optional<Truth> read = read_truth(files.folder());
  EXPECT_EQ(read->items[0].volume_ml, 73.0);
  EXPECT_EQ(read->items[0].column_volume_ml, 80.0);
  EXPECT_EQ(read->items[0].kind, "heightfield");
  EXPECT_EQ(read->poses[0][2][2], 1.0);
  truth["poses"][0][0][0] = 2.0;
  write_text(files.file("truth.json"), truth.dump());
  EXPECT_EQ(problem_of([&] { read_truth(files.folder()); }).key, "poses[0]");
}

TEST(RecordedCaptures, AllAreReadWithTheirTruth) {
  const auto folders = capture_folders();
  if (folders.empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  for (const auto& folder : folders) {
    const Capture capture = read_capture(folder);
    const std::optional<Truth> truth = read_truth(folder);
    ASSERT_TRUE(truth.has_value()) << folder;
    EXPECT_EQ(truth->poses.size(), capture.views.size()) << folder;
    EXPECT_FALSE(truth->items.empty()) << folder;
    for (const TruthItem& item : truth->items) {
      EXPECT_EQ(item.kind == "scan", item.column_volume_ml.has_value()) << folder << " " << item.name;
    }
  }
}

}  // namespace
}  // namespace traygauge
