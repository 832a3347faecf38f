#include "core/card/card_condition.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/card/tile_samples.hpp"
#include "core/geometry/table_frame.hpp"

namespace traygauge {
namespace {

// Places of 11 mm, on which a small card still has some 100 pixels. Twice as many say too little each.
constexpr std::size_t kPlaceColumns = 8;
constexpr std::size_t kPlaceRows = 5;
// At the border a place may be cut. Ten pixels of one tile leave eight degrees of freedom: what is estimated
// as their noise is right to 1 / sqrt(2 · 8), a quarter.
constexpr int kMinPlacePixels = 10;

// Sums over a place's pixels, each tile about its own means: light that changes from tile to tile is none.
struct PrintAtPlace {
  double pixels = 0.0;
  double tiles = 0.0;
  double print = 0.0;
  double picture = 0.0;
  double together = 0.0;

  bool is_textured() const { return pixels >= kMinPlacePixels && print > 0.0; }
  double slope() const { return together / print; }
  double slope_sigma() const {
    const double left = std::max(0.0, picture - together * together / print);
    const double freedom = std::max(1.0, pixels - 2.0 * tiles);
    return std::sqrt(left / freedom / print);
  }
};

using PrintPlaces = std::array<PrintAtPlace, kPlaceColumns * kPlaceRows>;

std::size_t place_of(double normalised, std::size_t count) {
  const double place = 0.5 * (normalised + 1.0) * static_cast<double>(count);
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
}

PrintPlaces sum_places(const AlignedPrint& print) {
  PrintPlaces places;
  const PrintPlane plane(print.camera_from_table, print.size);
  const ImageView<const std::uint8_t> gray = print.picture.gray();
  for_each_tile(print.picture.tiles(), plane, print.sampling,
                [&](const CardTile& tile, const PrintPlace& under, std::uint64_t bits) {
                  const PrintSampler sampler(print.level, under.centre, under.by_ray * tile.ray_by_pixel,
                                             kCardTileSide);
                  std::array<FloatLanes, 5> lanes{};  // of print, picture and their products
                  for_each_lanes(bits, [&](int column, int row, unsigned flags) {
                    const FloatLanes used = flags_of(flags);
                    const FloatLanes p = used * sampler.at(column, row).gray;
                    const FloatLanes q = used * load_gray(gray.row(tile.y + row) + tile.x + column);
                    lanes[0] += p;
                    lanes[1] += q;
                    lanes[2] += p * p;
                    lanes[3] += q * q;
                    lanes[4] += p * q;
                  });
                  std::array<double, 5> sums{};
                  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = sum_of(lanes[i]);
                  const double n = std::popcount(bits);
                  const Vec2 at = plane.normalised(under.centre);
                  PrintAtPlace& place =
                      places[place_of(at.y(), kPlaceRows) * kPlaceColumns + place_of(at.x(), kPlaceColumns)];
                  place.pixels += n;
                  place.tiles += 1.0;
                  place.print += sums[2] - sums[0] * sums[0] / n;
                  place.picture += sums[3] - sums[1] * sums[1] / n;
                  place.together += sums[4] - sums[0] * sums[1] / n;
                });
  return places;
}

// The median by pixels: as long as half of the card is seen, what hides the rest does not count.
double usual_slope(const PrintPlaces& places) {
  PrintPlaces sorted;
  std::size_t count = 0;
  double rest = 0.0;
  for (const PrintAtPlace& place : places) {
    if (!place.is_textured()) continue;
    sorted[count++] = place;
    rest += 0.5 * place.pixels;
  }
  const std::span<PrintAtPlace> textured = std::span(sorted).first(count);
  std::ranges::sort(textured, {}, &PrintAtPlace::slope);
  for (const PrintAtPlace& place : textured) {
    rest -= place.pixels;
    if (rest <= 0.0) return place.slope();
  }
  return 0.0;
}

double hidden_fraction(const PrintPlaces& places, const CardConditionParams& params) {
  const double usual = usual_slope(places);
  if (!(usual > 0.0)) return 1.0;
  double hidden = 0.0;
  double all = 0.0;
  for (const PrintAtPlace& place : places) {
    if (!place.is_textured()) continue;
    const double contrast = place.slope() / usual;
    const double sigma = place.slope_sigma() / usual;
    all += place.pixels;
    const bool is_told = 1.0 - params.min_contrast > params.told_sigmas * sigma;
    if (is_told && contrast + params.sure_sigmas * sigma < params.min_contrast) hidden += place.pixels;
  }
  return hidden / all;
}

// The card as a quadratic surface over its plane: u², u v, v² times mm; u and v from −1 to 1 over the card.
// What of it is a plane, the pose takes.
using Bend = Vec3;
constexpr int kBendStart = kPoseParameters;
constexpr int kMotion = kPoseParameters + 3;
using BendEquations = NormalEquations<kMotion + 6>;

Vec3 shapes_at(const Vec2& normalised) {
  const double u = normalised.x();
  const double v = normalised.y();
  return {u * u - 1.0 / 3.0, u * v, v * v - 1.0 / 3.0};
}

struct BentFit {
  Pose camera_from_table;
  CardTone tone;
  Bend bend_mm = Bend::Zero();
};

struct BentLinearisation {
  BendEquations equations;
  BendEquations::Matrix scatter = BendEquations::Matrix::Zero();
  double weights = 0.0;
  double slopes = 0.0;
  double most_shift = 0.0;  // of the print in mm, by a mm of height
};

BentLinearisation linearise(const AlignedPrint& print, const BentFit& fit) {
  const PrintPlane plane(fit.camera_from_table, print.size);
  const ImageView<const std::uint8_t> gray = print.picture.gray();
  const auto inverse_cutoff = static_cast<float>(1.0 / print.cutoff_gray);
  BentLinearisation result;
  for_each_tile(print.picture.tiles(), plane, print.sampling,
                [&](const CardTile& tile, const PrintPlace& under, std::uint64_t bits) {
                  const Vec2 at = plane.normalised(under.centre);
                  const Vec3 shapes = shapes_at(at);
                  const Vec2 by_height = plane.print_by_height(tile.ray);
                  const TileTone tone(fit.tone, at);
                  const PrintSampler sampler(print.level, under.centre + fit.bend_mm.dot(shapes) * by_height,
                                             under.by_ray * tile.ray_by_pixel, kCardTileSide);
                  TileSums sums;
                  for_each_lanes(bits, [&](int column, int row, unsigned flags) {
                    const PrintLanes lanes = sampler.at(column, row);
                    const FloatLanes picture = load_gray(gray.row(tile.y + row) + tile.x + column);
                    sums.add_weighed(lanes, tone.residual(picture, lanes.gray), inverse_cutoff, flags);
                  });
                  Eigen::Matrix<double, 2, kMotion> print_by_step;
                  print_by_step << plane.print_by_step(under, tile.ray), by_height * shapes.transpose();
                  const Vec2 scale = tone.gain() * print.level.px_per_mm();
                  add_tile<kMotion>(sums, scale.asDiagonal() * print_by_step, tone.linear(), result.equations,
                                    result.scatter);
                  result.weights += sum_of(sums.weights);
                  result.slopes += sum_of(sums.slopes);
                  result.most_shift = std::max(result.most_shift, by_height.norm());
                });
  return result;
}

// Rise from the middle to the edge in the direction in which it is largest.
double largest_rise_mm(const Bend& bend_mm) {
  const double mean = 0.5 * (bend_mm[0] + bend_mm[2]);
  const double differs = 0.5 * std::hypot(bend_mm[0] - bend_mm[2], bend_mm[1]);
  return std::abs(mean) + differs;
}

// Leaves both numbers 0 where nothing tells a bend.
void measure_bend(const AlignedPrint& print, const CardConditionParams& params, CardCondition& condition) {
  // On 76 views of unseen trays the second step moves the bend by 0.12 mm at most, the third by 0.10 (median
  // 0.006).
  constexpr int kIterations = 3;
  BentFit fit{print.camera_from_table, print.tone};
  Mat3 covariance = Mat3::Zero();
  double most_shift = 0.0;
  for (int i = 0; i < kIterations; ++i) {
    const BentLinearisation linearised = linearise(print, fit);
    const double curvature = linearised.slopes / linearised.weights;
    const BendEquations::Matrix inverse = inverse_information(linearised.equations.hessian);
    if (!(curvature > 0.0) || !(inverse(0, 0) > 0.0)) return;
    const BendEquations::Vector change = -inverse.lazyProduct(linearised.equations.gradient);
    if (!change.allFinite()) return;
    const BendEquations::Matrix scatter = linearised.scatter.selfadjointView<Eigen::Lower>();
    const Eigen::Matrix<double, 3, kMotion + 6> rows = inverse.middleRows<3>(kBendStart);
    covariance = rows.lazyProduct(scatter).eval().lazyProduct(rows.transpose()) / (curvature * curvature);
    most_shift = linearised.most_shift;
    fit.camera_from_table = moved(fit.camera_from_table, change.head<kPoseParameters>());
    fit.bend_mm += change.segment<3>(kBendStart);
    fit.tone += change.tail<6>();
  }
  if (!(most_shift > 0.0)) return;
  const double systematic_mm = params.systematic_px / (print.px_per_mm * most_shift);
  const Mat3 information =
      inverse_information<3>(covariance + systematic_mm * systematic_mm * Mat3::Identity());
  condition.bend_mm = largest_rise_mm(fit.bend_mm);
  condition.bend_square = fit.bend_mm.dot(information * fit.bend_mm);
}

}  // namespace

CardCondition judge_card(const AlignedPrint& print, const CardConditionParams& params) {
  CardCondition condition;
  condition.hidden_fraction = hidden_fraction(sum_places(print), params);
  measure_bend(print, params, condition);
  condition.is_doubtful = condition.hidden_fraction > 0.0 || condition.bend_square > params.max_bend_square;
  return condition;
}

}  // namespace traygauge
