#include "tests/support/synthetic_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/cameras.hpp"

namespace traygauge {
namespace {

constexpr double kPi = std::numbers::pi;

double lattice_value(int x, int y, int z, std::uint32_t seed) {
  std::uint32_t h = seed * 0x9E3779B9U;
  for (const int c : {x, y, z}) {
    h ^= static_cast<std::uint32_t>(c) + 0x7F4A7C15U;
    h *= 0x85EBCA6BU;
    h ^= h >> 15U;
    h *= 0xC2B2AE35U;
    h ^= h >> 13U;
  }
  return h / 4294967295.0;
}

// Lattice values blended by 3s² − 2s³: smooth, one wavelength about two cells.
double value_noise(const Vec3& p, std::uint32_t seed) {
  const Vec3 floor = p.array().floor();
  const Vec3 f = p - floor;
  const Vec3 s = f.array() * f.array() * (3.0 - 2.0 * f.array());
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1;
    const int dy = (corner >> 1) & 1;
    const int dz = corner >> 2;
    const double weight =
        (dx ? s.x() : 1.0 - s.x()) * (dy ? s.y() : 1.0 - s.y()) * (dz ? s.z() : 1.0 - s.z());
    sum += weight * lattice_value(static_cast<int>(floor.x()) + dx, static_cast<int>(floor.y()) + dy,
                                  static_cast<int>(floor.z()) + dz, seed);
  }
  return sum;
}

// Smallest t in front of the camera at which the point satisfies `inside`; keeps the nearer of both.
template <class Inside>
void try_hit(double candidate, const Inside& inside, double& t) {
  if (candidate > 0.0 && candidate < t && inside(candidate)) t = candidate;
}

// Roots of a t² + b t + c.
template <class Inside>
void try_roots(double a, double b, double c, const Inside& inside, double& t) {
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0 || a == 0.0) return;
  const double root = std::sqrt(discriminant);
  try_hit((-b - root) / (2.0 * a), inside, t);
  try_hit((-b + root) / (2.0 * a), inside, t);
}

void hit_cone(const SyntheticScene& scene, const Vec3& o, const Vec3& d, double& t) {
  const double k = scene.radius_mm / scene.height_mm;
  const double z = scene.height_mm - o.z();  // r = k (height − z) on the cone
  const auto inside = [&](double s) {
    const double height = o.z() + s * d.z();
    return height >= 0.0 && height <= scene.height_mm;
  };
  try_roots(d.x() * d.x() + d.y() * d.y() - k * k * d.z() * d.z(),
            2.0 * (o.x() * d.x() + o.y() * d.y() + k * k * z * d.z()),
            o.x() * o.x() + o.y() * o.y() - k * k * z * z, inside, t);
}

void hit_hemisphere(const SyntheticScene& scene, const Vec3& o, const Vec3& d, double& t) {
  try_roots(
      d.squaredNorm(), 2.0 * o.dot(d), o.squaredNorm() - scene.radius_mm * scene.radius_mm,
      [&](double s) { return o.z() + s * d.z() >= 0.0; }, t);
}

// Where the ray is between −radius and radius in x and y, and between 0 and height.
bool clip_to_bounds(const SyntheticScene& scene, const Vec3& o, const Vec3& d, double& enter, double& leave) {
  const Vec3 low(-scene.radius_mm, -scene.radius_mm, 0.0);
  const Vec3 high(scene.radius_mm, scene.radius_mm, scene.height_mm);
  enter = 0.0;
  leave = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double one = (low[axis] - o[axis]) / d[axis];
    const double other = (high[axis] - o[axis]) / d[axis];
    enter = std::max(enter, std::min(one, other));
    leave = std::min(leave, std::max(one, other));
  }
  return enter < leave;
}

void hit_height_field(const SyntheticScene& scene, const Vec3& o, const Vec3& d, double& t) {
  constexpr int kSteps = 400;
  constexpr int kBisections = 50;
  double enter = 0.0;
  double leave = 0.0;
  if (!clip_to_bounds(scene, o, d, enter, leave)) return;
  const auto above = [&](double s) {
    const Vec3 p = o + s * d;
    return p.z() - scene.height(p.head<2>() + scene.centre_mm);
  };
  double low = enter;
  for (int i = 1; i <= kSteps; ++i) {
    double high = enter + (leave - enter) * i / kSteps;
    if (above(high) > 0.0) {
      low = high;
      continue;
    }
    for (int k = 0; k < kBisections; ++k) {
      const double middle = 0.5 * (low + high);
      (above(middle) > 0.0 ? low : high) = middle;
    }
    t = std::min(t, high);
    return;
  }
}

std::uint8_t label_at(const SyntheticScene& scene, const Vec3& point) {
  constexpr double kOnDish_mm = 1e-6;
  if (point.z() > kOnDish_mm) return 2;
  return point.head<2>().norm() <= scene.dish_radius_mm ? 1 : 0;
}

}  // namespace

double SyntheticScene::volume_ml() const {
  const double square = radius_mm * radius_mm;
  switch (shape) {
    case SolidShape::none:
      return 0.0;
    case SolidShape::cone:
      return kPi * square * height_mm / 3.0 / 1000.0;
    case SolidShape::hemisphere:
      return 2.0 * kPi * square * radius_mm / 3.0 / 1000.0;
    case SolidShape::box:
      return 4.0 * square * height_mm / 1000.0;
    case SolidShape::height_field:
      return square * height_mm / 1000.0;
  }
  return 0.0;
}

