// Heights of a bare dish by inset from its outer edge: medians over the azimuth of what both views matched.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/dish/dish_profile.hpp"
#include "core/image_view/image_view.hpp"
#include "core/stereo/surface_grid.hpp"

namespace traygauge {

struct InsetHeightParams {
  double ring_mm = 1.0;  // width of a ring: about a sample of the grid
  // grey² that halve a sample's weight: the mean product of both pictures' gradients along the row where
  // they were matched, less what unrelated noise reaches. Plain glaze is drawn from its surroundings and has
  // next to none.
  double half_weight_gradient = 1.0;
  int burnt_level = 250;  // grey value from which a sample may be a highlight, which moves with the eye
  // Mean weight of a ring's samples, unmatched ones having none, and their sum: less tells nothing.
  double min_weight = 0.2;
  double min_samples = 20.0;
  int item_margin = 5;  // samples so near to something on the dish were matched with it
};

// One view of the dish, both pictures at its samples, and where their partners are: column + sign ·
// disparity.
struct InsetView {
  SurfaceGrid surface;
  ImageView<const std::uint8_t> gray;
  ImageView<const std::uint8_t> other_gray;
  ImageView<const float> disparity;
  int sign = 1;
};

struct InsetRing {
  double inset_mm = 0.0;   // of its middle
  double height_mm = 0.0;  // weighted median, above the table
  double spread_mm = 0.0;  // standard deviation of the samples, from their quartiles
  double samples = 0.0;    // sum of their weights
  double sigma_mm = 0.0;   // of the height, as far as the spread tells
  bool is_known = false;
};

inline constexpr std::size_t kMaxInsetRings = 512;

struct InsetHeightWorkspace {
  struct Sample {
    float height_mm = 0.0F;
    float weight = 0.0F;
  };
  std::span<Sample> samples;
  std::span<std::uint32_t> ends;  // of the rings' samples; with one before the first
  std::span<InsetRing> rings;

  // `max_samples`: of one view's grid.
  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t max_samples) {
    samples = arena.template take<Sample>(2 * max_samples);
    ends = arena.template take<std::uint32_t>(kMaxInsetRings + 1);
    rings = arena.template take<InsetRing>(kMaxInsetRings);
  }
};

// Rings from the edge inward, in the workspace's memory. Only samples with the label of the dish itself count
// that both views matched the same way. `edge` is the dish's outer edge; its heights are not read.
// invalid_configuration when the dish has more rings or samples than the workspace.
Status collect_inset_heights(const std::array<InsetView, 2>& views, const InnerSurface& edge,
                             const InsetHeightParams& params, InsetHeightWorkspace& workspace,
                             std::span<const InsetRing>& rings);

}  // namespace traygauge
