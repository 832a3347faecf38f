#include "drivers/pixels/yuv.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace traygauge {
namespace {

constexpr int kShift = 20;
constexpr std::int32_t fixed_point(double coefficient) {
  return static_cast<std::int32_t>(coefficient * (1 << kShift) + (coefficient < 0.0 ? -0.5 : 0.5));
}

// BT.601: grey spans 219 steps, colours 224.
constexpr std::int32_t kGrey = fixed_point(1.164);
constexpr std::int32_t kBlueFromU = fixed_point(2.018);
constexpr std::int32_t kGreenFromU = fixed_point(-0.391);
constexpr std::int32_t kGreenFromV = fixed_point(-0.813);
constexpr std::int32_t kRedFromV = fixed_point(1.596);

// Pairs of pixels that share their colours, converted together so that the compiler makes vectors of them.
constexpr int kPairs = 64;

template <class T>
using PairsOf = std::array<T, kPairs>;

// A pair's grey values and colours, apart.
struct Planes {
  PairsOf<std::uint8_t> left;
  PairsOf<std::uint8_t> right;
  PairsOf<std::uint8_t> u;
  PairsOf<std::uint8_t> v;
};

std::uint8_t to_byte(std::int32_t value) {
  return static_cast<std::uint8_t>(std::clamp(value >> kShift, 0, 255));
}

void convert_planes(const Planes& in, int pairs, std::uint8_t* bgr) {
  constexpr std::int32_t kHalf = 1 << (kShift - 1);
  PairsOf<std::uint8_t> left_b;
  PairsOf<std::uint8_t> left_g;
  PairsOf<std::uint8_t> left_r;
  PairsOf<std::uint8_t> right_b;
  PairsOf<std::uint8_t> right_g;
  PairsOf<std::uint8_t> right_r;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const std::int32_t u = in.u[i] - 128;
    const std::int32_t v = in.v[i] - 128;
    const std::int32_t blue = kHalf + kBlueFromU * u;
    const std::int32_t green = kHalf + kGreenFromU * u + kGreenFromV * v;
    const std::int32_t red = kHalf + kRedFromV * v;
    const std::int32_t left = std::max(in.left[i] - 16, 0) * kGrey;
    const std::int32_t right = std::max(in.right[i] - 16, 0) * kGrey;
    left_b[i] = to_byte(left + blue);
    left_g[i] = to_byte(left + green);
    left_r[i] = to_byte(left + red);
    right_b[i] = to_byte(right + blue);
    right_g[i] = to_byte(right + green);
    right_r[i] = to_byte(right + red);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(pairs); ++i) {
    bgr[6 * i] = left_b[i];
    bgr[6 * i + 1] = left_g[i];
    bgr[6 * i + 2] = left_r[i];
    bgr[6 * i + 3] = right_b[i];
    bgr[6 * i + 4] = right_g[i];
    bgr[6 * i + 5] = right_r[i];
  }
}

// `split` takes a pair's index in the row, a count, and fills the planes.
template <class Split>
void convert_row(int width, std::uint8_t* bgr, const Split& split) {
  Planes planes{};
  const int row_pairs = width / 2;
  for (int first = 0; first < row_pairs; first += kPairs) {
    const int pairs = std::min(kPairs, row_pairs - first);
    split(first, pairs, planes);
    convert_planes(planes, pairs, bgr + std::ptrdiff_t{6} * first);
  }
}

}  // namespace

void convert_yuyv(const RawFrame& frame, std::uint8_t* bgr) {
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* const row = frame.bytes.data() + y * frame.stride_bytes;
    convert_row(frame.width, bgr + std::ptrdiff_t{3} * frame.width * y,
                [row](int first, int pairs, Planes& planes) {
                  const std::uint8_t* const from = row + std::ptrdiff_t{4} * first;
                  for (std::size_t i = 0; i < static_cast<std::size_t>(pairs); ++i) {
                    planes.left[i] = from[4 * i];
                    planes.u[i] = from[4 * i + 1];
                    planes.right[i] = from[4 * i + 2];
                    planes.v[i] = from[4 * i + 3];
                  }
                });
  }
}

void convert_nv12(const RawFrame& frame, std::uint8_t* bgr) {
  const std::uint8_t* const colours = frame.bytes.data() + frame.height * frame.stride_bytes;
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* const grey_row = frame.bytes.data() + y * frame.stride_bytes;
    const std::uint8_t* const colour_row = colours + y / 2 * frame.stride_bytes;
    convert_row(frame.width, bgr + std::ptrdiff_t{3} * frame.width * y,
                [grey_row, colour_row](int first, int pairs, Planes& planes) {
                  const std::uint8_t* const grey = grey_row + std::ptrdiff_t{2} * first;
                  const std::uint8_t* const colour = colour_row + std::ptrdiff_t{2} * first;
                  for (std::size_t i = 0; i < static_cast<std::size_t>(pairs); ++i) {
                    planes.left[i] = grey[2 * i];
                    planes.right[i] = grey[2 * i + 1];
                    planes.u[i] = colour[2 * i];
                    planes.v[i] = colour[2 * i + 1];
                  }
                });
  }
}

}  // namespace traygauge
