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

struct Coefficients {
  std::int32_t black;  // the grey value
  std::int32_t grey;
  std::int32_t blue_from_u;
  std::int32_t green_from_u;
  std::int32_t green_from_v;
  std::int32_t red_from_v;
};
constexpr Coefficients coefficients(std::int32_t black, double grey, double blue_from_u, double green_from_u,
                                    double green_from_v, double red_from_v) {
  return {black,
          fixed_point(grey),
          fixed_point(blue_from_u),
          fixed_point(green_from_u),
          fixed_point(green_from_v),
          fixed_point(red_from_v)};
}

// ITU-R BT.601 and BT.709. In the range of video grey spans 219 steps, colours 224.
constexpr Coefficients kVideo601 = coefficients(16, 1.164, 2.018, -0.391, -0.813, 1.596);
constexpr Coefficients kVideo709 = coefficients(16, 1.164, 2.112, -0.213, -0.533, 1.793);
constexpr Coefficients kFull601 = coefficients(0, 1.0, 1.772, -0.344136, -0.714136, 1.402);
constexpr Coefficients kFull709 = coefficients(0, 1.0, 1.8556, -0.187324, -0.468124, 1.5748);

const Coefficients& coefficients_of(const YuvCoding& coding) {
  if (coding.is_full_range) return coding.is_bt709 ? kFull709 : kFull601;
  return coding.is_bt709 ? kVideo709 : kVideo601;
}

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

void convert_planes(const Coefficients& by, const Planes& in, int pairs, std::uint8_t* bgr) {
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
    const std::int32_t blue = kHalf + by.blue_from_u * u;
    const std::int32_t green = kHalf + by.green_from_u * u + by.green_from_v * v;
    const std::int32_t red = kHalf + by.red_from_v * v;
    const std::int32_t left = std::max(in.left[i] - by.black, 0) * by.grey;
    const std::int32_t right = std::max(in.right[i] - by.black, 0) * by.grey;
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
void convert_row(const Coefficients& by, int width, std::uint8_t* bgr, const Split& split) {
  Planes planes{};
  const int row_pairs = width / 2;
  for (int first = 0; first < row_pairs; first += kPairs) {
    const int pairs = std::min(kPairs, row_pairs - first);
    split(first, pairs, planes);
    convert_planes(by, planes, pairs, bgr + std::ptrdiff_t{6} * first);
  }
}

}  // namespace

void convert_yuyv(const RawFrame& frame, const YuvCoding& coding, std::uint8_t* bgr) {
  const Coefficients& by = coefficients_of(coding);
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* const row = frame.bytes.data() + y * frame.stride_bytes;
    convert_row(by, frame.width, bgr + std::ptrdiff_t{3} * frame.width * y,
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

void convert_nv12(const RawFrame& frame, const YuvCoding& coding, std::uint8_t* bgr) {
  const Coefficients& by = coefficients_of(coding);
  const std::uint8_t* const colours = frame.bytes.data() + frame.height * frame.stride_bytes;
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* const grey_row = frame.bytes.data() + y * frame.stride_bytes;
    const std::uint8_t* const colour_row = colours + y / 2 * frame.stride_bytes;
    convert_row(by, frame.width, bgr + std::ptrdiff_t{3} * frame.width * y,
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
