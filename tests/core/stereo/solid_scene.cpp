#include "tests/core/stereo/solid_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace traygauge::test {
namespace {

Vec2 turned_back(const Vec2& v, double turn_rad) {
  const double c = std::cos(turn_rad);
  const double s = std::sin(turn_rad);
  return {c * v.x() + s * v.y(), c * v.y() - s * v.x()};
}

// Both ends of the ellipsoid on a ray; false when the ray misses.
bool intersect(const Solid& solid, const Vec3& origin, const Vec3& direction, std::array<double, 2>& t) {
  const auto to_unit = [&](const Vec3& v) -> Vec3 {
    const Vec2 flat = turned_back(v.head<2>(), solid.turn_rad);
    return Vec3(flat.x(), flat.y(), v.z()).cwiseQuotient(solid.semi_axes_mm);
  };
  const Vec3 o = to_unit(origin - solid.centre_mm);
  const Vec3 d = to_unit(direction);
  const double a = d.squaredNorm();
  const double b = o.dot(d);
  const double discriminant = b * b - a * (o.squaredNorm() - 1.0);
  if (discriminant <= 0.0) return false;
  t = {(-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a};
  return true;
}

cv::Mat1f lattice_noise(cv::Size size, double sigma, int correlation_px, cv::RNG& generator) {
  cv::Mat1f noise(size, 0.0F);
  if (!(sigma > 0.0)) return noise;
  generator.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
  if (correlation_px > 1) cv::GaussianBlur(noise, noise, cv::Size(), 0.5 * correlation_px);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(noise, mean, deviation);
  noise.convertTo(noise, CV_32F, sigma / deviation[0]);
  return noise;
}

Solid height_field(int label, const char* name, std::function<double(const Vec2&)> top) {
  Solid solid;
  solid.name = name;
  solid.label = label;
  solid.top = std::move(top);
  return solid;
}

}  // namespace

SolidScene::Hit SolidScene::top(const Vec2& at_mm) const {
  Hit hit{Vec3(at_mm.x(), at_mm.y(), dish.height_mm(at_mm)), 1};
  for (const Solid& solid : solids) {
    double z = kNothingMm;
    std::array<double, 2> t{};
    if (!solid.is_ellipsoid()) {
      z = solid.top(at_mm);
    } else if (intersect(solid, Vec3(at_mm.x(), at_mm.y(), 0.0), -Vec3::UnitZ(), t)) {
      z = -t[0];
    }
    if (z > hit.point_mm.z()) {
      hit.point_mm.z() = z;
      hit.label = solid.label;
    }
  }
  return hit;
}

SolidScene::Hit SolidScene::cast(const Vec3& origin_mm, const Vec3& direction) const {
  const auto field = [this](const Vec3& p) {
    Hit hit{p, p.z() < dish.height_mm(p.head<2>()) ? 1 : 0};
    for (const Solid& solid : solids) {
      if (!solid.is_ellipsoid() && p.z() < solid.top(p.head<2>())) hit.label = solid.label;
    }
    return hit;
  };
  constexpr double kStepMm = 0.8;
  double before = (max_height_mm - origin_mm.z()) / direction.z();
  const double step = kStepMm / direction.norm();
  double after = before;
  const double end = -origin_mm.z() / direction.z();
  Hit hit;
  while (hit.label == 0 && after < end) {
    before = after;
    after += step;
    hit = field(origin_mm + after * direction);
  }
  for (int i = 0; i < 24 && hit.label != 0; ++i) {
    const double middle = 0.5 * (before + after);
    const Hit here = field(origin_mm + middle * direction);
    (here.label != 0 ? after : before) = middle;
    if (here.label != 0) hit = here;
  }
  double nearest = hit.label != 0 ? after : end;
  hit.point_mm = origin_mm + nearest * direction;
  for (const Solid& solid : solids) {
    std::array<double, 2> t{};
    if (!solid.is_ellipsoid() || !intersect(solid, origin_mm, direction, t) || t[0] > nearest) continue;
    nearest = t[0];
    hit = {origin_mm + nearest * direction, solid.label};
  }
  return hit;
}

double SolidScene::column_ml(int label, double step_mm) const {
  const double reach = dish.profile.semi_axes_mm().maxCoeff();
  double sum = 0.0;
  for (double y = -reach + 0.5 * step_mm; y < reach; y += step_mm) {
    for (double x = -reach + 0.5 * step_mm; x < reach; x += step_mm) {
      const Vec2 at = dish.place.centre_mm + Vec2(x, y);
      const Hit hit = top(at);
      if (hit.label == label) sum += hit.point_mm.z() - dish.height_mm(at);
    }
  }
  return sum * step_mm * step_mm / 1000.0;
}

double SolidScene::closed_ml(int label) const {
  for (const Solid& solid : solids) {
    if (solid.label != label || !solid.is_ellipsoid()) continue;
    return 4.0 / 3.0 * M_PI * solid.semi_axes_mm.prod() / 1000.0;
  }
  return column_ml(label);
}

TrueGrid cast_grid(const SolidScene& scene, const SceneCamera& camera, const SceneNoise& noise,
                   double dish_samples) {
  const double tilt = camera.tilt_deg * M_PI / 180.0;
  const double azimuth = camera.azimuth_deg * M_PI / 180.0;
  const Vec3 target(scene.dish.place.centre_mm.x(), scene.dish.place.centre_mm.y(), 10.0);
  const Vec3 back(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
  const Vec3 origin = target + camera.distance_mm * back;
  const Vec3 right(-std::sin(azimuth), std::cos(azimuth), 0.0);
  const Vec3 up = back.cross(right);
  const Vec2 semi = scene.dish.profile.semi_axes_mm();
  const double area = M_PI * semi.x() * semi.y() * std::cos(tilt);
  const double pitch = std::sqrt(area / dish_samples) / camera.distance_mm;
  const int half = static_cast<int>(1.08 * semi.maxCoeff() / camera.distance_mm / pitch) + 2;
  const int size = 2 * half + 1;
  TrueGrid grid(size, size);
  grid.camera_mm = origin;
  cv::RNG generator(noise.seed);
  const cv::Mat1f depth = lattice_noise({size, size}, noise.depth_mm, noise.correlation_px, generator);
  const cv::Mat1f shift_x = lattice_noise({size, size}, noise.label_px, noise.correlation_px, generator);
  const cv::Mat1f shift_y = lattice_noise({size, size}, noise.label_px, noise.correlation_px, generator);
  const auto direction = [&](double x, double y) -> Vec3 {
    return -back + pitch * (x - half) * right - pitch * (y - half) * up;
  };
  const auto is_on_dish = [&](const SolidScene::Hit& hit) {
    return hit.label > 1 || scene.dish.profile.inset_mm(scene.dish.to_dish(hit.point_mm.head<2>())) > 0.0;
  };
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec3 ray = direction(x, y);
      const SolidScene::Hit hit = scene.cast(origin, ray);
      if (!is_on_dish(hit)) continue;
      const auto at = [&](double t) { return static_cast<float>(t); };
      const Vec3 p = hit.point_mm + static_cast<double>(depth(y, x)) * ray.normalized();
      const std::size_t k = grid.index(x, y);
      grid.points[k] = {at(p.x()), at(p.y()), at(p.z())};
      grid.evidence[k] = SurfaceEvidence::both;
      grid.labels[k] = static_cast<std::uint8_t>(hit.label);
      if (noise.label_px > 0.0) {
        const SolidScene::Hit moved = scene.cast(origin, direction(x + static_cast<double>(shift_x(y, x)),
                                                                   y + static_cast<double>(shift_y(y, x))));
        if (is_on_dish(moved)) grid.labels[k] = static_cast<std::uint8_t>(moved.label);
      }
    }
  }
  return grid;
}

