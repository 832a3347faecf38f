#include "simulator/scenes/capture_writer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <string>

#include "simulator/capture/capture.hpp"
#include "simulator/capture/picture_file.hpp"
#include "simulator/capture/png_writer.hpp"
#include "simulator/capture/truth.hpp"
#include "simulator/render/truth_kind.hpp"
#include "simulator/scenes/scene_parts.hpp"
#include "simulator/scenes/scene_poses.hpp"
#include "simulator/scenes/scene_views.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

SceneDescription small_scene() {
  Draws draws(4);
  SceneDescription scene;
  scene.name = "small";
  scene.dishes.push_back(draw_dish(draws, DishStyle::dinner, 1.0, 1));
  const FoodKind* kinds[] = {find_food_kind("mash"), find_food_kind("schnitzel")};
  draw_foods(scene, draws, 0, DishStyle::dinner, 1.0, kinds);
  scene.photography.camera.size = {200, 150};
  scene.photography.camera.fx_px = scene.photography.camera.fy_px = 175.0;
  scene.photography.camera.cx_px = 99.5;
  scene.photography.camera.cy_px = 74.5;
  draw_card(scene, draws);
  draw_views(scene, draws, 2, {});
  draw_lamps(scene, draws);
  draw_exposures(scene, draws);
  return scene;
}

// Mean grey value of the card in the first view.
double card_brightness(const std::filesystem::path& capture) {
  const LoadedView view = load_view(read_capture(capture).views[0]);
  const Picture gray = to_gray(view.picture);
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < gray.pixels.size(); ++i) {
    if (view.labels.pixels[i] != kCardLabel) continue;
    sum += gray.pixels[i];
    count += 1.0;
  }
  return sum / count;
}

TEST(CaptureWriter, CardShowsThePrintOfItsFile) {
  const TemporaryFolder folder;
  SceneDescription scene = small_scene();
  scene.card.print = folder.path() / "print.png";
  const auto print = [&](std::uint8_t gray) {
    Picture picture({86, 54}, PixelFormat::gray8);
    std::fill(picture.pixels.begin(), picture.pixels.end(), gray);
    write_png(scene.card.print, picture.frame());
    return picture;
  };
  const std::filesystem::path out = folder.path() / scene.name;
  const Picture dark = print(40);
  render_capture(scene, out, {}, [](double) {});
  EXPECT_EQ(state_of_capture(out, scene, {}), CaptureState::complete);
  EXPECT_EQ(load_pattern(read_capture(out).card).pixels, dark.pixels);
  const double dark_brightness = card_brightness(out);
  print(200);
  EXPECT_EQ(state_of_capture(out, scene, {}), CaptureState::stale);
  render_capture(scene, out, {}, [](double) {});
  EXPECT_GT(card_brightness(out), 2.0 * dark_brightness);
}

TEST(CaptureWriter, WritesWhatTheReaderReads) {
  const TemporaryFolder folder;
  SceneDescription scene = small_scene();
  const std::filesystem::path out = folder.path() / scene.name;
  EXPECT_EQ(state_of_capture(out, scene, {}), CaptureState::absent);
  double last = 0.0;
  render_capture(scene, out, {}, [&](double share) {
    EXPECT_GE(share, last - 1e-9);
    last = share;
  });
  EXPECT_NEAR(last, 1.0, 1e-9);
  EXPECT_EQ(state_of_capture(out, scene, {}), CaptureState::complete);
  EXPECT_FALSE(std::filesystem::exists(out.string() + ".part"));

  const Capture capture = read_capture(out);
  ASSERT_EQ(capture.views.size(), 2U);
  ASSERT_EQ(capture.dishes.size(), 1U);
  EXPECT_EQ(capture.dishes[0].profile.size(), scene.dishes[0].dish.profile.size());
  const Picture pattern = load_pattern(capture.card);
  EXPECT_EQ(pattern.size, (PictureSize{1712, 1080}));
  const Truth truth = *read_truth(out);
  ASSERT_EQ(truth.items.size(), 2U);
  ASSERT_EQ(truth.dishes.size(), 1U);
  for (std::size_t i = 0; i < 2; ++i) {
    const LoadedView view = load_view(capture.views[i]);
    for (const int label : {1, 2, 3, 255})
      EXPECT_GT(std::count(view.labels.pixels.begin(), view.labels.pixels.end(), label), 20) << label;
    const auto [darkest, brightest] =
        std::minmax_element(view.picture.pixels.begin(), view.picture.pixels.end());
    EXPECT_LT(*darkest, 80);
    EXPECT_GT(*brightest, 170);
    const Eigen::Isometry3d pose = view_camera(scene, scene.views[i]).camera_from_world;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 4; ++c)
        EXPECT_DOUBLE_EQ(truth.poses[i][r][c],
                         pose(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)));
    }
  }
  const DepthPicture depth = read_depth_picture({out / "depth_0.png", ""}, capture.views[0].camera.size);
  const double centre_mm = 0.02 * depth.view().at(100, 75);
  EXPECT_NEAR(centre_mm, scene.views[0].distance_mm, 60.0);

  // What is said of a complete capture is mended without rendering it again.
  scene.views[1].arm_angle_deg = 12.5;
  ASSERT_EQ(state_of_capture(out, scene, {}), CaptureState::complete);
  update_description(out, scene);
  EXPECT_EQ(read_capture(out).views[1].arm_angle_deg, 12.5);
  EXPECT_FALSE(std::filesystem::exists(out / "capture.json.part"));
  const auto written = std::filesystem::last_write_time(out / "capture.json");
  update_description(out, scene);
  EXPECT_EQ(std::filesystem::last_write_time(out / "capture.json"), written);
}

