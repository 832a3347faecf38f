// Gaussian weights as compile-time tables.
#pragma once

#include <array>
#include <cstddef>

namespace traygauge {

// exp(−x) for 0 ≤ x ≤ 40: the series of exp(x / 64), inverted and raised; relative error below 1e-12.
constexpr double exp_of_minus(double x) {
  const double reduced = x / 64.0;
  double term = 1.0;
  double sum = 1.0;
  for (int i = 1; i <= 16; ++i) {
    term *= reduced / i;
    sum += term;
  }
  for (int i = 0; i < 6; ++i) sum *= sum;
  return 1.0 / sum;
}

// Peak 1.
constexpr double gaussian(double square_distance, double sigma) {
  return exp_of_minus(square_distance / (2.0 * sigma * sigma));
}

// kCount weights at unit distance, centred.
template <std::size_t kCount>
constexpr std::array<float, kCount> gaussian_row(double sigma) {
  std::array<float, kCount> weights{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const double offset = static_cast<double>(i) - 0.5 * (kCount - 1);
    weights[i] = static_cast<float>(gaussian(offset * offset, sigma));
  }
  return weights;
}

}  // namespace traygauge
