#include "core/stereo/surface_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/parabola.hpp"

namespace traygauge {
namespace {

constexpr double kPixelsAcrossGrain = 2.5;  // at least; below, pixels are averaged that noise would hide
constexpr double kBareMarginPx = 1.5;       // outlines are that sure
constexpr double kDiagonal = 0.5 * std::numbers::sqrt2;
constexpr std::array<std::array<double, 2>, 8> kRing{{{1.0, 0.0},
                                                      {kDiagonal, kDiagonal},
                                                      {0.0, 1.0},
                                                      {-kDiagonal, kDiagonal},
                                                      {-1.0, 0.0},
                                                      {-kDiagonal, -kDiagonal},
                                                      {0.0, -1.0},
                                                      {kDiagonal, -kDiagonal}}};

Vec2 on_ring(const std::array<double, 2>& direction, double radius_px) {
  return radius_px * Vec2(direction[0], direction[1]);
}

}  // namespace

SurfaceAgreement::SurfaceAgreement(const SurfaceView& first, const SurfaceView& second, std::uint8_t label,
                                   const Vec3& middle_mm, const SurfaceAgreementParams& params)
    : params_(params),
      views_{&first, &second},
      label_(label),
      middle_mm_(middle_mm.head<2>()),
      eye_mm_(camera_centre_mm(first.camera_from_table)),
      sampled_{sample(first, middle_mm), sample(second, middle_mm)} {}

SurfaceAgreement::Sampled SurfaceAgreement::sample(const SurfaceView& view, const Vec3& middle_mm) const {
  const double grain_px = params_.grain_mm * px_per_mm(view, middle_mm);
  Sampled sampled;
  sampled.level = level_of(grain_px, kPixelsAcrossGrain);
  sampled.picture = view.gray.levels[sampled.level];
  sampled.ring_px = grain_px / static_cast<double>(1U << sampled.level);
  sampled.bare_px = grain_px + kBareMarginPx;
  return sampled;
}

bool SurfaceAgreement::is_bare(std::size_t view, const Vec2& pixel) const {
  const auto is_labelled = [&](const Vec2& at) { return views_[view]->label_at(at) == label_; };
  return is_labelled(pixel) && std::ranges::all_of(kRing, [&](const auto& direction) {
           return is_labelled(pixel + on_ring(direction, sampled_[view].bare_px));
         });
}

// Of a grain to its surroundings.
bool SurfaceAgreement::contrast(std::size_t view, const Vec2& pixel, double& value) const {
  const Sampled& sampled = sampled_[view];
  const Vec2 at(to_level(pixel.x(), sampled.level), to_level(pixel.y(), sampled.level));
  const GraySampler picture(sampled.picture);
  float gray = 0.0F;
  if (!picture.sample(at, gray)) return false;
  const double grain = gray;
  double around = 0.0;
  for (const auto& direction : kRing) {
    if (!picture.sample(at + on_ring(direction, sampled.ring_px), gray)) return false;
    around += gray;
  }
  value = std::clamp(grain - around / static_cast<double>(kRing.size()), -params_.max_contrast,
                     params_.max_contrast);
  return true;
}

void SurfaceAgreement::add(const Vec3& place_mm) {
  const Vec3 sight = place_mm - eye_mm_;
  if (!(sight.z() < -params_.reach_mm)) return;
  const auto pixel_in = [&](std::size_t view, const Vec3& point_mm, Vec2& pixel) {
    return views_[view]->find_pixel(point_mm, pixel) && is_bare(view, pixel);
  };
  // The line of sight of the first picture, as the second sees it.
  Vec2 pixel;
  std::array<Vec2, 3> path;
  if (!pixel_in(0, place_mm, pixel)) return;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double height_mm = (static_cast<double>(i) - 1.0) * params_.reach_mm;
    if (!pixel_in(1, place_mm + sight * (height_mm / sight.z()), path[i])) return;
  }
  const PixelParabola line(path);
  double first = 0.0;
  std::array<double, kHeights> second{};
  if (!contrast(0, pixel, first)) return;
  for (std::size_t i = 0; i < kHeights; ++i) {
    const double height = static_cast<double>(i) / static_cast<double>(kHeightsUp) - 1.0;
    if (!contrast(1, line.at(height), second[i])) return;
  }
  const Vec2 offset = place_mm.head<2>() - middle_mm_;
  const double turns = std::atan2(offset.y(), offset.x()) / (2.0 * std::numbers::pi) + 0.5;
  Sums& sums = parts_[std::min(static_cast<std::size_t>(turns * static_cast<double>(kParts)), kParts - 1)];
  sums.count += 1.0;
  sums.first += first;
  sums.first_squared += first * first;
  for (std::size_t i = 0; i < kHeights; ++i) {
    sums.second[i] += second[i];
    sums.second_squared[i] += second[i] * second[i];
    sums.product[i] += first * second[i];
  }
}

