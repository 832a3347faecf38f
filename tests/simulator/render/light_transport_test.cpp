// Light in rendered pictures against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "simulator/render/view_renderer.hpp"
#include "tests/simulator/render/render_scenes.hpp"

namespace traygauge {
namespace {

// Share of the hemisphere's cosine-weighed light that a rectangle parallel to the surface fills, with a
// corner above the point: sides a, b at height h (Howell, factor B-3; signed).
double corner_factor(double a, double b, double h) {
  const double x = a / h;
  const double y = b / h;
  const double p = std::sqrt(1.0 + x * x);
  const double q = std::sqrt(1.0 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2.0 * std::numbers::pi);
}

double rectangle_factor(double x0, double x1, double y0, double y1, double h) {
  if (x1 <= x0) return 0.0;
  return corner_factor(x1, y1, h) - corner_factor(x0, y1, h) - corner_factor(x1, y0, h) +
         corner_factor(x0, y0, h);
}

// Where a pixel's centre looks at the plane z = height_mm; for a camera without distortion.
Eigen::Vector3d point_on_plane(const ViewCamera& camera, int x, int y, double height_mm) {
  const Eigen::Isometry3d pose = camera.camera_from_world.inverse();
  const Eigen::Vector3d direction =
      pose.linear() * Eigen::Vector3d((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0);
  return pose.translation() + direction * ((height_mm - pose.translation().z()) / direction.z());
}

struct Error {
  double mean = 0.0;
  double rms = 0.0;
  int count = 0;
};

// Of the pixels' green radiance to a function of the point on the floor, in shares of `level`.
template <class Expected>
Error compare(const RenderedView& view, const ViewCamera& camera, double level, const Expected& expected) {
  Error error;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const auto at = static_cast<std::size_t>(y * view.width + x);
      const double off =
          (static_cast<double>(view.radiance[at].y()) - expected(point_on_plane(camera, x, y, 0.0))) / level;
      error.mean += off;
      error.rms += off * off;
      ++error.count;
    }
  }
  error.mean /= error.count;
  error.rms = std::sqrt(error.rms / error.count);
  return error;
}

TEST(LightTransport, APlaneUnderARectangleOfLightIsAsBrightAsItsFormFactorSays) {
  Scene scene;
  scene.objects.push_back({square(3000.0F, 0.0F), matt(0.6F), 0});
  scene.lights.push_back(ceiling_light({100.0F, -50.0F}, {500.0F, 300.0F}, 700.0F, 4.0F));
  const ViewCamera camera = camera_at({0.0, -500.0, 400.0}, {0.0, 0.0, 0.0}, 96, 72, 70.0);
  const RenderedView view = ViewRenderer(scene).render(camera);
  const auto expected = [&](const Eigen::Vector3d& p) {
    return 0.6 * 4.0 * rectangle_factor(-150.0 - p.x(), 350.0 - p.x(), -200.0 - p.y(), 100.0 - p.y(), 700.0);
  };
  const double level = expected({0.0, 0.0, 0.0});
  const Error error = compare(view, camera, level, expected);
  std::cout << "noise " << 100.0 * error.rms << " %, mean error " << 100.0 * error.mean << " %\n";
  EXPECT_LT(std::abs(error.mean), 4.0 * error.rms / std::sqrt(error.count) + 2e-4);
  EXPECT_LT(error.rms, 0.006);
}

// A black half-plane hides a growing part of the light: what is left is a rectangle again.
TEST(LightTransport, ThePenumbraOfAStraightEdgeIsThatOfTheLightsSeenPart) {
  constexpr double kEdge_mm = 150.0;
  constexpr double kLight_mm = 900.0;
  Scene scene;
  scene.objects.push_back({square(3000.0F, 0.0F), matt(0.6F), 0});
  scene.objects.push_back(
      {quad({0.0F, -1500.0F, kEdge_mm}, {1500.0F, 0.0F, 0.0F}, {0.0F, 3000.0F, 0.0F}), matt(0.0F), 0});
  scene.lights.push_back(ceiling_light({0.0F, 0.0F}, {400.0F, 400.0F}, kLight_mm, 4.0F));
  const ViewCamera camera = camera_at({-60.0, -30.0, 140.0}, {0.0, 0.0, 0.0}, 120, 90, 110.0);
  const auto expected = [&](const Eigen::Vector3d& p) {
    const double cut = p.x() - p.x() * kLight_mm / kEdge_mm;
    return 0.6 * 4.0 *
           rectangle_factor(-200.0 - p.x(), std::min(200.0, cut) - p.x(), -200.0 - p.y(), 200.0 - p.y(),
                            kLight_mm);
  };
  const double level = expected({-100.0, 0.0, 0.0});
  const RenderedView view = ViewRenderer(scene).render(camera);
  const Error error = compare(view, camera, level, expected);
  std::cout << "noise " << 100.0 * error.rms << " %, mean error " << 100.0 * error.mean << " %\n";
  EXPECT_LT(std::abs(error.mean), 1e-3);
  EXPECT_LT(error.rms, 0.02);

  RenderSettings thorough;
  thorough.samples = 64;
  thorough.penumbra_samples = 32;
  const Error left = compare(ViewRenderer(scene).render(camera, thorough), camera, level, expected);
  std::cout << "with more samples " << 100.0 * left.rms << " %, mean error " << 100.0 * left.mean << " %\n";
  EXPECT_LT(std::abs(left.mean), 5e-4);
  EXPECT_LT(left.rms, 0.004);
}

// In a room of even light a white body cannot be told from the room.
TEST(LightTransport, AWhiteBodyInEvenLightVanishes) {
  for (const float coat : {0.0F, 0.04F, 0.1F}) {
    Scene scene;
    scene.ambient = {1.0F, 0.5F, 2.0F};
    const auto white =
        std::make_shared<PlainMaterial>(Reflectance{Eigen::Vector3f::Ones(), coat, 0.2F, false});
    scene.objects.push_back({sphere({0.0F, 0.0F, 0.0F}, 50.0F, 200), white, 1});
    const ViewCamera camera = camera_at({0.0, -300.0, 100.0}, {0.0, 0.0, 0.0}, 64, 64, 150.0);
    const RenderedView view = ViewRenderer(scene).render(camera);
    double worst = 0.0;
    double mean = 0.0;
    for (const Eigen::Vector3f& radiance : view.radiance) {
      const Eigen::Vector3f share = radiance.cwiseQuotient(scene.ambient);
      worst = std::max(worst, static_cast<double>((share - Eigen::Vector3f::Ones()).cwiseAbs().maxCoeff()));
      mean += static_cast<double>(share.mean()) / static_cast<double>(view.radiance.size());
    }
    std::cout << "coat " << coat << ": mean " << mean << ", worst pixel off by " << worst << "\n";
    EXPECT_NEAR(mean, 1.0, coat > 0.0F ? 0.005 : 0.001);
    EXPECT_LT(worst, 0.1);
  }
}

// Light that a wall throws on the floor next to it: after one bounce, against the floor's view of an even
// wall.
TEST(LightTransport, AGreyBoxInEvenLightLosesWhatItsBouncesSwallow) {
  // Inside a closed sphere of albedo a that nothing lights there is no light; a floor under an open
  // half-space keeps a.
  Scene scene;
  scene.ambient = Eigen::Vector3f::Ones();
  scene.objects.push_back({square(2000.0F, 0.0F), matt(0.5F), 1});
  const ViewCamera camera = camera_at({0.0, -100.0, 200.0}, {0.0, 0.0, 0.0}, 32, 32, 60.0);
  for (const Eigen::Vector3f& radiance : ViewRenderer(scene).render(camera).radiance) {
    ASSERT_NEAR(radiance.x(), 0.5F, 1e-5F);
  }
  scene.objects.push_back({sphere({0.0F, 0.0F, 0.0F}, 900.0F, 60), matt(0.5F), 2});
  for (const Eigen::Vector3f& radiance : ViewRenderer(scene).render(camera).radiance) {
    ASSERT_EQ(radiance.x(), 0.0F);
  }
}

// A floor and a wall at right angles, both without end: the wall fills half of the floor's view at its foot,
// where each sees the other; bounces b leave Σ (a/2)^k of the rest.
TEST(LightTransport, TheFootOfAWallGetsLightByWayOfTheWall) {
  Scene scene;
  scene.ambient = Eigen::Vector3f::Ones();
  scene.objects.push_back(
      {quad({-20000.0F, -20000.0F, 0.0F}, {40000.0F, 0.0F, 0.0F}, {0.0F, 20000.0F, 0.0F}), matt(0.8F), 1});
  scene.objects.push_back(
      {quad({-20000.0F, 0.0F, 0.0F}, {40000.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 20000.0F}), matt(0.8F), 2});
  const ViewCamera camera = camera_at({0.0, -300.0, 300.0}, {0.0, 0.0, 0.0}, 41, 41, 4000.0);
  RenderSettings settings;
  settings.samples = 256;
  settings.bounces = 8;
  const RenderedView view = ViewRenderer(scene).render(camera, settings);
  double mean = 0.0;
  for (const Eigen::Vector3f& radiance : view.radiance)
    mean += static_cast<double>(radiance.x()) / static_cast<double>(view.radiance.size());
  // Radiosity of the corner: b = a (1/2 + b/2).
  EXPECT_NEAR(mean, 0.8 * 0.5 / (1.0 - 0.8 * 0.5), 0.01);
}

// A mirror shows the light where the law of reflection puts it, as bright as it is.
TEST(LightTransport, ASmoothMirrorShowsTheLightInItsPlace) {
  Scene scene;
  const auto mirror = std::make_shared<PlainMaterial>(Reflectance{Eigen::Vector3f::Ones(), 0.0F, 0.0F, true});
  scene.objects.push_back({square(2000.0F, 0.0F), mirror, 1});
  scene.lights.push_back(ceiling_light({60.0F, 250.0F}, {120.0F, 80.0F}, 500.0F, 3.0F));
  const ViewCamera camera = camera_at({0.0, -300.0, 400.0}, {0.0, 0.0, 0.0}, 160, 120, 110.0);
  const RenderedView view = ViewRenderer(scene).render(camera);
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const auto weight =
          static_cast<double>(view.radiance[static_cast<std::size_t>(y * view.width + x)].x());
      center += weight * Eigen::Vector3d(x, y, 1.0);
    }
  }
  // The light's mirror image is a rectangle below the floor; its picture's centroid, by many points.
  Eigen::Vector3d expected = Eigen::Vector3d::Zero();
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) {
      const Eigen::Vector3d image(120.0 * (i + 0.5) / 100.0, 210.0 + 80.0 * (j + 0.5) / 100.0, -500.0);
      const Eigen::Vector3d seen = camera.camera_from_world * image;
      const double size = std::pow(seen.z(), -3.0);  // of its picture
      expected += size * Eigen::Vector3d(camera.fx * seen.x() / seen.z() + camera.cx,
                                         camera.fy * seen.y() / seen.z() + camera.cy, 1.0);
    }
  }
  EXPECT_LT((center.hnormalized() - expected.hnormalized()).norm(), 0.1);
  const Eigen::Vector2i pixel = expected.hnormalized().array().round().cast<int>();
  EXPECT_NEAR(view.radiance[static_cast<std::size_t>(pixel.y() * view.width + pixel.x())].x(), 3.0F, 0.1F);
}

