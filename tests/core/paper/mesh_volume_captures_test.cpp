// Mesh and integration on exact depth and exact planes: the floor of the method's last two stages.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "core/paper/volume/mesh_volume.hpp"
#include "tests/core/stereo/capture_scene.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge::paper {
namespace {

using test::Allocated;
using test::CaptureScene;
using test::TrueItem;

struct Outcome {
  std::vector<double> errors;  // relative, signed, one an item that is a height field
  double mean_ms = 0.0;

  double bias() const {
    double sum = 0.0;
    for (const double e : errors) sum += e;
    return sum / static_cast<double>(errors.size());
  }
  double mape() const {
    double sum = 0.0;
    for (const double e : errors) sum += std::abs(e);
    return sum / static_cast<double>(errors.size());
  }
};

const std::vector<CaptureScene>& scenes() {
  static const std::vector<CaptureScene> loaded = [] {
    std::vector<CaptureScene> all;
    for (const std::string& name : test::single_dish_captures()) all.push_back(test::load_scene(name));
    return all;
  }();
  return loaded;
}

cv::Mat1f with_noise(const cv::Mat1f& depth, double sigma_mm) {
  if (sigma_mm == 0.0) return depth;
  cv::Mat1f noise(depth.size());
  cv::RNG generator(7);
  generator.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(noise, mean, deviation);
  cv::Mat1f noisy;
  cv::scaleAdd(noise, sigma_mm / deviation[0], depth, noisy);
  return noisy;
}

Outcome measure(const FoodMeshParams& mesh_params, double noise_mm = 0.0, bool print = false) {
  Allocated<FoodMeshWorkspace> mesh_space(std::size_t{16384}, std::size_t{1600}, std::size_t{1600});
  Allocated<VolumeWorkspace> volume_space(std::size_t{16384});
  Outcome outcome;
  for (const CaptureScene& scene : scenes()) {
    const auto& view = scene.views[0];
    const cv::Mat1f depth = with_noise(scene.depth_mm, noise_mm);
    const Plane bottom =
        test::plane_in_camera({Vec3::UnitZ(), scene.bottom_height_mm}, view.camera_from_world);
    FoodMesh mesh;
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(build_food_mesh(test::view_of(depth), test::view_of(view.labels), view.camera, mesh_params,
                                *mesh_space, mesh)
                    .ok());
    EXPECT_TRUE(integrate_volume(mesh, bottom, {}, *volume_space).ok());
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    outcome.mean_ms += time.count() / static_cast<double>(scenes().size());
    for (const TrueItem& item : scene.items) {
      const auto label = static_cast<std::size_t>(item.label);
      const ItemVolume& measured = volume_space->items[label];
      const double error = measured.volume_ml / item.above_bottom_ml - 1.0;
      if (print) {
        std::printf(
            "%-17s %-10s %8.2f ml  truth %8.2f (over the dish %8.2f)  %+6.2f%%  covered %5.1f%%  max %5.1f "
            "of %5.1f mm  mean %5.1f\n",
            scene.name.c_str(), item.name.c_str(), measured.volume_ml, item.above_bottom_ml, item.volume_ml,
            item.above_bottom_ml > 0 ? 100.0 * error : 100.0 * (measured.volume_ml / item.volume_ml - 1.0),
            100.0 * mesh.coverage[label].share(), measured.max_height_mm, item.max_height_mm,
            measured.mean_height_mm);
      }
      if (item.above_bottom_ml > 0.0) outcome.errors.push_back(error);
    }
  }
  return outcome;
}

class CaptureVolume : public ::testing::Test {
 protected:
  void SetUp() override {
    if (test::captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  }
};

TEST_F(CaptureVolume, ExactDepthIsWithinTheFloorOfAHeightFieldSeenObliquely) {
  const Outcome outcome = measure({}, 0.0, true);
  std::printf("bias %+.2f%%  MAPE %.2f%%  %.2f ms\n", 100 * outcome.bias(), 100 * outcome.mape(),
              outcome.mean_ms);
  EXPECT_LT(outcome.mape(), 0.05);
  EXPECT_LT(outcome.bias(), 0.0);  // erosion and what is hidden both take away
}

TEST_F(CaptureVolume, AFinerMeshErodesLess) {
  double previous = 1.0;
  for (int points = 1024; points <= 16384; points *= 2) {
    FoodMeshParams params;
    params.points = points;
    const Outcome outcome = measure(params);
    std::printf("%6d points: bias %+.2f%% MAPE %.2f%%  %.2f ms\n", points, 100 * outcome.bias(),
                100 * outcome.mape(), outcome.mean_ms);
    EXPECT_LT(outcome.mape(), previous);
    previous = outcome.mape();
  }
}

TEST_F(CaptureVolume, DepthNoiseCountsAsVolume) {
  double previous = measure({}).bias();
  for (const double noise_mm : {1.0, 2.0}) {
    const double bias = measure({}, noise_mm).bias();
    std::printf("noise %.0f mm: bias %+.2f%%\n", noise_mm, 100 * bias);
    EXPECT_GT(bias, previous);
    previous = bias;
  }
}

}  // namespace
}  // namespace traygauge::paper
