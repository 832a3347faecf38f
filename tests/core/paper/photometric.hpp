// Compares rectified pictures at true correspondences, also one row too high and too low.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "core/paper/rectification/polar_rectification.hpp"
#include "tests/core/paper/rectification_fixture.hpp"

namespace traygauge::paper {

struct RowAgreement {
  std::array<double, 3> difference{};  // mean |grey difference| one row above, at the row, one below
  int pixels = 0;
  double worst_row_px = 0.0;  // between the row and where the true partner falls
  double min_disparity_px = 1e9;
  double max_disparity_px = -1e9;

  // Least squared difference by a parabola through the three.
  double offset_px() const {
    const auto [above, at, below] = difference;
    return 0.5 * (above - below) / (above - 2.0 * at + below);
  }
};

// Between two columns of a row.
inline double grey_at(const Picture& picture, double column, int row) {
  const int left = static_cast<int>(std::floor(column));
  const double share = column - left;
  return (1.0 - share) * picture.view().at(left, row) + share * picture.view().at(left + 1, row);
}

// `partner`: pixel of the first working picture → true pixel in the second, where there is one.
template <class Partner>
RowAgreement compare_rows(const PolarRectification& rectification, const Picture& first,
                          const Picture& second, const Partner& partner) {
  RowAgreement agreement;
  for (int row = 1; row + 1 < rectification.rows(); ++row) {
    for (int column = 0; column < rectification.columns(0); ++column) {
      Vec2 there;
      const std::optional<Vec2> pixel = partner(rectification.pixel_in_row(0, column, row));
      if (!pixel || !rectification.rectified(1, *pixel, there)) continue;
      if (there.x() >= rectification.columns(1) - 1) continue;
      agreement.worst_row_px = std::max(agreement.worst_row_px, std::abs(there.y() - row));
      agreement.min_disparity_px = std::min(agreement.min_disparity_px, there.x() - column);
      agreement.max_disparity_px = std::max(agreement.max_disparity_px, there.x() - column);
      for (int shift = -1; shift <= 1; ++shift) {
        const double difference = first.view().at(column, row) - grey_at(second, there.x(), row + shift);
        agreement.difference[static_cast<std::size_t>(shift + 1)] += std::abs(difference);
      }
      ++agreement.pixels;
    }
  }
  for (double& sum : agreement.difference) sum /= agreement.pixels;
  return agreement;
}

// Both rectified pictures.
inline std::array<Picture, 2> rectify_both(const PolarRectification& rectification,
                                           ImageView<const std::uint8_t> first,
                                           ImageView<const std::uint8_t> second) {
  std::array pictures = {Picture(rectification.columns(0), rectification.rows()),
                         Picture(rectification.columns(1), rectification.rows())};
  rectification.rectify(0, first, pictures[0].view());
  rectification.rectify(1, second, pictures[1].view());
  return pictures;
}

}  // namespace traygauge::paper