void SurfaceAgreement::add(const Sums& part, double sign, Sums& sums) {
  sums.count += sign * part.count;
  sums.first += sign * part.first;
  sums.first_squared += sign * part.first_squared;
  for (std::size_t i = 0; i < kHeights; ++i) {
    sums.second[i] += sign * part.second[i];
    sums.second_squared[i] += sign * part.second_squared[i];
    sums.product[i] += sign * part.product[i];
  }
}

// False when the correlation is greatest at the end of the reach.
bool SurfaceAgreement::peak_mm(const Sums& sums, double& offset_mm, double& lead) const {
  std::array<double, kHeights> curve{};
  const double first_spread = sums.first_squared - sums.first * sums.first / sums.count;
  for (std::size_t i = 0; i < kHeights; ++i) {
    const double second_spread = sums.second_squared[i] - sums.second[i] * sums.second[i] / sums.count;
    const double common = sums.product[i] - sums.first * sums.second[i] / sums.count;
    const double spread = first_spread * second_spread;
    curve[i] = spread > 0.0 ? common / std::sqrt(spread) : 0.0;
  }
  const auto best = static_cast<std::size_t>(std::ranges::max_element(curve) - curve.begin());
  const double step_mm = params_.reach_mm / static_cast<double>(kHeightsUp);
  lead = 1.0;
  for (std::size_t i = 0; i < kHeights; ++i) {
    const double apart_mm = step_mm * std::abs(static_cast<double>(i) - static_cast<double>(best));
    if (apart_mm >= params_.apart_mm) lead = std::min(lead, curve[best] - curve[i]);
  }
  if (best == 0 || best + 1 == kHeights) return false;
  const double shift = parabola_top(curve[best - 1], curve[best], curve[best + 1]);
  offset_mm = (static_cast<double>(best) - static_cast<double>(kHeightsUp) + shift) * step_mm;
  return true;
}

AgreedHeight SurfaceAgreement::solve() const {
  AgreedHeight agreed;
  Sums all;
  for (const Sums& part : parts_) add(part, 1.0, all);
  if (all.count < static_cast<double>(params_.min_samples)) return agreed;
  if (!peak_mm(all, agreed.offset_mm, agreed.lead)) return agreed;
  double variance = 0.0;
  for (const Sums& part : parts_) {
    Sums others = all;
    add(part, -1.0, others);
    double offset_mm = 0.0;
    double lead = 0.0;
    if (others.count < 1.0 || !peak_mm(others, offset_mm, lead)) return agreed;
    variance += (offset_mm - agreed.offset_mm) * (offset_mm - agreed.offset_mm);
  }
  agreed.sigma_mm = std::sqrt(variance * static_cast<double>(kParts - 1) / static_cast<double>(kParts));
  agreed.is_known = agreed.lead >= params_.min_lead && agreed.sigma_mm <= params_.max_sigma_mm;
  return agreed;
}

}  // namespace traygauge
