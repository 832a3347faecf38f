#include "core/card/card_picture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/median.hpp"
#include "core/base/units.hpp"
#include "core/card/print_plane.hpp"
#include "core/card/tile_samples.hpp"

namespace traygauge {
namespace {

// The tile's pixels with the label that lie inside it along rows and columns: those nearer to its border hold
// light of both sides.
std::uint64_t inner_pixels(ImageView<const std::uint8_t> labels, int left, int top) {
  constexpr int kInsetPx = 2;
  const auto is_card = [&](int x, int y) { return labels.contains(x, y) && labels.at(x, y) == kCardLabel; };
  std::uint64_t bits = 0;
  for (int bit = 0; bit < kCardTileSide * kCardTileSide; ++bit) {
    const int x = left + bit % kCardTileSide;
    const int y = top + bit / kCardTileSide;
    const bool is_inner = is_card(x, y) && is_card(x - kInsetPx, y) && is_card(x + kInsetPx, y) &&
                          is_card(x, y - kInsetPx) && is_card(x, y + kInsetPx);
    if (is_inner) bits |= std::uint64_t{1} << bit;
  }
  return bits;
}

bool undistort_tile(const LensModel& lens, CardTile& tile) {
  constexpr double kHalf = 0.5 * (kCardTileSide - 1);
  const Vec2 centre(tile.x + kHalf, tile.y + kHalf);
  Vec2 along_x;
  Vec2 along_y;
  if (!lens.undistort_pixel(centre, tile.ray) || !lens.undistort_pixel(centre + Vec2::UnitX(), along_x) ||
      !lens.undistort_pixel(centre + Vec2::UnitY(), along_y)) {
    return false;
  }
  tile.ray_by_pixel << along_x - tile.ray, along_y - tile.ray;
  return true;
}

using Histogram = std::array<std::uint32_t, kByteValues>;

void count_sizes(FloatLanes residual, unsigned bits, Histogram& histogram) {
  const FloatLanes size = residual < 0.0F ? -residual : residual;
  const FloatLanes last = FloatLanes{} + (static_cast<float>(kByteValues) - 1.0F);
  const IntLanes bins = __builtin_convertvector(size < last ? size : last, IntLanes);
  for (int i = 0; i < kFloatLanes; ++i) histogram[static_cast<std::size_t>(bins[i])] += bits >> i & 1U;
}

double median_of(const Histogram& histogram, int count) {
  int below = 0;
  for (int bin = 0; bin < static_cast<int>(kByteValues); ++bin) {
    const auto here = static_cast<int>(histogram[static_cast<std::size_t>(bin)]);
    if (2 * (below + here) >= count) return bin + (0.5 * count - below) / std::max(here, 1);
    below += here;
  }
  return static_cast<double>(kByteValues);
}

}  // namespace

Status CardPicture::load(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels,
                         const PixelBox& box, const LensModel& lens) {
  gray_ = gray;
  tiles_ = {};
  used_ = 0;
  labelled_ = 0;
  for (int y = box.top; y < box.bottom; ++y) {
    const std::uint8_t* row = labels.row(y);
    labelled_ += static_cast<int>(std::count(row + box.left, row + box.right, kCardLabel));
  }
  const int columns = (box.width() + kCardTileSide - 1) / kCardTileSide;
  const int rows = (box.height() + kCardTileSide - 1) / kCardTileSide;
  // A card that lies askew fills half its box at the least.
  const int every = 1 + columns * rows / (2 * std::max(1, static_cast<int>(storage_.size())));
  std::size_t count = 0;
  for (int i = 0; i < columns * rows && count < storage_.size(); i += every) {
    CardTile& tile = storage_[count];
    tile.x = box.left + i % columns * kCardTileSide;
    tile.y = box.top + i / columns * kCardTileSide;
    const bool is_whole = tile.x + kCardTileSide <= labels.width && tile.y + kCardTileSide <= labels.height;
    if (!is_whole) continue;
    tile.labelled = inner_pixels(labels, tile.x, tile.y);
    if (tile.labelled != 0 && undistort_tile(lens, tile)) ++count;
  }
  tiles_ = storage_.first(count);
  return count > 0 ? StatusCode::ok : StatusCode::card_not_found;
}

void CardPicture::select(const Pose& camera_from_table, const CardModelSize& size, double margin_mm) {
  const PrintPlane plane(camera_from_table, size);
  const Vec2 middle(0.5 * size.width_mm, 0.5 * size.height_mm);
  const Vec2 inside = (middle.array() - margin_mm).matrix();
  constexpr double kHalf = 0.5 * (kCardTileSide - 1);
  used_ = 0;
  for (CardTile& tile : tiles_) {
    tile.used = 0;
    const PrintPlace place = plane.place(tile.ray);
    if (!place.valid()) continue;
    const Eigen::Matrix2d by_pixel = place.by_ray * tile.ray_by_pixel;
    const Vec2 from_middle = place.centre - middle;
    const Vec2 reach = kHalf * by_pixel.cwiseAbs().rowwise().sum();
    if (((from_middle.cwiseAbs() + reach).array() < inside.array()).all()) {
      tile.used = tile.labelled;
    } else {
      for (std::uint64_t rest = tile.labelled; rest != 0; rest &= rest - 1) {
        const int bit = std::countr_zero(rest);
        const int row = bit / kCardTileSide;
        const Vec2 offset(bit % kCardTileSide - kHalf, row - kHalf);
        const Vec2 at = from_middle + by_pixel * offset;
        if ((at.cwiseAbs().array() < inside.array()).all()) tile.used |= std::uint64_t{1} << bit;
      }
    }
    used_ += std::popcount(tile.used);
  }
}

CardCorrelation CardPicture::correlate(const Pose& camera_from_table, const CardModelSize& size,
                                       const CardPatternLevel& level, CardSampling sampling,
                                       const CardInliers& inliers) const {
  const PrintPlane plane(camera_from_table, size);
  const auto cutoff = static_cast<float>(inliers.cutoff_gray);
  CardCorrelation result;
  std::array<double, 6> sums{};  // of print, picture, their products, and 1
  for_each_tile(
      tiles_, plane, sampling, [&](const CardTile& tile, const PrintPlace& place, std::uint64_t bits) {
        const TileTone tone(inliers.tone, plane.normalised(place.centre));
        const PrintSampler sampler(level, place.centre, place.by_ray * tile.ray_by_pixel, kCardTileSide);
        std::array<FloatLanes, 6> lanes{};
        for_each_lanes(bits, [&](int column, int row, unsigned flags) {
          const FloatLanes print = sampler.at(column, row).gray;
          const FloatLanes picture = load_gray(gray_.row(tile.y + row) + tile.x + column);
          const FloatLanes residual = tone.residual(picture, print);
          const FloatLanes size_of = residual < 0.0F ? -residual : residual;
          const FloatLanes used = size_of <= cutoff ? flags_of(flags) : FloatLanes{};
          lanes[0] += used * print;
          lanes[1] += used * picture;
          lanes[2] += used * print * print;
          lanes[3] += used * picture * picture;
          lanes[4] += used * print * picture;
          lanes[5] += used;
        });
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += sum_of(lanes[i]);
        result.samples += std::popcount(bits);
      });
  const double n = sums[5];
  result.inliers = static_cast<int>(n);
  if (result.inliers < 2) return result;
  const double print_varies = sums[2] - sums[0] * sums[0] / n;
  const double picture_varies = sums[3] - sums[1] * sums[1] / n;
  const double together = sums[4] - sums[0] * sums[1] / n;
  if (!(print_varies > n) || !(picture_varies > n)) return result;  // flat to one grey value: nothing to see
  result.correlation = together / std::sqrt(print_varies * picture_varies);
  result.tone[0] = together / print_varies;
  result.tone[3] = (sums[1] - result.tone[0] * sums[0]) / n;
  result.rms_gray = std::sqrt(std::max(0.0, picture_varies - together * together / print_varies) / n);
  return result;
}

CardLinearisation CardPicture::linearise(const Pose& camera_from_table, const CardModelSize& size,
                                         const CardPatternLevel& level, const CardTone& tone,
                                         double cutoff_gray, CardSampling sampling) const {
  const PrintPlane plane(camera_from_table, size);
  const auto inverse_cutoff = static_cast<float>(1.0 / cutoff_gray);
  CardLinearisation result;
  Histogram histogram{};
  for_each_tile(
      tiles_, plane, sampling, [&](const CardTile& tile, const PrintPlace& place, std::uint64_t bits) {
        const TileTone tile_tone(tone, plane.normalised(place.centre));
        const PrintSampler sampler(level, place.centre, place.by_ray * tile.ray_by_pixel, kCardTileSide);
        TileSums sums;
        for_each_lanes(bits, [&](int column, int row, unsigned flags) {
          const PrintLanes print = sampler.at(column, row);
          const FloatLanes gray = load_gray(gray_.row(tile.y + row) + tile.x + column);
          const FloatLanes residual = tile_tone.residual(gray, print.gray);
          sums.add_weighed(print, residual, inverse_cutoff, flags);
          count_sizes(residual, flags, histogram);
        });
        const Eigen::Matrix<double, 2, 6> gray_by_step =
            tile_tone.gain() * level.px_per_mm().asDiagonal() * plane.print_by_step(place, tile.ray);
        add_tile(sums, gray_by_step, tile_tone.linear(), result.equations, result.scatter);
        result.weights += sum_of(sums.weights);
        result.slopes += sum_of(sums.slopes);
        result.samples += std::popcount(bits);
      });
  result.spread_gray = kMedianToSigma * median_of(histogram, result.samples);
  return result;
}

}  // namespace traygauge
