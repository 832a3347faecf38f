// How well a point can be recognised in both directions: the smaller eigenvalue of the gradients' structure
// tensor (Shi and Tomasi 1994), row by row.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"

namespace traygauge {

inline constexpr int kCornerWindowRadius = 2;  // of the 5 × 5 window that the tensor is averaged over
inline constexpr int kCornerBorder = kCornerWindowRadius + 1;  // pixels along the edges without a response

// Sums of products of the gradients (Sobel's, unscaled) down the window's five rows.
struct CornerResponseWorkspace {
  static constexpr std::size_t kWindowRows = 2 * kCornerWindowRadius + 1;
  struct Products {
    std::span<std::int32_t> xx;
    std::span<std::int32_t> xy;
    std::span<std::int32_t> yy;
  };
  std::array<Products, kWindowRows> rows;
  Products columns;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_width) {
    for (Products& row : rows) allocate(arena, max_width, row);
    allocate(arena, max_width, columns);
  }

 private:
  template <class Allocator>
  static constexpr void allocate(Allocator& arena, int max_width, Products& products) {
    for (std::span<std::int32_t>* sums : {&products.xx, &products.xy, &products.yy}) {
      *sums = arena.template take<std::int32_t>(static_cast<std::size_t>(max_width));
    }
  }
};

// Walks down a picture that is larger than the border on every side.
class CornerResponse {
 public:
  CornerResponse(ImageView<const std::uint8_t> gray, CornerResponseWorkspace& workspace);

  static constexpr int first_row() { return kCornerBorder; }
  int end_row() const { return gray_.height - kCornerBorder; }

  // The responses of the next row, first first_row(): squared grey values per pixel, 0 along the edges.
  void next_row(std::span<float> responses);

 private:
  void add_gradient_row(int y);

  ImageView<const std::uint8_t> gray_;
  CornerResponseWorkspace& workspace_;
  int next_gradient_row_ = 1;
};

}  // namespace traygauge
