// What the tests of rectification share: memory, dish regions, random pairs of cameras.
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/random.hpp"
#include "core/paper/rectification/polar_rectification.hpp"
#include "tests/support/synthetic_scene.hpp"

namespace traygauge::paper {

struct OwnedWorkspace {
  explicit OwnedWorkspace(const RectificationParams& params) {
    ArenaPlan plan;
    RectificationWorkspace planned;
    planned.allocate(plan, params);
    memory.resize(plan.high_water_bytes() / sizeof(Line));
    Arena arena(std::as_writable_bytes(std::span(memory)));
    tables.allocate(arena, params);
  }
  struct alignas(kArenaAlignmentBytes) Line {
    std::byte bytes[kArenaAlignmentBytes];
  };
  std::vector<Line> memory;
  RectificationWorkspace tables;
};

// A picture that owns its pixels.
struct Picture {
  Picture() = default;
  Picture(int width_, int height_)
      : width(width_), height(height_), pixels(static_cast<std::size_t>(width_ * height_)) {}
  ImageView<std::uint8_t> view() { return {pixels.data(), width, height}; }
  ImageView<const std::uint8_t> view() const { return {pixels.data(), width, height}; }
  bool is_set(const Vec2& at) const {
    const auto x = static_cast<int>(std::lround(at.x()));
    const auto y = static_cast<int>(std::lround(at.y()));
    return view().contains(x, y) && view().at(x, y) != 0;
  }

  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

inline double uniform(Random& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

// Where the disc z = 0 of this radius is seen.
inline Picture disc_region(const SyntheticCamera& camera, double radius_mm) {
  Picture region(camera.width, camera.height);
  const Vec3 centre = camera.centre();
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Vec3 ray = camera.direction(Vec2(x, y));
      const double t = -centre.z() / ray.z();
      const bool hit = t > 0.0 && (centre + t * ray).norm() <= radius_mm;
      region.view().at(x, y) = hit ? 1 : 0;
    }
  }
  return region;
}

// Two cameras over a dish, and the rectification of what they see of it.
struct Pair {
  static constexpr double kDishRadius_mm = 110.0;

  SyntheticCamera first;
  SyntheticCamera second;
  Picture first_region;
  Picture second_region;
  Pose motion;

  void look() {
    first_region = disc_region(first, kDishRadius_mm);
    second_region = disc_region(second, kDishRadius_mm);
    motion = second_from_first(first, second);
  }
  const SyntheticCamera& camera(int view) const { return view == 0 ? first : second; }
  const Picture& region(int view) const { return view == 0 ? first_region : second_region; }
  // The image of the other camera's centre; far away but finite when at infinity.
  Vec2 epipole(int view) const {
    const Vec3 e = camera(view).camera_from_world * camera(1 - view).centre();
    const double depth = e.z() == 0.0 ? 1e-12 : e.z();
    return camera(view).pinhole.pixel(Vec2(e.x() / depth, e.y() / depth));
  }
  Status build(PolarRectification& rectification, OwnedWorkspace& workspace,
               const RectificationParams& params, std::span<const RayMatch> inliers = {}) const {
    return rectification.build({first.pinhole, first_region.view()}, {second.pinhole, second_region.view()},
                               motion, inliers, params, workspace.tables);
  }
};

// Where the epipole of the first view lies.
enum class EpipolePlace : std::uint8_t { inside, border, outside, very_far, infinity };

inline SyntheticCamera random_camera(Random& random) {
  const double tilt = uniform(random, 0.0, 0.6);
  const double azimuth = uniform(random, -3.1, 3.1);
  const double distance = uniform(random, 380.0, 560.0);
  const Vec3 position(distance * std::sin(tilt) * std::cos(azimuth),
                      distance * std::sin(tilt) * std::sin(azimuth), distance * std::cos(tilt));
  const Vec3 target(uniform(random, -15.0, 15.0), uniform(random, -15.0, 15.0), 0.0);
  return look_at(position, target, uniform(random, -3.1, 3.1), uniform(random, 900.0, 1200.0), 640, 560);
}

inline Vec2 random_epipole(Random& random, EpipolePlace place, const SyntheticCamera& camera) {
  const double around = uniform(random, -3.1, 3.1);
  const Vec2 heading(std::cos(around), std::sin(around));
  const Vec2 centre = camera.project(Vec3::Zero());
  const Vec3 on_rim(Pair::kDishRadius_mm * heading.x(), Pair::kDishRadius_mm * heading.y(), 0.0);
  switch (place) {
    case EpipolePlace::inside:
      return centre + uniform(random, 0.0, 0.9) * (camera.project(on_rim) - centre);
    case EpipolePlace::border:
      return camera.project(on_rim);
    case EpipolePlace::outside:
      return centre + std::exp(uniform(random, 6.0, 10.5)) * heading;
    default:
      return centre + 1e9 * heading;
  }
}

// The second camera has moved along the line to the epipole, forwards or backwards.
inline Pair random_pair(Random& random, EpipolePlace place) {
  Pair pair;
  do {
    pair.first = random_camera(random);
    const Vec2 ray = pair.first.pinhole.ray(random_epipole(random, place, pair.first));
    Vec3 heading = Vec3(ray.x(), ray.y(), 1.0).normalized();
    if (place == EpipolePlace::infinity) heading.z() = 0.0;
    const double sign = random.below(2) == 0 ? -1.0 : 1.0;
    const Vec3 move = pair.first.camera_from_world.rotation.transpose() * heading.normalized();
    const Vec3 position = pair.first.centre() + sign * uniform(random, 60.0, 160.0) * move;
    const Vec3 target(uniform(random, -15.0, 15.0), uniform(random, -15.0, 15.0), 0.0);
    pair.second =
        look_at(position, target, uniform(random, -3.1, 3.1), uniform(random, 900.0, 1200.0), 640, 560);
    if (place == EpipolePlace::infinity && random.below(2) == 0) {
      pair.second.camera_from_world.rotation = pair.first.camera_from_world.rotation;  // pure sideways motion
      pair.second.camera_from_world.translation = -(pair.first.camera_from_world.rotation * position);
    }
  } while (pair.second.centre().z() < 200.0);
  pair.look();
  return pair;
}

}  // namespace traygauge::paper
