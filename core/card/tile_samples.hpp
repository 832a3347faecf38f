// Loops over a picture's tiles and the print under them, for who sums up how both compare.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/card/card_picture.hpp"
#include "core/card/print_lanes.hpp"
#include "core/card/print_plane.hpp"
#include "core/geometry/levenberg_marquardt.hpp"

namespace traygauge {

static_assert(kCardTileSide % kFloatLanes == 0);

inline std::uint64_t mask_of(CardSampling sampling) {
  switch (sampling) {
    case CardSampling::all:
      return ~std::uint64_t{0};
    case CardSampling::half:
      return 0x00FF00FF00FF00FFU;
    default:
      return 0x0000FF000000FF00U;
  }
}

inline bool is_taken(const CardTile& tile, CardSampling sampling) {
  return sampling != CardSampling::sixteenth || ((tile.x + 2 * tile.y) / kCardTileSide) % 4 == 0;
}

// Calls use(tile, place, bits) for every tile with samples.
template <class Use>
void for_each_tile(std::span<const CardTile> tiles, const PrintPlane& plane, CardSampling sampling, Use use) {
  const std::uint64_t mask = mask_of(sampling);
  for (const CardTile& tile : tiles) {
    const std::uint64_t bits = tile.used & mask;
    if (bits == 0 || !is_taken(tile, sampling)) continue;
    const PrintPlace place = plane.place(tile.ray);
    if (place.valid()) use(tile, place, bits);
  }
}

// Calls use(column, row, flags) for every kFloatLanes pixels of a tile of which some are samples.
template <class Use>
void for_each_lanes(std::uint64_t bits, Use use) {
  constexpr unsigned kLaneBits = (1U << kFloatLanes) - 1U;
  for (int bit = 0; bit < kCardTileSide * kCardTileSide; bit += kFloatLanes) {
    const auto here = static_cast<unsigned>(bits >> bit) & kLaneBits;
    if (here != 0) use(bit % kCardTileSide, bit / kCardTileSide, here);
  }
}

// The tone at a tile, taken as constant there.
class TileTone {
 public:
  TileTone(const CardTone& tone, const Vec2& normalised) : linear_(1.0, normalised.x(), normalised.y()) {
    gain_ = tone.head<3>().dot(linear_);
    gain_lane_ = static_cast<float>(gain_);
    offset_lane_ = static_cast<float>(tone.tail<3>().dot(linear_));
  }
  double gain() const { return gain_; }
  const Vec3& linear() const { return linear_; }  // derivative of gain, and of offset, by their parameters
  FloatLanes residual(FloatLanes picture, FloatLanes print) const {
    return picture - gain_lane_ * print - offset_lane_;
  }

 private:
  Vec3 linear_;
  double gain_ = 0.0;
  float gain_lane_ = 0.0F;
  float offset_lane_ = 0.0F;
};

// Weighted sums over a tile's samples of the products of (by_x, by_y, gray, 1) among themselves and with the
// residual.
struct TileSums {
  std::array<FloatLanes, 10> products{};  // lower triangle by rows
  std::array<FloatLanes, 4> residuals{};
  FloatLanes weights{};
  FloatLanes slopes{};

  void add(const PrintLanes& print, FloatLanes residual, FloatLanes weight) {
    const std::array<FloatLanes, 3> v = {print.by_x, print.by_y, print.gray};
    std::size_t k = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const FloatLanes scaled = weight * v[i];
      residuals[i] += scaled * residual;
      for (std::size_t j = 0; j <= i; ++j) products[k++] += scaled * v[j];
    }
    for (std::size_t j = 0; j < 3; ++j) products[k++] += weight * v[j];
    products[k] += weight;
    residuals[3] += weight * residual;
    weights += weight;
  }

  // The residual by Geman and McClure: 1 / (1 + (r / cutoff)²)².
  void add_weighed(const PrintLanes& print, FloatLanes residual, float inverse_cutoff, unsigned flags) {
    const FloatLanes ratio = residual * inverse_cutoff;
    const FloatLanes root = 1.0F / (1.0F + ratio * ratio);
    const FloatLanes weight = flags_of(flags) * root * root;
    add(print, residual, weight);
    slopes += weight * (4.0F * root - 3.0F);
  }
};

// Adds a tile's sums. Its grey values move with the motion's step by `gray_by_step` times (by_x, by_y), and
// with gain and offset, each by `linear` times its three parameters, which follow the motion's.
template <int kMotion>
void add_tile(const TileSums& sums, const Eigen::Matrix<double, 2, kMotion>& gray_by_step, const Vec3& linear,
              NormalEquations<kMotion + 6>& equations,
              typename NormalEquations<kMotion + 6>::Matrix& scatter) {
  constexpr int kAll = kMotion + 6;
  constexpr int kOffset = kMotion + 3;
  std::array<double, 10> p{};
  std::array<double, 4> r{};
  for (std::size_t i = 0; i < 10; ++i) p[i] = sum_of(sums.products[i]);
  for (std::size_t i = 0; i < 4; ++i) r[i] = sum_of(sums.residuals[i]);
  Eigen::Matrix<double, kAll, 1> gradient;
  auto& hessian = equations.hessian;
  for (int i = 0; i < kMotion; ++i) {
    const double a = gray_by_step(0, i);
    const double b = gray_by_step(1, i);
    gradient[i] = a * r[0] + b * r[1];
    const double along_x = a * p[0] + b * p[1];
    const double along_y = a * p[1] + b * p[2];
    for (int j = 0; j <= i; ++j) hessian(i, j) += along_x * gray_by_step(0, j) + along_y * gray_by_step(1, j);
    const double with_gain = a * p[3] + b * p[4];
    const double with_offset = a * p[6] + b * p[7];
    for (int k = 0; k < 3; ++k) {
      hessian(kMotion + k, i) += with_gain * linear[k];
      hessian(kOffset + k, i) += with_offset * linear[k];
    }
  }
  for (int i = 0; i < 3; ++i) {
    gradient[kMotion + i] = r[2] * linear[i];
    gradient[kOffset + i] = r[3] * linear[i];
    for (int j = 0; j < 3; ++j) {
      const double both = linear[i] * linear[j];
      hessian(kOffset + i, kMotion + j) += both * p[8];
      if (j > i) continue;
      hessian(kMotion + i, kMotion + j) += both * p[5];
      hessian(kOffset + i, kOffset + j) += both * p[9];
    }
  }
  equations.gradient -= gradient;
  for (int i = 0; i < kAll; ++i) {
    for (int j = 0; j <= i; ++j) scatter(i, j) += gradient[i] * gradient[j];
  }
}

}  // namespace traygauge
