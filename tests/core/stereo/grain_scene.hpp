// Two pictures of a plane with random grain, seen in closed form.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "core/image/gray_pyramid.hpp"
#include "core/stereo/surface_view.hpp"
#include "tests/core/stereo/synthetic_scene.hpp"

namespace traygauge::test {

struct GrainyPlane {
  double height_mm = 0.0;  // over where it is described to lie
  double tilt = 0.0;       // mm of height a mm along x
  double contrast = 20.0;  // of its grain, grey values
  double noise = 2.0;      // of the pictures
  double shift_mm = 0.0;   // of the grain, in the second picture, across the line between the cameras
};

class GrainScene {
 public:
  GrainScene(std::mt19937& random, std::uint8_t label) : random_(random) {
    std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
    const double azimuth = angle(random_);
    views_ = {look_at_origin(450.0, 0.15, azimuth), look_at_origin(450.0, 0.5, azimuth)};
    grain_ = cv::Mat1f(256, 256);
    cv::randn(grain_, 0.0, 1.0);
    // Grains of 2 mm; the texture repeats every 256 mm.
    cv::GaussianBlur(grain_, grain_, {}, 0.8, 0.8, cv::BORDER_REFLECT_101);
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(grain_, mean, deviation);
    grain_ /= deviation[0];
    for (cv::Mat1b& of_view : labels) of_view = cv::Mat1b(views_[0].height, views_[0].width, label);
  }

  // Both pictures anew.
  void render(const GrainyPlane& plane) {
    std::normal_distribution<double> noise(0.0, plane.noise);
    const Vec3 line = (views_[1].centre() - views_[0].centre()).normalized();
    const Vec2 across(-line.y(), line.x());
    for (std::size_t i = 0; i < 2; ++i) {
      const SyntheticView& view = views_[i];
      pictures[i] = cv::Mat1b(view.height, view.width);
      for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
          const Vec3 ray = view.world_ray(x, y);
          const Vec3 eye = view.centre();
          // eye.z + t ray.z = height + tilt (eye.x + t ray.x)
          const double t =
              (plane.height_mm + plane.tilt * eye.x() - eye.z()) / (ray.z() - plane.tilt * ray.x());
          Vec2 place = (eye + t * ray).head<2>();
          if (i == 1) place += plane.shift_mm * across;
          pictures[i](y, x) =
              cv::saturate_cast<std::uint8_t>(130.0 + plane.contrast * grain_at(place) + noise(random_));
        }
      }
    }
  }

  std::array<cv::Mat1b, 2> labels;
  std::array<cv::Mat1b, 2> pictures;

  // Both pictures as core reads them.
  class Seen {
   public:
    explicit Seen(const GrainScene& scene)
        : scene_(scene),
          views{SurfaceView{pyramid(0), lens(0), label(0), pose(0)},
                SurfaceView{pyramid(1), lens(1), label(1), pose(1)}} {}
    Seen(const Seen&) = delete;
    Seen& operator=(const Seen&) = delete;

   private:
    const GrayPyramid& pyramid(std::size_t i) {
      PyramidWorkspace workspace;
      for (std::size_t level = 0; level < workspace.storage.size(); ++level) {
        std::vector<std::uint8_t>& storage = storage_[i][level];
        storage.resize(scene_.pictures[i].total());
        workspace.storage[level] = storage;
      }
      const cv::Mat1b& picture = scene_.pictures[i];
      return pyramids_[i] = build_pyramid({picture.data, picture.cols, picture.rows}, workspace);
    }
    const LensModel& lens(std::size_t i) {
      lenses_[i].width = scene_.views_[i].width;
      lenses_[i].height = scene_.views_[i].height;
      lenses_[i].pinhole = scene_.views_[i].camera;
      return lenses_[i];
    }
    ImageView<const std::uint8_t> label(std::size_t i) const {
      return {scene_.labels[i].data, scene_.labels[i].cols, scene_.labels[i].rows};
    }
    const Pose& pose(std::size_t i) const { return scene_.views_[i].camera_from_world; }

    const GrainScene& scene_;
    std::array<std::array<std::vector<std::uint8_t>, kPyramidLevels - 1>, 2> storage_;
    std::array<GrayPyramid, 2> pyramids_;
    std::array<LensModel, 2> lenses_;

   public:
    std::array<SurfaceView, 2> views;
  };

 private:
  double grain_at(const Vec2& place) const {
    const double x = place.x() + 128.0;
    const double y = place.y() + 128.0;
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y));
    if (column < 0 || row < 0 || column + 1 >= grain_.cols || row + 1 >= grain_.rows) return 0.0;
    const double u = x - column;
    const double v = y - row;
    return (1.0 - v) * ((1.0 - u) * grain_(row, column) + u * grain_(row, column + 1)) +
           v * ((1.0 - u) * grain_(row + 1, column) + u * grain_(row + 1, column + 1));
  }

  std::mt19937& random_;
  std::array<SyntheticView, 2> views_;
  cv::Mat1f grain_;
};

}  // namespace traygauge::test