// The rough mirror of a light is the same whether lights or mirrored rays find it: a large light over a coat.
TEST(LightTransport, GlossFromLightsMatchesTheIntegralOverThem) {
  for (const float roughness : {0.05F, 0.2F, 0.6F}) {
    Scene scene;
    const Reflectance lacquer{Eigen::Vector3f::Zero(), 0.5F, roughness, false};
    scene.objects.push_back({square(2000.0F, 0.0F), std::make_shared<PlainMaterial>(lacquer), 1});
    scene.lights.push_back(ceiling_light({60.0F, 250.0F}, {220.0F, 180.0F}, 500.0F, 3.0F));
    const ViewCamera camera = camera_at({0.0, -300.0, 400.0}, {0.0, 0.0, 0.0}, 48, 36, 60.0);
    RenderSettings settings;
    settings.samples = 128;
    const RenderedView view = ViewRenderer(scene).render(camera, settings);
    const Eigen::Vector3d eye = camera.camera_from_world.inverse().translation();
    constexpr int kSteps = 150;
    double worst = 0.0;
    for (int y = 4; y < view.height; y += 9) {
      for (int x = 4; x < view.width; x += 10) {
        const Eigen::Vector3d p = point_on_plane(camera, x, y, 0.0);
        const Eigen::Vector3d v = (eye - p).normalized();
        double sum = 0.0;
        for (int i = 0; i < kSteps; ++i) {
          for (int j = 0; j < kSteps; ++j) {
            const Eigen::Vector3d way = Eigen::Vector3d(-50.0 + 220.0 * (i + 0.5) / kSteps,
                                                        160.0 + 180.0 * (j + 0.5) / kSteps, 500.0) -
                                        p;
            const Eigen::Vector3d l = way.normalized();
            const Eigen::Vector3d h = (l + v).normalized();
            // Walter 2007 and Heitz 2014, written out.
            const double a2 = static_cast<double>(roughness) * static_cast<double>(roughness);
            const double d = a2 / (std::numbers::pi * std::pow(h.z() * h.z() * (a2 - 1.0) + 1.0, 2.0));
            const auto lambda = [&](double c) {
              return 0.5 * (std::sqrt(1.0 + a2 * (1.0 / (c * c) - 1.0)) - 1.0);
            };
            const double g = 1.0 / (1.0 + lambda(l.z()) + lambda(v.z()));
            const double f = 0.5 + 0.5 * std::pow(1.0 - h.dot(l), 5.0);
            sum += d * g * f / (4.0 * v.z()) * 3.0 * l.z() / way.squaredNorm() *
                   (220.0 * 180.0 / (kSteps * kSteps));
          }
        }
        const auto found =
            static_cast<double>(view.radiance[static_cast<std::size_t>(y * view.width + x)].x());
        worst = std::max(worst, std::abs(found - sum) / 1.5);
      }
    }
    std::cout << "roughness " << roughness << ": worst " << 100.0 * worst << " % of the mirrored light\n";
    EXPECT_LT(worst, roughness < 0.1F ? 0.06 : 0.015) << roughness;
  }
}

