// Rays that the pixels of a camera see along.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "simulator/render/lens.hpp"
#include "simulator/render/ray_scene.hpp"
#include "simulator/render/view_camera.hpp"

namespace traygauge {

// Where the camera is after a share of the exposure, 0 to 1: its centre moves straight, its axes turn evenly.
// camera_from_world.
Eigen::Isometry3d pose_in_exposure(const ViewCamera& camera, double share);

// All that can be drawn about one ray; each in [0, 1).
struct RaySample {
  Eigen::Vector2f in_pixel = Eigen::Vector2f::Constant(0.5F);
  Eigen::Vector2f in_aperture = Eigen::Vector2f::Zero();
  float in_exposure = 0.5F;
};

// A pixel weighs its surroundings by a tent that reaches from the centre to the neighbours' centres.
class CameraRays {
 public:
  // Throws std::invalid_argument for a camera that Lens refuses or whose aperture or focus make no sense.
  explicit CameraRays(const ViewCamera& camera);

  // What a pixel sees along; found once, used for all its rays.
  struct Pixel {
    Eigen::Vector2d direction = Eigen::Vector2d::Zero();
    Eigen::Matrix2d direction_by_pixel = Eigen::Matrix2d::Identity();
    // Where its rays meet in the plane of focus, from the middle of the exposure's camera, and by pixel.
    Eigen::Vector3f focus_mm = Eigen::Vector3f::UnitZ();
    Eigen::Matrix<float, 3, 2> focus_by_pixel_mm = Eigen::Matrix<float, 3, 2>::Zero();
  };
  Pixel pixel(int x, int y) const;
  bool has_aperture() const { return aperture_radius_mm_ > 0.0; }
  bool moves() const { return moves_; }
  // Of a pixel in the middle of the picture, at distance 1.
  float pixel_width() const { return pixel_width_; }

  // Towards whatever is imaged around the pixel's centre; the direction has length 1. In single precision:
  // within 1e-3 px.
  Ray ray(const Pixel& pixel, const RaySample& sample) const;
  // Through the pixel's centre and the pupil's, in the middle of the exposure; its direction is 1 along the
  // optical axis, so that a hit's distance is its depth in mm.
  Ray central_ray(const Pixel& pixel) const;

 private:
  Ray moving_ray(const Pixel& pixel, const RaySample& sample, const Eigen::Vector2f& offset_px,
                 const Eigen::Vector2f& in_pupil_mm) const;
  Eigen::Isometry3d world_from_camera(double share) const;

  Lens lens_;
  float pixel_width_;
  double aperture_radius_mm_;
  double focus_mm_;
  bool moves_;
  Eigen::Vector3d center_start_;
  Eigen::Vector3d center_end_;
  Eigen::Quaterniond turn_start_;  // world from camera
  Eigen::Quaterniond turn_end_;
  Eigen::Isometry3d middle_;
  Eigen::Vector3f center_mm_;               // of the camera in the middle of the exposure
  Eigen::Matrix<float, 3, 2> pupil_by_mm_;  // axes of the aperture, there
};

}  // namespace traygauge
