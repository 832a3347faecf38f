// Subpixel disparities on a surface that is known already. The other picture is resampled on it, so that
// windows cover the same patch of it in both, whatever its slant; what is left is solved by least squares
// over the window (Lucas & Kanade 1981, along the row) with the local difference in brightness eliminated,
// and tied together by a membrane where the picture is plain. That takes out the pull to whole pixels and the
// fronto-parallel bias of window costs.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge {

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.05 points at most
// (tests/evaluation/numbers.tsv).
struct SubpixelRefinementParams {
  int iterations = 3;        // each resamples the picture anew
  double max_step_px = 1.0;  // of an iteration: the linearisation reaches about a pixel
  // grey², against the mean squared gradient of a window: some times the noise of 2 to 4 grey levels.
  double stiffness = 16.0;
  int smoothings = 2;           // of the membrane before an iteration
  double smoothing_hold = 0.5;  // of a sample's own disparity, against each neighbour's, while smoothing
  int relaxations = 4;          // of the membrane, per iteration
  bool refines_dish = false;  // else the dish's samples have no weight in windows: food is not mixed with it
  double border_tie = 0.1;    // between samples of different labels
};

inline constexpr int kRefinementRadius = 2;  // of the windows

struct SubpixelRefinementWorkspace {
  static constexpr int kChannels = 5;  // count, residual, gradient, gradient², gradient · residual
  std::span<float> certainty;          // gradient energy, of every sample
  std::span<float> target;             // disparity that the window asks for, times certainty
  std::span<float> right_tie;
  std::span<float> lower_tie;
  std::span<float> terms;    // kChannels of 2 kRefinementRadius + 1 rows
  std::span<float> sums;     // kChannels of one row, with kRefinementRadius beyond its ends
  std::span<float> windows;  // kChannels of one row
  std::span<float> row;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_columns, int max_samples) {
    const auto samples = static_cast<std::size_t>(max_samples);
    const auto columns = static_cast<std::size_t>(max_columns) + std::size_t{2} * kRefinementRadius;
    certainty = arena.template take<float>(samples);
    target = arena.template take<float>(samples);
    right_tie = arena.template take<float>(samples);
    lower_tie = arena.template take<float>(samples);
    terms = arena.template take<float>(columns * kChannels * (2 * kRefinementRadius + 1));
    sums = arena.template take<float>(columns * kChannels);
    windows = arena.template take<float>(columns * kChannels);
    row = arena.template take<float>(columns);
  }
};

// The picture whose samples have disparities, and the other one.
struct RefinementPair {
  ImageView<const std::uint8_t> gray;
  ImageView<const std::uint8_t> labels;
  ImageView<const std::uint8_t> other_gray;
  ImageView<const std::uint8_t> other_labels;
  int sign = 1;  // a partner lies at column + sign · disparity
};

// Refines `disparity` (columns), known wherever there is a label. `trusted` is 0 where a sample has no
// partner: it follows its neighbours.
void refine_surface(const RefinementPair& pair, ImageView<const std::uint8_t> trusted,
                    const SubpixelRefinementParams& params, SubpixelRefinementWorkspace& workspace,
                    ImageView<float> disparity);

}  // namespace traygauge