// Facets must not show at the edge of light: a coarse ball with normals is lit as a round one.
TEST(LightTransport, ACoarseBallIsLitAsARoundOne) {
  Scene scene;
  scene.objects.push_back({sphere({0.0F, 0.0F, 0.0F}, 50.0F, 32), matt(0.8F), 1});
  constexpr float kFar_mm = 10000.0F;
  const Eigen::Vector3f to_light =
      Eigen::Vector3f(1.0F, 0.049F, 0.0F).normalized();  // its shade ends within facets
  const Eigen::Vector3f across = 100.0F * Eigen::Vector3f::UnitZ().cross(to_light);
  scene.lights.push_back({kFar_mm * to_light, {0.0F, 0.0F, 100.0F}, across, Eigen::Vector3f::Constant(1e4F)});
  const ViewCamera camera = camera_at({0.0, -300.0, 0.0}, {0.0, 0.0, 0.0}, 160, 160, 400.0);
  const RenderedView view = ViewRenderer(scene).render(camera);
  double worst = 0.0;
  int lit = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const Eigen::Vector3d direction((x - camera.cx) / camera.fx, 1.0, -(y - camera.cy) / camera.fy);
      const double b = direction.y() * -300.0;
      const double root2 = b * b - direction.squaredNorm() * (300.0 * 300.0 - 48.0 * 48.0);
      if (root2 < 0.0) continue;  // its outermost ring shows the facets' outline
      const double outer2 = b * b - direction.squaredNorm() * (300.0 * 300.0 - 50.0 * 50.0);
      const Eigen::Vector3d normal = (Eigen::Vector3d(0.0, -300.0, 0.0) +
                                      direction * ((-b - std::sqrt(outer2)) / direction.squaredNorm())) /
                                     50.0;
      const double expected = std::max(normal.dot(to_light.cast<double>()), 0.0) * 0.8 / std::numbers::pi;
      lit += expected > 0.0 ? 1 : 0;
      const auto found = static_cast<double>(view.radiance[static_cast<std::size_t>(y * view.width + x)].x());
      worst = std::max(worst, std::abs(found - expected) / (0.8 / std::numbers::pi));
    }
  }
  EXPECT_GT(lit, 2000);
  std::cout << "worst " << worst << " of full light\n";
  EXPECT_LT(worst, 0.02);
}

