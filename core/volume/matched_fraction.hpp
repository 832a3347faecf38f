// How much of each label was matched rather than filled from its neighbours.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/stereo/surface_grid.hpp"

namespace traygauge {

// Of the samples of every label in all views; 1 for labels without any.
inline std::array<double, 256> matched_fractions(std::span<const SurfaceGrid> views) {
  std::array<double, 256> samples{};
  std::array<double, 256> matched{};
  for (const SurfaceGrid& view : views) {
    for (int y = 0; y < view.labels.height; ++y) {
      const std::uint8_t* labels = view.labels.row(y);
      const SurfaceEvidence* evidence = view.evidence.row(y);
      for (int x = 0; x < view.labels.width; ++x) {
        samples[labels[x]] += 1.0;
        const bool is_matched =
            evidence[x] == SurfaceEvidence::single || evidence[x] == SurfaceEvidence::both;
        matched[labels[x]] += is_matched ? 1.0 : 0.0;
      }
    }
  }
  for (std::size_t i = 0; i < samples.size(); ++i)
    matched[i] = samples[i] > 0.0 ? matched[i] / samples[i] : 1.0;
  return matched;
}

}  // namespace traygauge