// A box of 30 × 24 × 20 mm in the file's unit of 0.1 mm.
constexpr const char* kBoxObj =
    "v 0 0 0\nv 300 0 0\nv 300 240 0\nv 0 240 0\nv 0 0 200\nv 300 0 200\nv 300 240 200\nv 0 240 200\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

SceneDescription scanned_scene(const std::filesystem::path& file) {
  write_text(file, kBoxObj);
  SceneDescription scene = small_scene();
  scene.foods.clear();
  for (const double x_mm : {-30.0, 30.0}) {
    LaidFood food;
    food.name = x_mm < 0.0 ? "left" : "right";
    food.kind = "bread";
    food.centre_mm = {x_mm, 5.0};
    food.scan = ScannedFood{file, 0.1, {0.0, 0.0, 20.0}};
    scene.foods.push_back(food);
  }
  return scene;
}

// Finer than labels: the rim of a dish, and what has no label.
TEST(CaptureWriter, WritesTheKindOfEachPixel) {
  const TemporaryFolder folder;
  SceneDescription scene = small_scene();
  scene.views.resize(1);
  scene.pairs.clear();
  Photograph& view = scene.views[0];
  view = Photograph();
  view.distance_mm = 600.0;
  scene.card.centre_mm = {185.0, 0.0};
  scene.utensils.push_back({UtensilKind::fork, {-170.0, 0.0}, 90.0, 0.0, 0xC8C8C8});
  scene.utensils.push_back({UtensilKind::napkin, {0.0, -200.0}, 0.0, 0.0, 0xF0F0F0});
  const std::filesystem::path out = folder.path() / scene.name;
  render_capture(scene, out, {}, [](double) {});
  EXPECT_FALSE(std::filesystem::exists(out / "kinds_0.png"));
  const CaptureExtras extras{true};
  EXPECT_EQ(state_of_capture(out, scene, {}), CaptureState::complete);
  EXPECT_EQ(state_of_capture(out, scene, {}, extras), CaptureState::absent);
  render_capture(
      scene, out, {}, [](double) {}, extras);
  EXPECT_EQ(state_of_capture(out, scene, {}, extras), CaptureState::complete);

  const PictureSize size = scene.photography.camera.size;
  const Picture labels = read_label_picture({out / "labels_0.png", ""}, size);
  const Picture kinds = read_label_picture({out / "kinds_0.png", ""}, size);
  std::array<int, 8> counts{};
  for (std::size_t i = 0; i < kinds.pixels.size(); ++i) {
    const auto kind = static_cast<TruthKind>(kinds.pixels[i]);
    const int label = labels.pixels[i];
    ASSERT_LT(kinds.pixels[i], counts.size());
    ++counts[kinds.pixels[i]];
    EXPECT_EQ(kind == TruthKind::food, label >= 2 && label < 200) << i;
    EXPECT_EQ(kind == TruthKind::card, label == kCardLabel) << i;
    EXPECT_EQ(kind == TruthKind::glaze || kind == TruthKind::rim, label == 1) << i;
  }
  const auto count = [&](TruthKind kind) { return counts[static_cast<std::size_t>(kind)]; };
  EXPECT_GT(count(TruthKind::cutlery), 20);
  EXPECT_GT(count(TruthKind::napkin), 100);
  EXPECT_GT(count(TruthKind::table), 5000);
  EXPECT_EQ(count(TruthKind::none), 0);
  // A ring of 5 mm inside the dish's edge, seen from above.
  const DishDescription& dish = scene.dishes[0].dish;
  const double radius_mm = 0.5 * dish.outer_size_mm[0];
  const double px_per_mm = scene.photography.camera.fx_px / (view.distance_mm - dish.rim_height_mm);
  const double ring_px = std::numbers::pi * (2.0 * radius_mm - 5.0) * 5.0 * px_per_mm * px_per_mm;
  EXPECT_NEAR(count(TruthKind::rim), ring_px, 0.15 * ring_px);
}