TEST(LightTransport, TheNumberOfThreadsDoesNotShow) {
  Scene scene;
  scene.ambient = Eigen::Vector3f::Constant(0.2F);
  const Reflectance glaze{Eigen::Vector3f(0.7F, 0.6F, 0.5F), 0.05F, 0.1F, false};
  scene.objects.push_back({square(2000.0F, 0.0F), matt(0.5F), 1});
  scene.objects.push_back(
      {sphere({0.0F, 0.0F, 40.0F}, 40.0F, 60), std::make_shared<PlainMaterial>(glaze), 2});
  scene.lights.push_back(ceiling_light({100.0F, 50.0F}, {300.0F, 200.0F}, 600.0F, 4.0F));
  ViewCamera camera = camera_at({0.0, -200.0, 250.0}, {0.0, 0.0, 20.0}, 131, 101, 150.0);
  camera.aperture_mm = 4.0;
  camera.moves = true;
  camera.camera_from_world_at_end = look_at({0.5, -200.0, 250.0}, {0.0, 0.0, 20.0});
  RenderSettings settings;
  settings.threads = 1;
  double last = 0.0;
  int calls = 0;
  const RenderedView one = ViewRenderer(scene).render(camera, settings, [&](double share) {
    EXPECT_GT(share, last);
    last = share;
    ++calls;
  });
  EXPECT_EQ(last, 1.0);
  EXPECT_GT(calls, 10);
  settings.threads = 2;
  const RenderedView two = ViewRenderer(scene).render(camera, settings);
  EXPECT_EQ(one.radiance, two.radiance);
  EXPECT_EQ(one.labels, two.labels);
  EXPECT_EQ(one.depth_mm, two.depth_mm);
  settings.view = 1;
  EXPECT_NE(ViewRenderer(scene).render(camera, settings).radiance, one.radiance);
}

