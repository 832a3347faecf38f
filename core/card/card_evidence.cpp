#include "core/card/card_evidence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/card/card_pose.hpp"
#include "core/card/homography.hpp"

namespace traygauge {

namespace {

// Places along the card's length, about the inlier distance each: the bits of a word.
constexpr int kPlaces = std::numeric_limits<std::uint32_t>::digits;
// Tracks whose neighbours are counted; bounds the time; a mean over so many scatters by 4 % of their
// deviation.
constexpr std::size_t kMaxChanceRows = 512;

int count_places(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                 const CardModelSize& size) {
  std::array<std::uint32_t, kPlaces> taken{};
  int places = 0;
  const double per_mm = kPlaces / size.length_mm();
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (inliers[i] == 0) continue;
    const auto x = static_cast<unsigned>(std::clamp(tracks[i].pattern_mm.x() * per_mm, 0.0, kPlaces - 1.0));
    const auto y = static_cast<unsigned>(std::clamp(tracks[i].pattern_mm.y() * per_mm, 0.0, kPlaces - 1.0));
    if ((taken[y] >> x & 1U) == 0) ++places;
    taken[y] |= 1U << x;
  }
  return places;
}

// The chance that a random track lies within the inlier distance of where a homography puts it: the share of
// the card's area, or more when the pattern's points crowd together.
double chance_of_inlier(std::span<const CardTrack> tracks, double inlier_mm, const CardModelSize& size) {
  const std::size_t step = tracks.size() / kMaxChanceRows + 1;
  double near = 0.0;
  double pairs = 0.0;
  for (std::size_t i = 0; i < tracks.size(); i += step) {
    for (std::size_t j = 0; j < i; j += step) {
      pairs += 1.0;
      if ((tracks[i].pattern_mm - tracks[j].pattern_mm).squaredNorm() < inlier_mm * inlier_mm) near += 1.0;
    }
  }
  const double by_area = std::numbers::pi * inlier_mm * inlier_mm / size.area_mm2();
  return std::min(1.0, std::max(by_area, pairs > 0.0 ? near / pairs : 1.0));
}

double log10_binomial(int n, int k) {
  double sum = 0.0;
  for (int i = 1; i <= k; ++i) sum += std::log10(static_cast<double>(n - k + i) / i);
  return sum;
}

}  // namespace

double log10_false_alarms(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                          double inlier_mm, const CardModelSize& size) {
  const int places = count_places(tracks, inliers, size);
  const auto repeated = static_cast<int>(std::count(inliers.begin(), inliers.end(), 1)) - places;
  const int trials = static_cast<int>(tracks.size()) - repeated;
  if (places <= kHomographySample) return std::log10(std::max(1, trials));
  const double chance = chance_of_inlier(tracks, inlier_mm, size);
  return std::log10(static_cast<double>(trials - kHomographySample)) + log10_binomial(trials, places) +
         log10_binomial(places, kHomographySample) + (places - kHomographySample) * std::log10(chance);
}

double least_spread_mm(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers) {
  Vec2 sum = Vec2::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (inliers[i] == 0) continue;
    sum += tracks[i].pattern_mm;
    count += 1.0;
  }
  if (count == 0.0) return 0.0;
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (inliers[i] == 0) continue;
    const Vec2 offset = tracks[i].pattern_mm - sum / count;
    scatter.noalias() += offset * offset.transpose();
  }
  const double half_trace = 0.5 * scatter.trace() / count;
  const double half_difference = 0.5 * (scatter(0, 0) - scatter(1, 1)) / count;
  const double mixed = scatter(0, 1) / count;
  const double least =
      half_trace - std::sqrt(half_difference * half_difference + mixed * mixed);  // smaller eigenvalue
  return std::sqrt(std::max(0.0, least));
}

bool is_view_of_card(const Mat3& pattern_from_ray, const CardModelSize& size,
                     const CardDetectionParams& params) {
  if (!(pattern_from_ray.determinant() > 0.0)) return false;  // mirrored: seen through its back
  const Mat3 sides = pattern_from_ray.inverse();
  const double width = sides.col(0).norm();
  const double height = sides.col(1).norm();
  if (std::abs(width - height) > params.max_skew * std::max(width, height)) return false;
  if (std::abs(sides.col(0).dot(sides.col(1))) > params.max_skew * width * height) return false;
  for (const Vec2& corner : {Vec2(0.0, 0.0), Vec2(size.width_mm, 0.0), Vec2(size.width_mm, size.height_mm),
                             Vec2(0.0, size.height_mm)}) {
    if (!(sides.row(2).dot(corner.homogeneous()) > 0.0)) return false;
  }
  Pose pose;
  if (!pose_from_homography(pattern_from_ray, pose)) return false;
  const Vec3 centre = pose * Vec3(0.5 * size.width_mm, 0.5 * size.height_mm, 0.0);
  const double distance = centre.norm();
  return distance >= params.min_distance_mm && distance <= params.max_distance_mm &&
         pose.rotation.col(2).dot(centre) >= kMinCardCosine * distance;
}

}  // namespace traygauge
