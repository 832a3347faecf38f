#include "simulator/scenes/card_print.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "simulator/capture/picture_file.hpp"
#include "simulator/scenes/colour.hpp"
#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/noise.hpp"
#include "simulator/scenes/scene_poses.hpp"

namespace traygauge {
namespace {

constexpr double kTopMm = 0.02;  // what lies deeper is the card's side
constexpr std::array<const char*, 8> kWords = {"CAMPUS", "MENSA", "BISTRO",  "MEAL PLAN",
                                               "GUEST",  "STAFF", "CANTEEN", "LUNCH"};

cv::Scalar any_colour(Draws& draws, double low, double high) {
  return {draws.between(low, high), draws.between(low, high), draws.between(low, high)};
}

cv::Point any_place(Draws& draws, const cv::Mat& print) {
  return {draws.whole(0, print.cols - 1), draws.whole(0, print.rows - 1)};
}

// Soft clouds between four colours.
void paint_ground(cv::Mat& print, Draws& draws) {
  std::array<cv::Vec3d, 4> corner;
  for (cv::Vec3d& colour : corner) {
    for (int i = 0; i < 3; ++i) colour[i] = draws.between(90.0, 235.0);
  }
  const std::uint32_t seed = draws.seed();
  for (int y = 0; y < print.rows; ++y) {
    for (int x = 0; x < print.cols; ++x) {
      const Eigen::Vector3f at(static_cast<float>(x), static_cast<float>(y), 0.0F);
      const double u = 0.5 + 0.7 * static_cast<double>(fractal_noise(at / 330.0F, seed, 4));
      const double v = 0.5 + 0.7 * static_cast<double>(fractal_noise(at / 270.0F, seed + 1U, 4));
      const cv::Vec3d colour =
          (corner[0] * (1.0 - u) + corner[1] * u) * (1.0 - v) + (corner[2] * (1.0 - u) + corner[3] * u) * v;
      for (int i = 0; i < 3; ++i) print.at<cv::Vec3b>(y, x)[i] = cv::saturate_cast<std::uint8_t>(colour[i]);
    }
  }
}

// The fine wavy lines of security print.
void paint_guilloche(cv::Mat& print, Draws& draws) {
  const double amplitude = draws.between(60.0, 160.0);
  const double waves = draws.between(0.004, 0.010);
  const double drift = draws.between(0.05, 0.12);
  const cv::Scalar colour = any_colour(draws, 40.0, 170.0);
  for (int line = 0; line < 26; ++line) {
    std::vector<cv::Point> points;
    for (int x = -4; x < print.cols + 8; x += 6) {
      const double phase = waves * x + drift * line;
      const double y = print.rows * (line + 0.5) / 26.0 +
                       amplitude * std::sin(phase) * std::cos(0.37 * phase + 0.2 * line);
      points.emplace_back(x, static_cast<int>(std::lround(y)));
    }
    cv::polylines(print, points, false, colour, 2, cv::LINE_AA);
  }
}

// Leaves, seeds and grains strewn as on packaging.
void paint_motifs(cv::Mat& print, Draws& draws) {
  for (int i = 0; i < 260; ++i) {
    const double size = 6.0 + 70.0 * std::pow(draws.between(0.0, 1.0), 4.0);
    const cv::Scalar colour = any_colour(draws, 10.0, 245.0);
    const cv::Point at = any_place(draws, print);
    const double angle = draws.between(0.0, 360.0);
    const cv::Size axes(static_cast<int>(size), static_cast<int>(size * draws.between(0.25, 0.9)));
    switch (draws.whole(0, 3)) {
      case 0:
        cv::ellipse(print, at, axes, angle, 0, 360, colour, cv::FILLED, cv::LINE_AA);
        break;
      case 1:
        cv::ellipse(print, at, axes, angle, 0, draws.between(90, 330), colour, draws.whole(2, 7),
                    cv::LINE_AA);
        break;
      case 2: {
        std::vector<cv::Point> corners;
        const int count = draws.whole(3, 6);
        for (int k = 0; k < count; ++k) {
          const double direction = 6.28318 * k / count + draws.between(-0.3, 0.3);
          const double reach = size * draws.between(0.5, 1.0);
          corners.emplace_back(at.x + static_cast<int>(reach * std::cos(direction)),
                               at.y + static_cast<int>(reach * std::sin(direction)));
        }
        cv::fillPoly(print, std::vector<std::vector<cv::Point>>{corners}, colour, cv::LINE_AA);
        break;
      }
      default: {
        const double direction = draws.angle_rad();
        const cv::Point to = at + cv::Point(static_cast<int>(size * std::cos(direction)),
                                            static_cast<int>(size * std::sin(direction)));
        cv::line(print, at, to, colour, draws.whole(2, 9), cv::LINE_AA);
      }
    }
  }
}

std::string digits(Draws& draws, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    if (i > 0 && i % 4 == 0) text += ' ';
    text += static_cast<char>('0' + draws.whole(0, 9));
  }
  return text;
}

void write(cv::Mat& print, const std::string& text, cv::Point at, double size, const cv::Scalar& colour,
           int width) {
  cv::putText(print, text, at, cv::FONT_HERSHEY_DUPLEX, size, colour, width, cv::LINE_AA);
}

void paint_text(cv::Mat& print, Draws& draws) {
  const cv::Scalar dark = any_colour(draws, 0.0, 60.0);
  const std::string word = draws.pick(std::span<const char* const>(kWords));
  const double w = print.cols;
  const double h = print.rows;
  const auto place = [&](double x, double y) {
    return cv::Point(static_cast<int>(x * w), static_cast<int>(y * h));
  };
  write(print, word, place(0.05, 0.17), 4.2, {250, 250, 250}, 14);
  write(print, word, place(0.05, 0.17), 4.2, dark, 7);
  write(print, digits(draws, 16), place(0.06, 0.66), 3.2, {245, 245, 245}, 9);
  write(print, digits(draws, 16), place(0.06, 0.80), 1.6, dark, 4);
  for (int line = 0; line < 5; ++line)
    write(print, digits(draws, 12) + " " + word, place(0.55, 0.82 + 0.035 * line), 0.8, dark, 2);
  // The contacts of a chip.
  const cv::Point chip = place(0.09, 0.33);
  cv::rectangle(print, chip, chip + cv::Point(230, 180), cv::Scalar(214, 184, 96), cv::FILLED);
  for (int i = 1; i < 4; ++i)
    cv::line(print, chip + cv::Point(0, 45 * i), chip + cv::Point(230, 45 * i), cv::Scalar(120, 96, 40), 4,
             cv::LINE_AA);
  cv::line(print, chip + cv::Point(80, 0), chip + cv::Point(80, 180), cv::Scalar(120, 96, 40), 4,
           cv::LINE_AA);
  cv::line(print, chip + cv::Point(150, 0), chip + cv::Point(150, 180), cv::Scalar(120, 96, 40), 4,
           cv::LINE_AA);
  // A logo of overlapping rings.
  for (int i = 0; i < 3; ++i)
    cv::circle(print, place(0.80 + 0.05 * i, 0.17), 95, any_colour(draws, 20.0, 230.0), i == 1 ? 22 : 34,
               cv::LINE_AA);
}

class CardMaterial : public Material {
 public:
  CardMaterial(std::shared_ptr<const Picture> print, const Eigen::Vector2d& px_per_mm, LaidCard card,
               const Eigen::Isometry3d& card_from_world)
      : print_(std::move(print)),
        px_per_mm_(px_per_mm.cast<float>()),
        card_(std::move(card)),
        card_from_world_(card_from_world.cast<float>()) {
    for (std::size_t i = 0; i < linear_.size(); ++i)
      linear_[i] = linear_colour(static_cast<std::uint32_t>(i) << 16U).x();
  }

