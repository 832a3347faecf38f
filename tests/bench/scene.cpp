#include "tests/bench/scene.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/labels/label_regions.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "simulator/capture/capture.hpp"
#include "simulator/capture/truth.hpp"
#include "tests/support/synthetic_scene.hpp"

namespace traygauge::bench {
namespace {

constexpr double kPatternPxPerMm = 10.0;
constexpr std::uint8_t kSpotLow = 20;
constexpr std::uint8_t kSpotHigh = 235;

cv::Mat as_mat(Picture& gray) {
  return {gray.size.height, gray.size.width, CV_8U, gray.pixels.data()};
}

Picture draw_pattern(const ReferenceCard& card) {
  constexpr int kSpots = 400;
  Picture pattern(
      {static_cast<int>(card.width_mm * kPatternPxPerMm), static_cast<int>(card.height_mm * kPatternPxPerMm)},
      PixelFormat::gray8);
  cv::Mat picture = as_mat(pattern);
  picture = 128;
  cv::RNG random(7);
  for (int i = 0; i < kSpots; ++i) {
    const cv::Point centre(random.uniform(0, picture.cols), random.uniform(0, picture.rows));
    const cv::Size axes(random.uniform(6, 36), random.uniform(6, 36));
    cv::ellipse(picture, centre, axes, random.uniform(0, 180), 0, 360, random.uniform(kSpotLow, kSpotHigh),
                cv::FILLED, cv::LINE_AA);
  }
  return pattern;
}

// The card lies flat on the table, beside the dish.
void draw_card(const SyntheticCamera& camera, const ReferenceCard& card, Picture& pattern, Picture& frame,
               Picture& labels) {
  const Vec3 corner(-0.5 * card.width_mm, 205.0, 0.0);
  const auto width = static_cast<float>(pattern.size.width) - 0.5F;
  const auto height = static_cast<float>(pattern.size.height) - 0.5F;
  const std::array<cv::Point2f, 4> source{
      cv::Point2f{-0.5F, -0.5F}, {width, -0.5F}, {width, height}, {-0.5F, height}};
  std::array<cv::Point2f, 4> target;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 place =
        corner + Vec3(i == 1 || i == 2 ? card.width_mm : 0.0, i >= 2 ? -card.height_mm : 0.0, 0.0);
    const Vec2 pixel = camera.project(place);
    target[i] = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
  }
  const cv::Mat warp = cv::getPerspectiveTransform(source.data(), target.data());
  const cv::Mat full(pattern.size.height, pattern.size.width, CV_8U, cv::Scalar(255));
  cv::Mat blurred;  // against aliasing: the pattern is seen at about a third of its scale
  cv::GaussianBlur(as_mat(pattern), blurred, {}, 1.3);
  cv::Mat printed;
  cv::Mat mask;
  const cv::Size size(frame.size.width, frame.size.height);
  cv::warpPerspective(blurred, printed, warp, size, cv::INTER_LINEAR);
  cv::warpPerspective(full, mask, warp, size, cv::INTER_NEAREST);
  printed.copyTo(as_mat(frame), mask);
  as_mat(labels).setTo(255, mask);
}

}  // namespace

TraySetup Scene::setup() const {
  TraySetup setup;
  setup.lens = lens;
  setup.card = card;
  setup.card.pattern = pattern.gray();
  setup.dishes = {&dish, 1};
  setup.limits = {lens.width, lens.height};
  return setup;
}

ViewInput Scene::view(std::size_t i) const {
  ViewInput input;
  input.frame = frames[i].frame();
  input.labels = labels[i].gray();
  return input;
}

double Scene::error_percent(const std::map<int, double>& volumes_ml) const {
  if (truth_ml.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (const auto& [label, true_ml] : truth_ml) {
    const auto found = volumes_ml.find(label);
    sum += found == volumes_ml.end() ? 1.0 : std::abs(found->second - true_ml) / true_ml;
  }
  return 100.0 * sum / static_cast<double>(truth_ml.size());
}

std::optional<Scene> load_capture_scene(const std::string& capture) {
  const char* captures = std::getenv("TRAYGAUGE_CAPTURES");
  if (captures == nullptr) return std::nullopt;
  const std::filesystem::path folder = std::filesystem::path(captures) / capture;
  if (!std::filesystem::exists(folder / "capture.json")) return std::nullopt;
  const Capture description = read_capture(folder);
  Scene scene;
  scene.name = capture;
  for (std::size_t i = 0; i < 2; ++i) {
    LoadedView loaded = load_view(description.views[i]);
    scene.frames[i] = std::move(loaded.picture);
    scene.labels[i] = std::move(loaded.labels);
  }
  scene.lens = lens_of(description.views[0].camera);
  scene.pattern = load_pattern(description.card);
  scene.card = {description.card.width_mm, description.card.height_mm, description.card.thickness_mm, {}};
  scene.dish = dish_of(description.dishes.at(0));
  if (const auto truth = read_truth(folder)) {
    for (const TruthItem& item : truth->items) scene.truth_ml[item.label] = item.volume_ml;
  }
  return scene;
}

Scene render_scene() {
  constexpr int kWidth = 1600;
  constexpr int kHeight = 1200;
  constexpr double kFocalPx = 1350.0;
  SyntheticScene world;
  world.shape = SolidShape::height_field;
  Scene scene;
  scene.name = "synthetic";
  scene.card.thickness_mm = 0.0;
  scene.dish = {{2.0 * world.dish_radius_mm, 2.0 * world.dish_radius_mm}, 0.0, 0.0};
  scene.pattern = draw_pattern(scene.card);
  scene.truth_ml[kFirstItemLabel] = world.volume_ml();
  const std::array positions{Vec3(-60.0, -40.0, 560.0), Vec3(90.0, -70.0, 545.0)};
  for (std::size_t i = 0; i < 2; ++i) {
    const SyntheticCamera camera =
        look_at(positions[i], Vec3(0.0, 30.0, 0.0), 0.05, kFocalPx, kWidth, kHeight);
    RenderedView rendered = render(world, camera, 1);
    scene.frames[i] = Picture({kWidth, kHeight}, PixelFormat::gray8);
    scene.labels[i] = scene.frames[i];
    scene.frames[i].pixels = std::move(rendered.gray);
    scene.labels[i].pixels = std::move(rendered.labels);
    draw_card(camera, scene.card, scene.pattern, scene.frames[i], scene.labels[i]);
    scene.lens = {kWidth, kHeight, camera.pinhole};
  }
  return scene;
}

}  // namespace traygauge::bench
