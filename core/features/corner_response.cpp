#include "core/features/corner_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/lanes.hpp"

namespace traygauge {
namespace {

using Workspace = CornerResponseWorkspace;

// Sobel's weights add up to 8 a side and the window holds 25 pixels.
constexpr float kPerWindow = 1.0F / (64.0F * Workspace::kWindowRows * Workspace::kWindowRows);

using Gradients = std::array<std::int16_t, kRowBlock>;

// Of `count` pixels; whole registers of 16-bit numbers.
void find_gradients(const std::uint8_t* __restrict upper, const std::uint8_t* __restrict middle,
                    const std::uint8_t* __restrict lower, std::size_t count, Gradients& across,
                    Gradients& down) {
  for (std::size_t x = 0; x < count; ++x) {
    across[x] = static_cast<std::int16_t>((upper[x + 2] - upper[x]) + 2 * (middle[x + 2] - middle[x]) +
                                          (lower[x + 2] - lower[x]));
    down[x] = static_cast<std::int16_t>((lower[x] - upper[x]) + 2 * (lower[x + 1] - upper[x + 1]) +
                                        (lower[x + 2] - upper[x + 2]));
  }
}

// Replaces a ring row's products by new ones, in the column sums too.
void replace_products(const Gradients& a, const Gradients& b, std::size_t count,
                      std::int32_t* __restrict ring, std::int32_t* __restrict columns) {
  for (std::size_t x = 0; x < count; ++x) {
    const std::int32_t product = a[x] * b[x];
    columns[x] += product - ring[x];
    ring[x] = product;
  }
}

// The same for a new row of the picture.
void update_products(const std::uint8_t* upper, const std::uint8_t* middle, const std::uint8_t* lower,
                     int width, const Workspace::Products& ring, const Workspace::Products& columns) {
  Gradients across;
  Gradients down;
  for (int left = 1; left < width - 1; left += kRowBlock) {
    const auto count = static_cast<std::size_t>(std::min(kRowBlock, width - 1 - left));
    find_gradients(upper + left - 1, middle + left - 1, lower + left - 1, count, across, down);
    replace_products(across, across, count, ring.xx.data() + left, columns.xx.data() + left);
    replace_products(across, down, count, ring.xy.data() + left, columns.xy.data() + left);
    replace_products(down, down, count, ring.yy.data() + left, columns.yy.data() + left);
  }
}

std::int32_t sum_across(const std::int32_t* columns) {
  static_assert(kCornerWindowRadius == 2);
  return columns[-2] + columns[-1] + columns[0] + columns[1] + columns[2];
}

}  // namespace

CornerResponse::CornerResponse(ImageView<const std::uint8_t> gray, CornerResponseWorkspace& workspace)
    : gray_(gray), workspace_(workspace) {
  const auto clear = [](Workspace::Products& products) {
    for (const std::span<std::int32_t>& sums : {products.xx, products.xy, products.yy})
      std::fill(sums.begin(), sums.end(), 0);
  };
  for (Workspace::Products& row : workspace_.rows) clear(row);
  clear(workspace_.columns);
  while (next_gradient_row_ < 2 * kCornerWindowRadius + 1) add_gradient_row(next_gradient_row_++);
}

void CornerResponse::add_gradient_row(int y) {
  update_products(gray_.row(y - 1), gray_.row(y), gray_.row(y + 1), gray_.width,
                  workspace_.rows[static_cast<std::size_t>(y) % Workspace::kWindowRows], workspace_.columns);
}

void CornerResponse::next_row(std::span<float> responses) {
  add_gradient_row(next_gradient_row_++);
  const int width = gray_.width;
  const Workspace::Products& columns = workspace_.columns;
  const std::int32_t* __restrict xx = columns.xx.data();
  const std::int32_t* __restrict xy = columns.xy.data();
  const std::int32_t* __restrict yy = columns.yy.data();
  float* __restrict out = responses.data();
  for (int x = 0; x < kCornerBorder; ++x) out[x] = out[width - 1 - x] = 0.0F;
  for (int x = kCornerBorder; x < width - kCornerBorder; ++x) {
    // At most 25 · 1020²: the sums fit in 32 bits, and floats hold them to one part in 2²⁴.
    const auto a = static_cast<float>(sum_across(xx + x));
    const auto b = static_cast<float>(sum_across(xy + x));
    const auto c = static_cast<float>(sum_across(yy + x));
    const float half_difference = 0.5F * (a - c);
    out[x] = kPerWindow * (0.5F * (a + c) - std::sqrt(half_difference * half_difference + b * b));
  }
}

}  // namespace traygauge