Solid box(int label, const Vec2& centre, const Vec2& half, double turn_rad, double top_mm) {
  return height_field(label, "box", [=](const Vec2& at) {
    const Vec2 local = turned_back(at - centre, turn_rad).cwiseAbs();
    return local.x() < half.x() && local.y() < half.y() ? top_mm : kNothingMm;
  });
}

Solid cylinder(int label, const Vec2& centre, double radius, double top_mm) {
  return height_field(label, "cylinder", [=](const Vec2& at) {
    return (at - centre).squaredNorm() < radius * radius ? top_mm : kNothingMm;
  });
}

Solid cone(int label, const Vec2& centre, double radius, double base_mm, double height) {
  return height_field(label, "cone", [=](const Vec2& at) {
    const double r = (at - centre).norm();
    return r < radius ? base_mm + height * (1.0 - r / radius) : kNothingMm;
  });
}

Solid cap(int label, const Vec2& centre, double radius, double base_mm, double height) {
  const double sphere = (radius * radius + height * height) / (2.0 * height);
  return height_field(label, "cap", [=](const Vec2& at) {
    const double r2 = (at - centre).squaredNorm();
    return r2 < radius * radius ? base_mm + height - sphere + std::sqrt(sphere * sphere - r2) : kNothingMm;
  });
}

