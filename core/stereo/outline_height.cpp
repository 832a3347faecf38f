#include "core/stereo/outline_height.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/units.hpp"
#include "core/labels/label_set.hpp"

namespace traygauge {
namespace {

// An item's samples in a row of one view, from the first to the last.
struct Chord {
  int first = 0;
  int end = 0;
  bool is_free = true;  // no other item hides a side

  double middle() const { return 0.5 * (first + end - 1); }
  double half() const { return 0.5 * (end - first); }
};

using RowChords = std::array<Chord, kByteValues>;  // by label

RowChords chords_of(const std::uint8_t* labels, int width) {
  RowChords chords{};
  const auto is_item_at = [&](int x) { return x >= 0 && x < width && is_item(labels[x]); };
  for (int x = 0; x < width; ++x) {
    if (!is_item(labels[x])) continue;
    Chord& chord = chords[labels[x]];
    if (chord.end == 0) {
      chord.first = x;
      chord.is_free = x > 0 && !is_item_at(x - 1);
    }
    chord.end = x + 1;
  }
  for (Chord& chord : chords) chord.is_free = chord.is_free && chord.end < width && !is_item_at(chord.end);
  return chords;
}

// Over the plane, of the middle between the sides that a row shows. The line of sight to an ellipse's centre
// runs (m₁ + m₂)/2 · (1 − b²/H²) along the row, with m the runs of the two tangents, H the camera's height
// over the centre and b half of the ellipse's height, here the smaller of its centre's height and half a
// chord.
double middle_height_mm(const PlaneRectification& grid, int y, const std::array<Chord, 2>& chords) {
  constexpr int kSteps = 3;  // of the fixed point: the correction is a few per cent
  const double step_mm = grid.column_step_mm();
  double height_mm = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    std::array<double, 2> run{};
    std::array<double, 2> at_mm{};  // where that line meets the plane
    for (std::size_t v = 0; v < 2; ++v) {
      const double foot_mm = grid.row(y).foot_mm[v];
      const double camera_mm = grid.camera_height_mm(static_cast<int>(v));
      const double share = std::min(height_mm, chords[v].half() * step_mm) / (camera_mm - height_mm);
      run[v] = (1.0 - share * share) * (chords[v].middle() * step_mm - foot_mm) / camera_mm;
      at_mm[v] = foot_mm + camera_mm * run[v];
    }
    // Views side by side along the row see its middle from different sides.
    if (!(std::abs(run[1] - run[0]) > 1e-6)) return 0.0;
    height_mm = std::max((at_mm[1] - at_mm[0]) / (run[1] - run[0]), 0.0);
  }
  return height_mm;
}

}  // namespace

double height_by_outlines_mm(const PlaneRectification& grid,
                             const std::array<ImageView<const std::uint8_t>, 2>& labels) {
  std::array<double, kByteValues> weights{};
  std::array<double, kByteValues> sums_mm{};
  for (int y = 0; y < labels[0].height; ++y) {
    const RowChords first = chords_of(labels[0].row(y), labels[0].width);
    const RowChords second = chords_of(labels[1].row(y), labels[1].width);
    for (std::size_t label = 0; label < kByteValues; ++label) {
      if (first[label].end == 0 || second[label].end == 0) continue;
      if (!first[label].is_free || !second[label].is_free) continue;
      const double weight = first[label].end - first[label].first;
      weights[label] += weight;
      sums_mm[label] += weight * middle_height_mm(grid, y, {first[label], second[label]});
    }
  }
  double highest_mm = 0.0;
  for (std::size_t label = 0; label < kByteValues; ++label) {
    if (weights[label] > 0.0) highest_mm = std::max(highest_mm, 2.0 * sums_mm[label] / weights[label]);
  }
  return highest_mm;
}

}  // namespace traygauge
