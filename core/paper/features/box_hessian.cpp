#include "core/paper/features/box_hessian.hpp"

#include <algorithm>

#include "core/paper/image/integral.hpp"

namespace traygauge::paper {
namespace {

// Rows of the integral image and of the column sums never overlap; said so, and one term at a time, the loops
// vectorise.
using SumRow = const std::uint32_t* __restrict;
using ColumnRow = std::int32_t* __restrict;

void set_sums(SumRow top, SumRow bottom, int width, ColumnRow columns) {
  for (int x = 0; x < width; ++x) columns[x] = static_cast<std::int32_t>(bottom[x] - top[x]);
}

template <int kTimes>
void subtract_sums(SumRow top, SumRow bottom, int width, ColumnRow columns) {
  for (int x = 0; x < width; ++x) {
    auto sum = static_cast<std::uint32_t>(columns[x]);
    for (int i = 0; i < kTimes; ++i) sum -= bottom[x] - top[x];
    columns[x] = static_cast<std::int32_t>(sum);
  }
}

// Vertical sums per column of the integral image, from which horizontal differences give the three
// derivatives. Unsigned sums that wrap around come out right as differences, so they are kept as bits.
void sum_columns(ImageView<const std::uint32_t> integral, BoxFilter filter, int y, SurfWorkspace& workspace) {
  const int lobe = filter.lobe;
  const int radius = filter.radius();
  const int width = integral.width;
  std::int32_t* xx = workspace.columns_xx.data();
  std::int32_t* yy = workspace.columns_yy.data();
  std::int32_t* xy = workspace.columns_xy.data();
  set_sums(integral.row(y - lobe + 1), integral.row(y + lobe), width, xx);
  set_sums(integral.row(y - radius), integral.row(y + radius + 1), width, yy);
  subtract_sums<3>(integral.row(y - lobe / 2), integral.row(y + lobe / 2 + 1), width, yy);
  set_sums(integral.row(y - lobe), integral.row(y), width, xy);
  subtract_sums<1>(integral.row(y + 1), integral.row(y + lobe + 1), width, xy);
}

// Grey values become 0…1, and filters of all sizes comparable.
float response_scale(BoxFilter filter) {
  return 1.0F / (255.0F * static_cast<float>(filter.size() * filter.size()));
}

std::int32_t minus(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}

// The responses of samples first … last. The step is known at compile time where speed matters.
template <int kStep>
void combine_columns(const SurfWorkspace& workspace, BoxFilter filter, int any_step, int first, int last,
                     float* responses) {
  const int step = kStep > 0 ? kStep : any_step;
  const int lobe = filter.lobe;
  const int radius = filter.radius();
  const std::int32_t* xx = workspace.columns_xx.data();
  const std::int32_t* yy = workspace.columns_yy.data();
  const std::int32_t* xy = workspace.columns_xy.data();
  const float scale = response_scale(filter);
  for (int i = first; i <= last; ++i) {
    const int x = i * step;
    const std::int32_t whole = minus(xx[x + radius + 1], xx[x - radius]);
    const std::int32_t middle = minus(xx[x + lobe / 2 + 1], xx[x - lobe / 2]);
    const float dxx = static_cast<float>(whole - 3 * middle) * scale;
    const float dyy = static_cast<float>(minus(yy[x + lobe], yy[x - lobe + 1])) * scale;
    const std::int32_t left = minus(xy[x], xy[x - lobe]);
    const std::int32_t right = minus(xy[x + lobe + 1], xy[x + 1]);
    const float dxy = static_cast<float>(left - right) * scale;
    responses[i] = BoxDerivatives{dxx, dyy, dxy}.response();
  }
}

}  // namespace

void compute_response_row(ImageView<const std::uint32_t> integral, BoxFilter filter, int y, int step,
                          SurfWorkspace& workspace, std::span<float> responses) {
  const int width = integral.width - 1;
  const int height = integral.height - 1;
  const int radius = filter.radius();
  const int samples = (width - 1) / step + 1;
  const int first = (radius + step - 1) / step;
  const int last = (width - 1 - radius) / step;
  if (y < radius || y + radius >= height || width <= 2 * radius || first > last) {
    std::fill_n(responses.data(), samples, 0.0F);
    return;
  }
  sum_columns(integral, filter, y, workspace);
  std::fill_n(responses.data(), first, 0.0F);
  if (step == 1) {
    combine_columns<1>(workspace, filter, step, first, last, responses.data());
  } else if (step == 2) {
    combine_columns<2>(workspace, filter, step, first, last, responses.data());
  } else {
    combine_columns<0>(workspace, filter, step, first, last, responses.data());
  }
  std::fill_n(responses.data() + last + 1, samples - 1 - last, 0.0F);
}

BoxDerivatives derivatives_at(ImageView<const std::uint32_t> integral, BoxFilter filter, int x, int y) {
  const int lobe = filter.lobe;
  const int half = lobe / 2;
  const int radius = filter.radius();
  const int band = 2 * lobe - 1;
  const auto sum = [&](int left, int top, int width, int height) {
    return static_cast<std::int32_t>(box_sum(integral, left, top, width, height));
  };
  const std::int32_t xx = sum(x - radius, y - lobe + 1, filter.size(), band) -  //
                          3 * sum(x - half, y - lobe + 1, lobe, band);
  const std::int32_t yy =
      sum(x - lobe + 1, y - radius, band, filter.size()) - 3 * sum(x - lobe + 1, y - half, band, lobe);
  const std::int32_t xy = sum(x - lobe, y - lobe, lobe, lobe) + sum(x + 1, y + 1, lobe, lobe) -
                          sum(x + 1, y - lobe, lobe, lobe) - sum(x - lobe, y + 1, lobe, lobe);
  const float scale = response_scale(filter);
  return {static_cast<float>(xx) * scale, static_cast<float>(yy) * scale, static_cast<float>(xy) * scale};
}

}  // namespace traygauge::paper
