#include "simulator/scenes/capture_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "simulator/capture/input_error.hpp"
#include "simulator/capture/json_file.hpp"
#include "simulator/capture/picture_file.hpp"
#include "simulator/capture/png_writer.hpp"
#include "simulator/render/jpeg_writer.hpp"
#include "simulator/render/sensor.hpp"
#include "simulator/render/view_renderer.hpp"
#include "simulator/scenes/capture_documents.hpp"
#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/laid_scene.hpp"
#include "simulator/scenes/scene_digest.hpp"
#include "simulator/scenes/scene_poses.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDigestKey = "made_from";
constexpr double kDepthUnitMm = 0.02;
constexpr double kMeanLevel = 0.30;    // of a phone's automatic exposure, linear
constexpr double kBrightLevel = 0.75;  // what the brightest hundredth may reach
constexpr double kBrightShare = 0.99;

std::string numbered(const char* name, std::size_t view, const char* extension) {
  return std::string(name) + "_" + std::to_string(view) + extension;
}

// The exposure that a phone would choose.
double automatic_exposure(const RenderedView& view) {
  std::vector<double> brightness;
  double sum = 0.0;
  for (std::size_t i = 0; i < view.radiance.size(); i += 7) {
    brightness.push_back(
        static_cast<double>(view.radiance[i].dot(Eigen::Vector3f(0.2126F, 0.7152F, 0.0722F))));
    sum += brightness.back();
  }
  const auto bright = brightness.begin() +
                      static_cast<std::ptrdiff_t>(kBrightShare * static_cast<double>(brightness.size() - 1));
  std::nth_element(brightness.begin(), bright, brightness.end());
  const double mean = sum / static_cast<double>(brightness.size());
  return std::min(kMeanLevel / std::max(mean, 1e-9), kBrightLevel / std::max(*bright, 1e-9));
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw OutputError(file, "writing failed");
}

void write_labels(const fs::path& file, const RenderedView& view) {
  write_png(file, {view.labels.data(), view.width, view.height, view.width, PixelFormat::gray8});
}

void write_kinds(const fs::path& file, const RenderedView& view) {
  static_assert(sizeof(TruthKind) == 1);
  const auto* pixels = reinterpret_cast<const std::uint8_t*>(view.kinds.data());
  write_png(file, {pixels, view.width, view.height, view.width, PixelFormat::gray8});
}

void write_depth(const fs::path& file, const RenderedView& view) {
  DepthPicture depth{{view.width, view.height}, std::vector<std::uint16_t>(view.depth_mm.size())};
  std::transform(view.depth_mm.begin(), view.depth_mm.end(), depth.pixels.begin(), [](float depth_mm) {
    const double units = std::round(static_cast<double>(depth_mm) / kDepthUnitMm);
    return static_cast<std::uint16_t>(std::clamp(units, 0.0, 65535.0));
  });
  write_depth_png(file, depth);
}

// A folder that disappears again unless its content was finished.
class UnfinishedFolder {
 public:
  explicit UnfinishedFolder(const fs::path& target) : target_(target), path_(target.string() + ".part") {
    std::error_code problem;
    fs::remove_all(path_, problem);
    fs::create_directories(path_, problem);
    if (problem) throw OutputError(path_, problem.message());
  }
  ~UnfinishedFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

  const fs::path& path() const { return path_; }

  void finish() {
    std::error_code problem;
    fs::remove_all(target_, problem);
    if (!problem) fs::rename(path_, target_, problem);
    if (problem) throw OutputError(target_, problem.message());
    path_.clear();
  }

 private:
  fs::path target_;
  fs::path path_;
};

std::string compose_description(const SceneDescription& scene) {
  return compose_capture(scene).dump(1) + "\n";
}

bool holds(const fs::path& file, const std::string& text) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return stream.good() && content.str() == text;
}

// Whether something was moved between two views, not the camera alone.
bool is_scene_other(const Photograph& before, const Photograph& view) {
  return !before.displaced.empty() || !view.displaced.empty() ||
         !world_from_room(view).isApprox(world_from_room(before));
}

