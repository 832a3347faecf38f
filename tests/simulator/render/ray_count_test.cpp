// Fewer rays for pixels whose neighbours are calm.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <memory>

#include "simulator/render/view_renderer.hpp"
#include "tests/simulator/render/render_scenes.hpp"

namespace traygauge {
namespace {

// Stripes finer than pixels at some places and calm between: few rays must not shift what many show.
TEST(RayCount, CalmPixelsAreAsBrightAsWithAllRays) {
  class Stripes : public Material {
   public:
    Reflectance at(const Eigen::Vector3f& point_mm, const Eigen::Vector3f&) const override {
      const bool is_dark = point_mm.x() - 40.0F * std::floor(point_mm.x() / 40.0F) < 1.0F;
      return {Eigen::Vector3f::Constant(is_dark ? 0.1F : 0.7F), 0.04F, 0.2F, false};
    }
  };
  Scene scene;
  scene.ambient = Eigen::Vector3f::Constant(0.2F);
  scene.objects.push_back({square(2000.0F, 0.0F), std::make_shared<Stripes>(), 1});
  scene.lights.push_back(ceiling_light({100.0F, 50.0F}, {300.0F, 200.0F}, 600.0F, 4.0F));
  const ViewCamera camera = camera_at({0.0, -200.0, 250.0}, {0.0, 0.0, 0.0}, 320, 240, 180.0);
  RenderSettings all_rays;
  all_rays.calm_spread = 0.0F;
  const RenderedView all = ViewRenderer(scene).render(camera, all_rays);
  const RenderedView view = ViewRenderer(scene).render(camera);
  double sum = 0.0;
  double difference = 0.0;
  for (std::size_t i = 0; i < all.radiance.size(); ++i) {
    sum += static_cast<double>(all.radiance[i].y());
    difference += static_cast<double>(view.radiance[i].y() - all.radiance[i].y());
  }
  std::cout << "mean off by " << 100.0 * difference / sum << " %\n";
  EXPECT_LT(std::abs(difference / sum), 1e-3);
  EXPECT_NE(view.radiance, all.radiance);
}

}  // namespace
}  // namespace traygauge