  Reflectance at(const Eigen::Vector3f& point_mm, const Eigen::Vector3f&) const override {
    const Eigen::Vector3f at = card_from_world_ * point_mm;
    Reflectance reflectance;
    reflectance.roughness = 0.3F;
    const double depth_mm = at.z() + card_lift_mm(card_, at.x());
    reflectance.base = depth_mm > kTopMm ? Eigen::Vector3f::Constant(0.8F) : printed(at);
    return reflectance;
  }

 private:
  // Bilinear between the centres of the print's pixels.
  Eigen::Vector3f printed(const Eigen::Vector3f& at) const {
    const float u = px_per_mm_.x() * at.x() - 0.5F;
    const float v = px_per_mm_.y() * at.y() - 0.5F;
    const float x = std::floor(u);
    const float y = std::floor(v);
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    return blend(blend(pixel(column, row), pixel(column + 1, row), u - x),
                 blend(pixel(column, row + 1), pixel(column + 1, row + 1), u - x), v - y);
  }

  Eigen::Vector3f pixel(int column, int row) const {
    const auto x = static_cast<std::size_t>(std::clamp(column, 0, print_->size.width - 1));
    const auto y = static_cast<std::size_t>(std::clamp(row, 0, print_->size.height - 1));
    const std::uint8_t* rgb = &print_->pixels[3 * (y * static_cast<std::size_t>(print_->size.width) + x)];
    return {linear_[rgb[0]], linear_[rgb[1]], linear_[rgb[2]]};
  }

  std::shared_ptr<const Picture> print_;
  Eigen::Vector2f px_per_mm_;
  LaidCard card_;
  Eigen::Isometry3f card_from_world_;
  std::array<float, 256> linear_{};
};

}  // namespace

Picture print_card(double width_mm, double height_mm, std::uint64_t seed) {
  const auto pixels = [](double length_mm) {
    return static_cast<int>(std::ceil(kCardPrintPxPerMm * length_mm - 1e-6));
  };
  Picture picture({pixels(width_mm), pixels(height_mm)}, PixelFormat::rgb8);
  cv::Mat print(picture.size.height, picture.size.width, CV_8UC3, picture.pixels.data());
  Draws draws(seed, "card");
  paint_ground(print, draws);
  paint_guilloche(print, draws);
  paint_motifs(print, draws);
  paint_text(print, draws);
  return picture;
}

Picture read_print(const std::filesystem::path& file) {
  const Picture picture = read_picture({file, "card.print"});
  cv::Mat stored(picture.size.height, picture.size.width,
                 picture.format == PixelFormat::gray8 ? CV_8UC1 : CV_8UC3,
                 const_cast<std::uint8_t*>(picture.pixels.data()));  // NOLINT: only read
  Picture print(picture.size, PixelFormat::rgb8);
  cv::Mat rgb(print.size.height, print.size.width, CV_8UC3, print.pixels.data());
  if (picture.format == PixelFormat::rgb8) {
    stored.copyTo(rgb);
  } else {
    cv::cvtColor(stored, rgb, picture.format == PixelFormat::gray8 ? cv::COLOR_GRAY2RGB : cv::COLOR_BGR2RGB);
  }
  return print;
}

std::shared_ptr<const Material> make_card_material(std::shared_ptr<const Picture> print,
                                                   const Eigen::Vector2d& px_per_mm, LaidCard card,
                                                   const Eigen::Isometry3d& card_from_world) {
  return std::make_shared<CardMaterial>(std::move(print), px_per_mm, std::move(card), card_from_world);
}

}  // namespace traygauge
