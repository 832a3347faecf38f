#include "tests/support/empty_dish.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/labels/label_regions.hpp"
#include "firmware/config/dish_file.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "tests/support/synthetic_scene.hpp"

namespace traygauge::test {
namespace {

constexpr int kWidth = 1200;
constexpr int kHeight = 900;
constexpr double kFocal_px = 1050.0;
constexpr double kCardWidth_mm = 85.60;
constexpr double kCardHeight_mm = 53.98;
constexpr double kCardThickness_mm = 0.8;
constexpr double kCardGap_mm = 12.0;  // between dish and card
const char* const kPattern = TRAYGAUGE_SOURCE_DIR "/simulator/demo/fish_and_potatoes/card.png";

// Grey values on a plane, periodic, read bilinearly.
class Texture {
 public:
  Texture(double px_per_mm, double wavelength_mm, std::uint32_t seed) : px_per_mm_(px_per_mm) {
    constexpr int kSide = 1024;
    cv::Mat1f sum(kSide, kSide, 0.0F);
    cv::RNG random(seed);
    for (const double share : {1.0, 0.5, 0.25}) {
      cv::Mat1f noise(kSide, kSide);
      random.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
      const double sigma_px = 0.25 * wavelength_mm * share * px_per_mm;
      cv::GaussianBlur(noise, noise, {0, 0}, sigma_px);
      sum += noise * sigma_px;
    }
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(sum, mean, deviation);
    sum.convertTo(values_, CV_32F, 1.0 / deviation[0], -mean[0] / deviation[0]);
  }

  // Mean 0, standard deviation 1.
  double at(const Vec2& mm) const {
    const double x = mm.x() * px_per_mm_;
    const double y = mm.y() * px_per_mm_;
    const int left = static_cast<int>(std::floor(x));
    const int top = static_cast<int>(std::floor(y));
    const auto value = [&](int dx, int dy) {
      return static_cast<double>(values_((top + dy) & 1023, (left + dx) & 1023));
    };
    const double s = x - left;
    const double t = y - top;
    return (1.0 - t) * ((1.0 - s) * value(0, 0) + s * value(1, 0)) +
           t * ((1.0 - s) * value(0, 1) + s * value(1, 1));
  }

 private:
  double px_per_mm_;
  cv::Mat1f values_;
};

class Renderer {
 public:
  explicit Renderer(const EmptyDishScene& scene)
      : scene_(scene), glaze_(4.0, 9.0, scene.seed), table_(2.0, 25.0, scene.seed + 1) {
    static_cast<void>(surface_.profile.set(scene.dish));
    const double azimuth = scene.azimuth_deg * std::numbers::pi / 180.0;
    surface_.place = {scene.centre_mm, {std::cos(azimuth), std::sin(azimuth)}};
    const cv::Mat1b print = cv::imread(kPattern, cv::IMREAD_GRAYSCALE);
    cv::resize(print, print_, {}, 0.2, 0.2, cv::INTER_AREA);  // 4 px per mm, twice what the views show
    const double reach = surface_.profile.semi_axes_mm().maxCoeff();
    card_corner_mm_ = scene.centre_mm + Vec2(-reach - kCardGap_mm - kCardWidth_mm, 30.0);
  }

  void render(const SyntheticCamera& camera, cv::Mat1b& gray, cv::Mat1b& labels) const {
    cv::Mat1f light(kHeight, kWidth);
    labels.create(kHeight, kWidth);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        light(y, x) = static_cast<float>(shade(camera, Vec2(x, y), labels(y, x)));
      }
    }
    cv::GaussianBlur(light, light, {0, 0}, 0.6);
    cv::Mat1f noise(kHeight, kWidth);
    cv::RNG random(scene_.seed + static_cast<unsigned>(camera.centre().x() * 10.0 + 1e5));
    random.fill(noise, cv::RNG::NORMAL, 0.0, scene_.noise_gray);
    light += noise;
    light.convertTo(gray, CV_8U);
  }

  SyntheticCamera camera(int view) const {
    const double tilt = scene_.tilt_deg[static_cast<std::size_t>(view)] * std::numbers::pi / 180.0;
    const double turn = view * scene_.turn_deg * std::numbers::pi / 180.0;
    const Vec3 back(std::sin(tilt) * std::sin(turn), -std::sin(tilt) * std::cos(turn), std::cos(tilt));
    // The middle of dish and card, so that neither is cut off.
    const Vec3 target(scene_.centre_mm.x() - 0.5 * (kCardGap_mm + kCardWidth_mm), scene_.centre_mm.y(), 0.0);
    return look_at(target + scene_.distance_mm * back, target, 0.02 * view, kFocal_px, kWidth, kHeight);
  }

 private:
  double shade(const SyntheticCamera& camera, const Vec2& pixel, std::uint8_t& label) const {
    const Vec3 origin = camera.centre();
    const Vec3 direction = camera.direction(pixel).normalized();
    Vec3 point;
    if (hit_dish(origin, direction, point)) {
      label = kDishLabel;
      return shade_dish(point, direction);
    }
    double print = 0.0;
    if (hit_card(origin, direction, print)) {
      label = kCardLabel;
      return 20.0 + 0.75 * print;
    }
    label = kBackgroundLabel;
    point = origin - direction * (origin.z() / direction.z());
    return 105.0 + 22.0 * table_.at(point.head<2>());
  }

  bool is_inside(const Vec3& point) const {
    const Vec2 at = surface_.to_dish(point.head<2>());
    const Vec2& semi = surface_.profile.semi_axes_mm();
    if (at.cwiseQuotient(semi).squaredNorm() > 1.0) return false;
    const double top = surface_.profile.height_mm(at);
    if (point.z() > top) return false;
    return point.z() > top - scene_.wall_mm;
  }

