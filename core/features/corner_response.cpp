#include "core/features/corner_response.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

using Workspace = CornerResponseWorkspace;

// Sobel's weights add up to 8 a side and the window holds 25 pixels.
constexpr float kPerWindow = 1.0F / (64.0F * Workspace::kWindowRows * Workspace::kWindowRows);

// Replaces a ring row's products by those of a new row of the picture, in the column sums too.
void update_products(const std::uint8_t* __restrict upper, const std::uint8_t* __restrict middle,
                     const std::uint8_t* __restrict lower, int width, const Workspace::Products& ring,
                     const Workspace::Products& columns) {
  std::int32_t* __restrict ring_xx = ring.xx.data();
  std::int32_t* __restrict ring_xy = ring.xy.data();
  std::int32_t* __restrict ring_yy = ring.yy.data();
  std::int32_t* __restrict xx = columns.xx.data();
  std::int32_t* __restrict xy = columns.xy.data();
  std::int32_t* __restrict yy = columns.yy.data();
  for (int x = 1; x < width - 1; ++x) {
    const auto dx = static_cast<std::int16_t>(
        (upper[x + 1] - upper[x - 1]) + 2 * (middle[x + 1] - middle[x - 1]) + (lower[x + 1] - lower[x - 1]));
    const auto dy = static_cast<std::int16_t>((lower[x - 1] - upper[x - 1]) + 2 * (lower[x] - upper[x]) +
                                              (lower[x + 1] - upper[x + 1]));
    const std::int32_t new_xx = dx * dx;
    const std::int32_t new_xy = dx * dy;
    const std::int32_t new_yy = dy * dy;
    xx[x] += new_xx - ring_xx[x];
    xy[x] += new_xy - ring_xy[x];
    yy[x] += new_yy - ring_yy[x];
    ring_xx[x] = new_xx;
    ring_xy[x] = new_xy;
    ring_yy[x] = new_yy;
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