// From the mesh file to truth, labels and depth.
TEST(CaptureWriter, ScannedFoodStandsInThePictureWithItsTruth) {
  const TemporaryFolder folder;
  SceneDescription scene = scanned_scene(folder.path() / "box.OBJ");
  scene.views[0].tilt_deg = 0.0;
  const std::filesystem::path out = folder.path() / "scan";
  render_capture(scene, out, {}, [](double) {});
  const Truth truth = *read_truth(out);
  ASSERT_EQ(truth.items.size(), 2U);
  const Capture capture = read_capture(out);
  const LoadedView view = load_view(capture.views[0]);
  const DepthPicture depth = read_depth_picture({out / "depth_0.png", ""}, capture.views[0].camera.size);
  for (const TruthItem& item : truth.items) {
    EXPECT_EQ(item.kind, "scan");
    EXPECT_NEAR(item.volume_ml, 14.4, 0.01);
    // On a flat bottom there is nothing under it.
    EXPECT_NEAR(item.column_volume_ml.value_or(0.0), 14.4, 0.05);
    double seen_px = 0.0;
    double depth_mm = 0.0;
    for (std::size_t i = 0; i < view.labels.pixels.size(); ++i) {
      if (view.labels.pixels[i] != item.label) continue;
      seen_px += 1.0;
      depth_mm += 0.02 * depth.pixels[i];
    }
    depth_mm /= seen_px;
    // Its top from above, and at most as much again of its sides.
    const double top_px = 30.0 * 24.0 * std::pow(scene.photography.camera.fx_px / depth_mm, 2.0);
    EXPECT_GT(seen_px, 0.85 * top_px);
    EXPECT_LT(seen_px, 1.5 * top_px);
    const double top_mm = scene.dishes[0].dish.bottom_height_mm + 20.0;
    EXPECT_NEAR(depth_mm, scene.views[0].distance_mm + scene.views[0].target_mm.z() - top_mm, 6.0);
  }
}

TEST(CaptureWriter, ScannedFoodsThatShareAPlaceAreRefused) {
  const TemporaryFolder folder;
  SceneDescription scene = scanned_scene(folder.path() / "box.obj");
  scene.foods[1].centre_mm.x() = -5.0;
  const auto problem_of = [&] {
    try {
      render_capture(scene, folder.path() / "scan", {}, [](double) {});
    } catch (const std::invalid_argument& problem) {
      return std::string(problem.what());
    }
    return std::string();
  };
  EXPECT_NE(problem_of().find("left and right share"), std::string::npos) << problem_of();
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "scan"));
  const FoodKind& mash = *find_food_kind("mash");
  scene.foods[1] = {"mash", "mash", 0, {-20.0, 5.0}, 0.0, mash.size, 3, 0.0, {}, {}};
  EXPECT_NE(problem_of().find("left and mash share"), std::string::npos) << problem_of();
}

