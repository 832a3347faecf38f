#include "tests/firmware/calibrate/board_views.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace traygauge::test {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kBlack = 40.0;
constexpr double kWhite = 210.0;
constexpr double kPaper = 130.0;
constexpr double kBlurPx = 0.8;
constexpr double kNoiseGray = 2.0;

// +1 and -1 in turn, field by field, softened over `width` fields.
double wave(double place, double width) {
  const double to_edge = 0.5 - std::abs(place - std::floor(place) - 0.5);
  const double sign = static_cast<int>(std::floor(place)) % 2 == 0 ? 1.0 : -1.0;
  return sign * std::erf(to_edge / (width * std::numbers::sqrt2));
}

// Moved across the line of sight until all of the board, its outer fields too, lies in the picture.
Pose kept_in_view(const Chessboard& board, const LensModel& lens, Pose pose) {
  for (int round = 0; round < 5; ++round) {
    Vec2 low(1e9, 1e9);
    Vec2 high = -low;
    for (const double x : {-1.0, static_cast<double>(board.columns)}) {
      for (const double y : {-1.0, static_cast<double>(board.rows)}) {
        const Vec2 pixel = lens.pixel((pose * Vec3(x, y, 0.0)).hnormalized());
        low = low.cwiseMin(pixel);
        high = high.cwiseMax(pixel);
      }
    }
    const Vec2 past = (high - Vec2(lens.width - 4.0, lens.height - 4.0)).cwiseMax(0.0);
    const Vec2 before = (Vec2(3.0, 3.0) - low).cwiseMax(0.0);
    pose.translation.head<2>() += (before - past) * pose.translation.z() / lens.pinhole.mean_focal_px();
  }
  return pose;
}

}  // namespace

std::vector<Pose> hold_board(const Chessboard& board, const LensModel& lens, const BoardHandling& handling,
                             std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  std::vector<Pose> poses;
  // The board fills a little less than half of the picture's height.
  const double distance = (board.rows + 1) * lens.pinhole.fy_px / (0.45 * lens.height);
  for (int i = 0; i < handling.pictures; ++i) {
    const double reach = handling.all_over ? 0.35 : 0.05;
    // The corners of the picture in turn, and between them.
    const double right = reach * (i % 3 - 1 + 0.2 * share(random));
    const double down = reach * ((i / 3) % 3 - 1 + 0.2 * share(random));
    const double azimuth = kRadians * (137.5 * i);
    const double tilt = kRadians * handling.tilt_deg * (0.75 + 0.25 * share(random));
    const Vec3 axis(std::cos(azimuth), std::sin(azimuth), 0.0);
    Pose pose;
    pose.rotation = rotation_about(axis * tilt) * rotation_about(Vec3::UnitZ() * 0.1 * share(random));
    const double depth = distance * (1.0 + 0.15 * share(random));
    const Vec3 middle(right * lens.width / lens.pinhole.fx_px * depth,
                      down * lens.height / lens.pinhole.fy_px * depth, depth);
    pose.translation = middle - pose.rotation * Vec3(0.5 * (board.columns - 1), 0.5 * (board.rows - 1), 0.0);
    poses.push_back(kept_in_view(board, lens, pose));
  }
  return poses;
}

BoardSighting project_board(const Chessboard& board, const LensModel& lens, const Pose& camera_from_board,
                            double noise_px, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  BoardSighting sighting;
  for (std::size_t i = 0; i < board.corner_count(); ++i) {
    const Vec2 place = board.corner_place(i);
    const Vec2 ray = (camera_from_board * Vec3(place.x(), place.y(), 0.0)).hnormalized();
    const Vec2 noise(normal(random), normal(random));
    sighting.corners_px.emplace_back(lens.pixel(ray) + noise_px * noise);
  }
  return sighting;
}

Picture draw_board(const Chessboard& board, const LensModel& lens, const Pose& camera_from_board,
                   std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, kNoiseGray);
  const Pose board_from_camera = camera_from_board.inverse();
  Picture picture({lens.width, lens.height}, PixelFormat::gray8);
  for (int y = 0; y < lens.height; ++y) {
    for (int x = 0; x < lens.width; ++x) {
      double gray = kPaper;
      Vec2 ray;
      if (lens.undistort_pixel(Vec2(x, y), ray)) {
        const Vec3 direction = board_from_camera.rotation * ray.homogeneous();
        const double depth = -board_from_camera.translation.z() / direction.z();
        const Vec3 place = board_from_camera.translation + depth * direction;
        // A field is so many pixels wide; slanted views are blurred as their shorter side.
        const double soft = kBlurPx * depth / lens.pinhole.mean_focal_px();
        const bool on_board =
            place.x() > -1.0 && place.x() < board.columns && place.y() > -1.0 && place.y() < board.rows;
        const bool on_margin = place.x() > -2.0 && place.x() < board.columns + 1 && place.y() > -2.0 &&
                               place.y() < board.rows + 1;
        if (on_margin) gray = kWhite;
        if (on_board) {
          const double fields = wave(place.x() + 2.0, soft) * wave(place.y() + 2.0, soft);
          gray = 0.5 * (kWhite + kBlack) - 0.5 * (kWhite - kBlack) * fields;
        }
      }
      picture.pixels[static_cast<std::size_t>(y * lens.width + x)] =
          static_cast<std::uint8_t>(std::clamp(gray + noise(random), 0.0, 255.0));
    }
  }
  return picture;
}

}  // namespace traygauge::test