  bool hit_dish(const Vec3& origin, const Vec3& direction, Vec3& point) const {
    const double highest = surface_.profile.crest_height_mm() + 0.5;
    double before = (highest - origin.z()) / direction.z();
    const double end = -origin.z() / direction.z();
    const double reach = surface_.profile.semi_axes_mm().maxCoeff() + 60.0;
    if ((origin + end * direction).head<2>().norm() > reach + scene_.centre_mm.norm()) return false;
    double after = before;
    while (after < end && !is_inside(origin + after * direction)) {
      before = after;
      // The edge is thin: lines of sight that graze it must not step over it.
      const Vec2 at = surface_.to_dish((origin + after * direction).head<2>());
      after += std::abs(at.cwiseQuotient(surface_.profile.semi_axes_mm()).norm() - 1.0) < 0.02 ? 0.05 : 0.7;
    }
    if (after >= end) return false;
    for (int i = 0; i < 16; ++i) {
      const double middle = 0.5 * (before + after);
      (is_inside(origin + middle * direction) ? after : before) = middle;
    }
    point = origin + after * direction;
    return true;
  }

  double shade_dish(const Vec3& point, const Vec3& direction) const {
    const Vec2 at = point.head<2>();
    const bool is_inner = surface_.height_mm(at) - point.z() < 0.05;
    constexpr double kStep_mm = 0.2;
    const auto slope = [&](const Vec2& along) {
      return (surface_.height_mm(at + kStep_mm * along) - surface_.height_mm(at - kStep_mm * along)) /
             (2.0 * kStep_mm);
    };
    Vec3 normal(-slope(Vec2::UnitX()), -slope(Vec2::UnitY()), 1.0);
    if (!is_inner) normal = Vec3(at.x() - scene_.centre_mm.x(), at.y() - scene_.centre_mm.y(), 20.0);
    normal.normalize();
    const Vec3 lamp = Vec3(-0.4, 0.5, 1.0).normalized();
    const double diffuse = 0.35 + 0.65 * std::max(0.0, normal.dot(lamp));
    const double glaze = 165.0 + 24.0 * scene_.glaze_contrast * glaze_.at(at + Vec2(0.7, -0.4) * point.z());
    const double mirrored = (direction - 2.0 * direction.dot(normal) * normal).dot(lamp);
    return glaze * diffuse + scene_.gloss * std::pow(std::max(0.0, mirrored), 60.0);
  }

  bool hit_card(const Vec3& origin, const Vec3& direction, double& print) const {
    const Vec3 point = origin + direction * ((kCardThickness_mm - origin.z()) / direction.z());
    const double u = (point.x() - card_corner_mm_.x()) / kCardWidth_mm;
    const double v = (card_corner_mm_.y() - point.y()) / kCardHeight_mm;
    if (!(u >= 0.0 && v >= 0.0 && u < 1.0 && v < 1.0)) return false;
    const double x = std::clamp(u * print_.cols - 0.5, 0.0, print_.cols - 1.001);
    const double y = std::clamp(v * print_.rows - 0.5, 0.0, print_.rows - 1.001);
    const int left = static_cast<int>(x);
    const int top = static_cast<int>(y);
    const double s = x - left;
    const double t = y - top;
    print = (1.0 - t) * ((1.0 - s) * print_(top, left) + s * print_(top, left + 1)) +
            t * ((1.0 - s) * print_(top + 1, left) + s * print_(top + 1, left + 1));
    return true;
  }

  const EmptyDishScene& scene_;
  InnerSurface surface_;
  Texture glaze_;
  Texture table_;
  cv::Mat1b print_;
  Vec2 card_corner_mm_ = Vec2::Zero();  // its top left one
};

}  // namespace

DishModel read_dish_model(const std::string& style) {
  return dish_of(read_dish_file(TRAYGAUGE_SOURCE_DIR "/config/dishes/" + style + ".toml"));
}

EmptyDishCapture::EmptyDishCapture(const EmptyDishScene& scene) {
  const Renderer renderer(scene);
  nlohmann::json document = {{"version", 1},
                             {"camera",
                              {{"width", kWidth},
                               {"height", kHeight},
                               {"fx", kFocal_px},
                               {"fy", kFocal_px},
                               {"cx", renderer.camera(0).pinhole.cx_px},
                               {"cy", renderer.camera(0).pinhole.cy_px},
                               {"distortion", {0.0, 0.0, 0.0, 0.0, 0.0}}}},
                             {"card",
                              {{"pattern", "card.png"},
                               {"width_mm", kCardWidth_mm},
                               {"height_mm", kCardHeight_mm},
                               {"thickness_mm", kCardThickness_mm}}},
                             {"pairs", {{0, 1}}}};
  std::filesystem::copy_file(kPattern, folder() / "card.png");
  for (int i = 0; i < 2; ++i) {
    const std::string number = std::to_string(i);
    cv::Mat1b gray;
    cv::Mat1b labels;
    renderer.render(renderer.camera(i), gray, labels);
    cv::imwrite((folder() / ("view_" + number + ".png")).string(), gray);
    cv::imwrite((folder() / ("labels_" + number + ".png")).string(), labels);
    document["views"].push_back(
        {{"image", "view_" + number + ".png"}, {"labels", "labels_" + number + ".png"}});
  }
  write_text(folder() / "capture.json", document.dump(1));
}

void paint_labels(const std::filesystem::path& folder, int view, const cv::Rect& area, std::uint8_t label) {
  const std::string file = (folder / ("labels_" + std::to_string(view) + ".png")).string();
  cv::Mat1b labels = cv::imread(file, cv::IMREAD_GRAYSCALE);
  labels(area) = label;
  cv::imwrite(file, labels);
}

}  // namespace traygauge::test
