// An item's sides in one row of a plane rectification, where lines of sight pass it, and how high the middle
// between them lies. A row of either view lies in the same plane through both cameras.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/labels/label_set.hpp"

namespace traygauge {

// Samples from the item's first to its last one in a row or column.
struct OutlineChord {
  int first = 0;
  int end = 0;

  constexpr bool empty() const { return end <= first; }
  constexpr int count() const { return end - first; }
};

// Whether neither another item nor the grid's border hides an end. `labels` are of the whole row.
inline bool is_free(const std::uint8_t* labels, int width, const OutlineChord& chord) {
  return chord.first > 0 && chord.end < width && !is_item(labels[chord.first - 1]) &&
         !is_item(labels[chord.end]);
}

// How one view sees an item in a row.
struct ChordSight {
  double foot_mm = 0.0;     // of the camera, along the row
  double camera_mm = 0.0;   // its height over the level
  double middle_run = 0.0;  // of the middle between the sides: along the row, for every mm that it falls
  double half_mm = 0.0;     // of the chord, on the level
};

// Height over the level of the centre of a conic section: the line of sight to it runs (m₁ + m₂)/2 · (1 −
// b²/H²) along the row, with m the runs of the two tangents, H the camera's height over the centre and b half
// of the section's height, here the smaller of the centre's height and half a chord. A step of a fixed point
// from `centre_mm`. Nothing where the views see its middle from one side.
inline std::optional<double> centre_between_sides_mm(const std::array<ChordSight, 2>& sights,
                                                     double centre_mm) {
  std::array<double, 2> run{};
  std::array<double, 2> at_mm{};  // where the line to the centre meets the level
  for (std::size_t v = 0; v < 2; ++v) {
    const ChordSight& sight = sights[v];
    const double share = std::min(centre_mm, sight.half_mm) / (sight.camera_mm - centre_mm);
    run[v] = (1.0 - share * share) * sight.middle_run;
    at_mm[v] = sight.foot_mm + sight.camera_mm * run[v];
  }
  if (!(std::abs(run[1] - run[0]) > 1e-6)) return std::nullopt;
  return (at_mm[1] - at_mm[0]) / (run[1] - run[0]);
}

inline constexpr int kCentreSteps = 3;  // of that fixed point: the correction is a few per cent

}  // namespace traygauge