TEST(CaptureWriter, CaptureOfAnotherDescriptionIsStale) {
  const TemporaryFolder folder;
  const std::filesystem::path mesh = folder.path() / "box.obj";
  SceneDescription scene = scanned_scene(mesh);
  scene.photography.camera.size = {40, 30};
  const std::filesystem::path out = folder.path() / "scan";
  const RenderSettings settings;
  render_capture(scene, out, settings, [](double) {});
  const auto state = [&](const SceneDescription& own, const RenderSettings& with) {
    return state_of_capture(out, own, with);
  };
  EXPECT_EQ(state(scene, settings), CaptureState::complete);
  RenderSettings other = settings;
  other.threads = 7;
  EXPECT_EQ(state(scene, other), CaptureState::complete);
  other.samples = 16;
  EXPECT_EQ(state(scene, other), CaptureState::stale);
  SceneDescription changed = scene;
  changed.dishes[0].dish.bottom_height_mm += 0.1;
  EXPECT_EQ(state(changed, settings), CaptureState::stale);
  changed = scene;
  changed.views[1].tilt_deg += 1.0;
  EXPECT_EQ(state(changed, settings), CaptureState::stale);
  std::string taller = kBoxObj;
  taller.replace(taller.find("v 0 0 200"), 9, "v 0 0 201");
  write_text(mesh, taller);
  EXPECT_EQ(state(scene, settings), CaptureState::stale) << "same file name, another mesh";
  write_text(mesh, kBoxObj);
  EXPECT_EQ(state(scene, settings), CaptureState::complete);
  nlohmann::json truth = nlohmann::json::parse(read_text(out / "truth.json"));
  truth.erase("made_from");
  write_text(out / "truth.json", truth.dump());
  EXPECT_EQ(state(scene, settings), CaptureState::stale)
      << "of a program that did not say what it was made from";
  write_text(out / "truth.json", "{");
  EXPECT_EQ(state(scene, settings), CaptureState::absent);
}

// Along the motion detail is lost, across it is not; labels and pose are those of the exposure's middle.
TEST(CaptureWriter, CameraThatMovesBlursThePictureAlone) {
  const TemporaryFolder folder;
  SceneDescription scene = small_scene();
  scene.views.pop_back();
  scene.pairs.clear();
  scene.photography.aperture_mm = 0.0;
  scene.photography.full_well_electrons = 1e7;
  scene.photography.read_noise_electrons = 0.0;
  RenderSettings settings;
  settings.samples = 32;  // the rays' noise is no detail
  render_capture(scene, folder.path() / "still", settings, [](double) {});
  scene.views[0].motion_deg = {0.0, 2.0, 0.0};  // 6 px along the rows
  render_capture(scene, folder.path() / "moved", settings, [](double) {});
  struct Detail {
    double along = 0.0;
    double across = 0.0;
  };
  const auto read = [&](const char* name) { return load_view(read_capture(folder.path() / name).views[0]); };
  const auto detail_of = [](const LoadedView& view) {
    const Picture gray = to_gray(view.picture);
    const auto at = [&](int x, int y) {
      return static_cast<double>(gray.pixels[static_cast<std::size_t>(y * gray.size.width + x)]);
    };
    Detail detail;
    for (int y = 0; y + 1 < gray.size.height; ++y) {
      for (int x = 0; x + 1 < gray.size.width; ++x) {
        detail.along += std::pow(at(x + 1, y) - at(x, y), 2);
        detail.across += std::pow(at(x, y + 1) - at(x, y), 2);
      }
    }
    return detail;
  };
  const LoadedView still = read("still");
  const LoadedView moved = read("moved");
  EXPECT_LT(detail_of(moved).along, 0.5 * detail_of(still).along);
  EXPECT_GT(detail_of(moved).across, 0.5 * detail_of(still).across);
  EXPECT_EQ(still.labels.pixels, moved.labels.pixels);
  EXPECT_EQ(read_truth(folder.path() / "still")->poses, read_truth(folder.path() / "moved")->poses);
}

TEST(CaptureWriter, SameSceneGivesTheSameBytes) {
  const TemporaryFolder folder;
  const SceneDescription scene = small_scene();
  RenderSettings settings;
  settings.threads = 1;
  render_capture(scene, folder.path() / "a", settings, [](double) {});
  settings.threads = 2;
  render_capture(scene, folder.path() / "b", settings, [](double) {});
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "a")) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(read_text(folder.path() / "a" / name), read_text(folder.path() / "b" / name)) << name;
  }
}

}  // namespace
}  // namespace traygauge