double SyntheticScene::height(const Vec2& point_mm) const {
  const Vec2 p = point_mm - centre_mm;
  const bool in_square = std::max(std::abs(p.x()), std::abs(p.y())) <= radius_mm;
  switch (shape) {
    case SolidShape::none:
      return 0.0;
    case SolidShape::cone:
      return std::max(0.0, height_mm * (1.0 - p.norm() / radius_mm));
    case SolidShape::hemisphere:
      return std::sqrt(std::max(0.0, radius_mm * radius_mm - p.squaredNorm()));
    case SolidShape::box:
      return in_square ? height_mm : 0.0;
    case SolidShape::height_field: {
      if (!in_square) return 0.0;
      const double wave =
          std::cos(kPi * p.x() / (2.0 * radius_mm)) * std::cos(kPi * p.y() / (2.0 * radius_mm));
      return height_mm * wave * wave;
    }
  }
  return 0.0;
}

double SyntheticScene::texture(const Vec3& point_mm) const {
  constexpr int kOctaves = 3;
  double value = 0.0;
  double cell = 0.5 * texture_mm;
  Vec3 at_mm = point_mm;
  if (point_mm.z() > 1e-6) at_mm.head<2>() -= solid_texture_shift_mm;
  for (std::uint32_t octave = 0; octave < kOctaves; ++octave, cell *= 0.5) {
    value += value_noise(at_mm / cell, texture_seed + octave);
  }
  return 255.0 * value / kOctaves;
}

bool SyntheticScene::intersect(const Vec3& origin, const Vec3& direction, double& t) const {
  const Vec3 o = origin - Vec3(centre_mm.x(), centre_mm.y(), 0.0);
  t = std::numeric_limits<double>::infinity();
  try_hit(
      -o.z() / direction.z(), [](double) { return true; }, t);
  double enter = 0.0;
  double leave = 0.0;
  switch (shape) {
    case SolidShape::none:
      break;
    case SolidShape::cone:
      hit_cone(*this, o, direction, t);
      break;
    case SolidShape::hemisphere:
      hit_hemisphere(*this, o, direction, t);
      break;
    case SolidShape::box:
      if (clip_to_bounds(*this, o, direction, enter, leave)) t = std::min(t, enter);
      break;
    case SolidShape::height_field:
      hit_height_field(*this, o, direction, t);
      break;
  }
  return std::isfinite(t);
}

Vec3 SyntheticCamera::direction(const Vec2& pixel) const {
  const Vec2 ray = pinhole.ray(pixel);
  return camera_from_world.rotation.transpose() * Vec3(ray.x(), ray.y(), 1.0);
}

Vec2 SyntheticCamera::project(const Vec3& point_mm) const {
  const Vec3 p = camera_from_world * point_mm;
  return pinhole.pixel(p.head<2>() / p.z());
}

SyntheticCamera look_at(const Vec3& position, const Vec3& target, double roll_rad, double focal_px, int width,
                        int height) {
  const PinholeCamera pinhole{focal_px, focal_px, 0.5 * (width - 1), 0.5 * (height - 1)};
  return {pinhole, width, height, test::looking_at(position, target, roll_rad)};
}

Pose second_from_first(const SyntheticCamera& first, const SyntheticCamera& second) {
  const Pose world_from_first = first.camera_from_world.inverse();
  return {second.camera_from_world.rotation * world_from_first.rotation,
          second.camera_from_world * world_from_first.translation};
}

RenderedView render(const SyntheticScene& scene, const SyntheticCamera& camera, int samples) {
  RenderedView view;
  view.width = camera.width;
  view.height = camera.height;
  const Vec3 centre = camera.centre();
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      double t = 0.0;
      const Vec3 direction = camera.direction(Vec2(x, y));
      const bool hit = scene.intersect(centre, direction, t);
      view.depth_mm.push_back(hit ? t : 0.0);
      view.labels.push_back(hit ? label_at(scene, centre + t * direction) : std::uint8_t{0});
      double sum = 0.0;
      for (int i = 0; i < samples * samples; ++i) {
        const Vec2 offset(i % samples, i / samples);
        const Vec2 at = Vec2(x, y) + (offset.array() + 0.5).matrix() / samples - Vec2(0.5, 0.5);
        const Vec3 ray = camera.direction(at);
        if (scene.intersect(centre, ray, t)) sum += scene.texture(centre + t * ray);
      }
      view.gray.push_back(static_cast<std::uint8_t>(std::lround(sum / (samples * samples))));
    }
  }
  return view;
}

bool surface_point(const SyntheticScene& scene, const SyntheticCamera& camera, const Vec2& pixel,
                   Vec3& point) {
  double t = 0.0;
  if (!scene.intersect(camera.centre(), camera.direction(pixel), t)) return false;
  point = camera.centre() + t * camera.direction(pixel);
  return true;
}

bool is_visible(const SyntheticScene& scene, const SyntheticCamera& camera, const Vec3& point) {
  constexpr double kOnSurface = 1e-6;  // of the distance
  if ((camera.camera_from_world * point).z() <= 0.0) return false;
  const Vec2 pixel = camera.project(point);
  if (pixel.minCoeff() < 0.0 || pixel.x() > camera.width - 1 || pixel.y() > camera.height - 1) return false;
  double t = 0.0;
  const Vec3 to_point = point - camera.centre();
  return scene.intersect(camera.centre(), to_point, t) && t > 1.0 - kOnSurface;
}

}  // namespace traygauge
