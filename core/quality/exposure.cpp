#include "core/quality/exposure.hpp"

#include <array>
#include <cmath>

#include "core/base/units.hpp"

namespace traygauge {
namespace {

using Histogram = std::array<std::uint32_t, kByteValues>;

Histogram count_gray_values(ImageView<const std::uint8_t> gray) {
  // Two counters a value: neighbours are often equal, and the same counter twice in a row stalls.
  Histogram even{};
  Histogram odd{};
  for (int y = 0; y < gray.height; ++y) {
    const std::uint8_t* pixels = gray.row(y);
    int x = 0;
    for (; x + 1 < gray.width; x += 2) {
      ++even[pixels[x]];
      ++odd[pixels[x + 1]];
    }
    if (x < gray.width) ++even[pixels[x]];
  }
  for (std::size_t i = 0; i < even.size(); ++i) even[i] += odd[i];
  return even;
}

}  // namespace

Status check_exposure(ImageView<const std::uint8_t> gray, const ExposureParams& params) {
  if (gray.empty()) return StatusCode::frame_missing;
  const Histogram histogram = count_gray_values(gray);
  double black = 0.0;
  double burnt = 0.0;
  double sum = 0.0;
  double square_sum = 0.0;
  for (std::size_t value = 0; value < histogram.size(); ++value) {
    const double count = histogram[value];
    const auto gray_value = static_cast<double>(value);
    if (value <= params.black_level) black += count;
    if (value >= kBurntGray) burnt += count;
    sum += count * gray_value;
    square_sum += count * gray_value * gray_value;
  }
  const double pixels = static_cast<double>(gray.width) * gray.height;
  if (black > params.max_black_fraction * pixels) return StatusCode::frame_too_dark;
  if (burnt > params.max_burnt_fraction * pixels) return StatusCode::frame_too_bright;
  const double mean = sum / pixels;
  const double variance = square_sum / pixels - mean * mean;
  if (variance < params.min_deviation * params.min_deviation) return StatusCode::too_few_features;
  return StatusCode::ok;
}

}  // namespace traygauge
