#include "tests/core/pipeline/tray_scene.hpp"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

constexpr double kFocal_px = 1000.0;
constexpr double kSolidHeight_mm = 25.0;

SyntheticCamera camera_at(double tilt_deg, double distance_mm) {
  const double tilt = tilt_deg * std::numbers::pi / 180.0;
  const Vec3 middle(-35.0, 0.0, 0.0);  // between dish and card
  return look_at(middle + distance_mm * Vec3(0.1, -std::sin(tilt), std::cos(tilt)), middle, 0.05, kFocal_px,
                 kTrayWidthPx, kTrayHeightPx);
}

// The print at a point of the table, bilinear; false beside the card.
bool print_at(const TrayPattern& pattern, const Vec3& point, double& gray) {
  const ReferenceCard card;
  const double u_mm = point.x() - kCardLeft_mm;
  const double v_mm = kCardTop_mm - point.y();
  if (u_mm < 0.0 || v_mm < 0.0 || u_mm >= card.width_mm || v_mm >= card.height_mm) return false;
  const double x =
      std::clamp(u_mm * TrayPattern::kWidth / card.width_mm - 0.5, 0.0, TrayPattern::kWidth - 1.001);
  const double y =
      std::clamp(v_mm * TrayPattern::kHeight / card.height_mm - 0.5, 0.0, TrayPattern::kHeight - 1.001);
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const double s = x - left;
  const double t = y - top;
  const auto view = pattern.view();
  gray = (1.0 - t) * ((1.0 - s) * view.at(left, top) + s * view.at(left + 1, top)) +
         t * ((1.0 - s) * view.at(left, top + 1) + s * view.at(left + 1, top + 1));
  return true;
}

// Mean of the print over a pixel; false unless all of the pixel shows it.
bool print_in_pixel(const TrayPattern& pattern, const SyntheticCamera& camera, const Vec2& pixel,
                    double& gray) {
  constexpr int kSamples = 3;
  const Vec3 origin = camera.centre();
  const auto sample = [&](const Vec2& at, double& value) {
    const Vec3 ray = camera.direction(at);
    return print_at(pattern, origin - ray * (origin.z() / ray.z()), value);
  };
  if (!sample(pixel, gray)) return false;
  double sum = 0.0;
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const Vec2 offset(i % kSamples, i / kSamples);
    if (!sample(pixel + (offset.array() + 0.5).matrix() / kSamples - Vec2(0.5, 0.5), gray)) return false;
    sum += gray;
  }
  gray = sum / (kSamples * kSamples);
  return true;
}

void lay_card(const TrayPattern& pattern, const SyntheticCamera& camera, RenderedView& view) {
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      double gray = 0.0;
      if (!print_in_pixel(pattern, camera, Vec2(x, y), gray)) continue;
      const auto index =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width) + static_cast<std::size_t>(x);
      view.gray[index] = static_cast<std::uint8_t>(std::lround(gray));
      view.labels[index] = kCardLabel;
    }
  }
}

}  // namespace

TrayPattern::TrayPattern(std::uint32_t seed) {
  cv::Mat sum = cv::Mat::zeros(kHeight, kWidth, CV_32F);
  cv::RNG random(seed);
  for (const double sigma_px : {3.0, 8.0, 20.0}) {
    cv::Mat noise(kHeight, kWidth, CV_32F);
    random.fill(noise, cv::RNG::UNIFORM, -1.0, 1.0);
    cv::GaussianBlur(noise, noise, {0, 0}, sigma_px);
    sum += noise * sigma_px;  // the same contrast at each scale
  }
  cv::Mat gray;
  cv::normalize(sum, gray, 0, 255, cv::NORM_MINMAX, CV_8U);
  pixels.assign(gray.begin<std::uint8_t>(), gray.end<std::uint8_t>());
}

TrayScene::TrayScene(const TrayOptions& options) : pattern(options.pattern_seed) {
  solid.shape = SolidShape::height_field;
  solid.radius_mm = options.solid_radius_mm;
  solid.height_mm = kSolidHeight_mm;
  solid.centre_mm = options.solid_centre_mm;
  solid.dish_radius_mm = kTrayDishRadius_mm;
  solid.texture_mm = 12.0;
  solid.texture_seed = options.texture_seed;
  for (std::size_t i = 0; i < 2; ++i) {
    cameras[i] = camera_at(options.tilt_deg[i], options.distance_mm);
    views[i] = render(solid, cameras[i], 1);  // the texture is six pixels and more long
    if (options.with_card) lay_card(pattern, cameras[i], views[i]);
  }
  dish[0].outer_size_mm = {2.0 * kTrayDishRadius_mm, 2.0 * kTrayDishRadius_mm};
}

TraySetup TrayScene::setup() const {
  TraySetup setup;
  setup.lens.width = kTrayWidthPx;
  setup.lens.height = kTrayHeightPx;
  setup.lens.pinhole = cameras[0].pinhole;
  setup.card.thickness_mm = 0.0;
  setup.card.pattern = pattern.view();
  setup.dishes = dish;
  return setup;
}

ViewInput TrayScene::view(int i) const {
  return view(i, views[static_cast<std::size_t>(i)].label_view());
}

ViewInput TrayScene::view(int i, ImageView<const std::uint8_t> labels) const {
  const RenderedView& rendered = views[static_cast<std::size_t>(i)];
  ViewInput input;
  input.frame = {rendered.gray.data(), rendered.width, rendered.height, rendered.width, PixelFormat::gray8};
  input.labels = labels;
  return input;
}

const TrayScene& default_tray() {
  static const TrayScene scene;
  return scene;
}

const TrayScene& other_tray() {
  static const TrayScene scene([] {
    TrayOptions options;
    options.texture_seed = 77;
    options.solid_radius_mm = 55.0;
    return options;
  }());
  return scene;
}

}  // namespace traygauge