SensorSettings sensor_of(const SceneDescription& scene, const Photograph& view, double exposure) {
  SensorSettings sensor;
  sensor.exposure = exposure * view.exposure;
  sensor.white_balance = {view.white_balance[0], 1.0, view.white_balance[1]};
  sensor.corner_loss = scene.photography.corner_loss;
  sensor.full_well_electrons = scene.photography.full_well_electrons;
  sensor.read_noise_electrons = scene.photography.read_noise_electrons;
  return sensor;
}

}  // namespace

CaptureState state_of_capture(const fs::path& folder, const SceneDescription& scene,
                              const RenderSettings& settings, const CaptureExtras& extras) {
  std::error_code ignored;
  const auto has = [&](const std::string& name) { return fs::is_regular_file(folder / name, ignored); };
  if (!has("capture.json") || !has("truth.json") || !has("card.png") || !has("depth_0.png"))
    return CaptureState::absent;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    if (!has(numbered("view", i, ".jpg")) || !has(numbered("labels", i, ".png"))) return CaptureState::absent;
    if (extras.has_kinds && !has(numbered("kinds", i, ".png"))) return CaptureState::absent;
  }
  try {
    const JsonDocument document = read_json(folder / "truth.json");
    const nlohmann::json& truth = document.value();
    const auto digest = truth.find(kDigestKey);
    const bool is_same = digest != truth.end() && *digest == digest_of(scene, settings);
    return is_same ? CaptureState::complete : CaptureState::stale;
  } catch (const InputError& problem) {
    if (problem.problem().file != folder / "truth.json") throw;
    return CaptureState::absent;
  }
}

void update_description(const fs::path& folder, const SceneDescription& scene) {
  const fs::path file = folder / "capture.json";
  const std::string text = compose_description(scene);
  if (holds(file, text)) return;
  const fs::path unfinished = file.string() + ".part";
  write_text(unfinished, text);
  std::error_code problem;
  fs::rename(unfinished, file, problem);
  if (problem) throw OutputError(file, problem.message());
}

void render_capture(const SceneDescription& scene, const fs::path& folder, const RenderSettings& settings,
                    const std::function<void(double share)>& progress, const CaptureExtras& extras) {
  const std::string digest = digest_of(scene, settings);
  LaidScene laid(scene, settings.threads);
  UnfinishedFolder unfinished(folder);
  const fs::path& out = unfinished.path();
  write_png(out / "card.png", to_gray(laid.card_print()).frame());

  std::optional<ViewRenderer> renderer;
  std::vector<std::vector<std::size_t>> visible;
  double exposure = 1.0;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    const Photograph& photograph = scene.views[i];
    if (i == 0 || is_scene_other(scene.views[i - 1], photograph)) {
      renderer.reset();
      renderer.emplace(laid.scene_of(photograph));
    }
    RenderSettings view_settings = settings;
    view_settings.seed = scene.seed;
    view_settings.view = static_cast<int>(i);
    const auto done = static_cast<double>(i);
    const auto count = static_cast<double>(scene.views.size());
    const RenderedView view = renderer->render(view_camera(scene, photograph), view_settings,
                                               [&](double share) { progress((done + share) / count); });
    if (i == 0) {
      exposure = automatic_exposure(view);
      write_depth(out / "depth_0.png", view);
    }
    const Picture picture = develop(view, sensor_of(scene, photograph, exposure),
                                    Draws(scene.seed, numbered("noise", i, "")).seed(), settings.threads);
    write_jpeg(out / numbered("view", i, ".jpg"), picture, scene.photography.jpeg_quality);
    write_labels(out / numbered("labels", i, ".png"), view);
    if (extras.has_kinds) write_kinds(out / numbered("kinds", i, ".png"), view);
    std::vector<std::size_t>& pixels = visible.emplace_back(256, 0);
    for (const std::uint8_t label : view.labels) ++pixels[label];
  }
  write_text(out / "capture.json", compose_description(scene));
  auto truth = compose_truth(laid, visible);
  truth[kDigestKey] = digest;
  write_text(out / "truth.json", truth.dump(1) + "\n");
  unfinished.finish();
}

}  // namespace traygauge