Solid wedge(int label, const Vec2& tip, double radius, double angle_rad, double turn_rad, double top_mm) {
  return height_field(label, "wedge", [=](const Vec2& at) {
    const Vec2 local = turned_back(at - tip, turn_rad);
    const bool is_inside =
        local.norm() < radius && std::abs(std::atan2(local.y(), local.x())) < 0.5 * angle_rad;
    return is_inside ? top_mm : kNothingMm;
  });
}

Solid ball_columns(int label, const std::vector<Vec2>& centres, double radius, double base_mm) {
  return height_field(label, "balls", [=](const Vec2& at) {
    double top = kNothingMm;
    for (const Vec2& centre : centres) {
      const double rest = radius * radius - (at - centre).squaredNorm();
      if (rest > 0.0) top = std::max(top, base_mm + radius + std::sqrt(rest));
    }
    return top;
  });
}

Solid heap(int label, const Vec2& centre, const Vec2& radius, double base_mm, double height, double bump_mm,
           double wavelength_mm, std::uint32_t seed) {
  cv::RNG generator(seed);
  std::vector<Vec3> waves;  // wave vector, phase
  for (int i = 0; i < 6; ++i) {
    const double angle = generator.uniform(0.0, 2.0 * M_PI);
    const double length = wavelength_mm * generator.uniform(0.7, 1.6);
    waves.emplace_back(2.0 * M_PI / length * std::cos(angle), 2.0 * M_PI / length * std::sin(angle),
                       generator.uniform(0.0, 2.0 * M_PI));
  }
  return height_field(label, "heap", [=](const Vec2& at) {
    const double r2 = (at - centre).cwiseQuotient(radius).squaredNorm();
    if (r2 >= 1.0) return kNothingMm;
    double bump = 0.0;
    for (const Vec3& wave : waves) bump += std::sin(wave.head<2>().dot(at) + wave.z());
    const double rise = 1.0 - r2;
    return base_mm + height * rise * (1.3 - 0.3 * rise) + bump_mm * bump / 3.0 * std::min(1.0, 4.0 * rise);
  });
}

Solid ellipsoid(int label, const Vec3& centre, const Vec3& semi_axes, double turn_rad) {
  Solid solid;
  solid.name = "ellipsoid";
  solid.label = label;
  solid.centre_mm = centre;
  solid.semi_axes_mm = semi_axes;
  solid.turn_rad = turn_rad;
  return solid;
}

Solid liquid(int label, const InnerSurface& dish, double level_mm) {
  Solid solid = height_field(label, "liquid", [dish, level_mm](const Vec2& at) {
    return dish.profile.inset_mm(dish.to_dish(at)) > 3.0 ? level_mm : kNothingMm;
  });
  solid.is_liquid = true;
  return solid;
}

namespace {

InnerSurface dish(std::array<double, 2> size, std::initializer_list<DishProfilePoint> profile, Vec2 centre,
                  double turn_rad) {
  DishModel model;
  model.outer_size_mm = size;
  for (const DishProfilePoint& point : profile) model.profile_points[model.profile_size++] = point;
  model.bottom_height_mm = model.profile_points[model.profile_size - 1].height_mm;
  model.rim_height_mm = model.profile_points[1].height_mm;
  InnerSurface placed;
  (void)placed.profile.set(model).ok();
  placed.place = {centre, {std::cos(turn_rad), std::sin(turn_rad)}};
  return placed;
}

}  // namespace

InnerSurface dinner_plate() {
  return dish({260.0, 260.0},
              {{0, 21.4}, {1.6, 22.0}, {4.5, 21.4}, {28, 15.5}, {36, 11.0}, {43, 6.6}, {49, 4.5}},
              {180.0, -90.0}, 0.0);
}

InnerSurface soup_bowl() {
  return dish({152.0, 152.0},
              {{0, 54.2},
               {1.5, 55.0},
               {2.8, 54.1},
               {4.2, 51.5},
               {8.12, 38.782},
               {13.02, 28.955},
               {19.88, 19.749},
               {28.7, 12.147},
               {37.52, 7.642},
               {45.36, 5.586},
               {53.2, 5.0}},
              {-120.0, 60.0}, 0.0);
}

InnerSurface oval_plate() {
  return dish({300.0, 210.0},
              {{0, 23.4}, {1.6, 24.0}, {4.5, 23.5}, {19, 18.6}, {26, 12.4}, {32, 7.0}, {38, 4.0}},
              {150.0, 110.0}, 0.5);
}

}  // namespace traygauge::test