TEST(LightTransport, RefusesScenesAndSettingsThatMakeNoSense) {
  Scene scene;
  scene.objects.push_back({square(100.0F, 0.0F), nullptr, 0});
  EXPECT_THROW(ViewRenderer{scene}, std::invalid_argument);
  scene.objects[0].material = matt(0.5F);
  scene.objects[0].mesh.triangles.push_back({0, 1, 4});
  EXPECT_THROW(ViewRenderer{scene}, std::invalid_argument);
  scene.objects[0].mesh.triangles.pop_back();
  scene.objects[0].mesh.normals.resize(3, Eigen::Vector3f::UnitZ());
  EXPECT_THROW(ViewRenderer{scene}, std::invalid_argument);
  scene.objects[0].mesh.normals.clear();
  const ViewRenderer renderer(scene);
  ViewCamera camera = camera_at({0.0, 0.0, 200.0}, {0.0, 0.0, 0.0}, 16, 16, 20.0);
  EXPECT_THROW(renderer.render(camera, {.samples = 0}), std::invalid_argument);
  EXPECT_THROW(renderer.render(camera, {.bounces = 99}), std::invalid_argument);
  camera.aperture_mm = -1.0;
  EXPECT_THROW(renderer.render(camera), std::invalid_argument);
}

}  // namespace
}  // namespace traygauge
