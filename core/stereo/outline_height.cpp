#include "core/stereo/outline_height.hpp"

#include <algorithm>
#include <cstddef>

#include "core/base/units.hpp"
#include "core/labels/label_set.hpp"
#include "core/stereo/outline_chord.hpp"

namespace traygauge {
namespace {

using RowChords = std::array<OutlineChord, kByteValues>;  // by label

RowChords chords_of(const std::uint8_t* labels, int width) {
  RowChords chords;
  for (int x = 0; x < width; ++x) {
    if (!is_item(labels[x])) continue;
    OutlineChord& chord = chords[labels[x]];
    if (chord.empty()) chord.first = x;
    chord.end = x + 1;
  }
  return chords;
}

// Over the plane.
double middle_height_mm(const PlaneRectification& grid, int y, const std::array<OutlineChord, 2>& chords) {
  const double step_mm = grid.column_step_mm();
  std::array<ChordSight, 2> sights;
  for (std::size_t v = 0; v < 2; ++v) {
    const double foot_mm = grid.row(y).foot_mm[v];
    const double camera_mm = grid.camera_height_mm(static_cast<int>(v));
    const double middle_mm = 0.5 * (chords[v].first + chords[v].end - 1) * step_mm;
    sights[v] = {foot_mm, camera_mm, (middle_mm - foot_mm) / camera_mm, 0.5 * chords[v].count() * step_mm};
  }
  double height_mm = 0.0;
  for (int i = 0; i < kCentreSteps; ++i)
    height_mm = std::max(centre_between_sides_mm(sights, height_mm).value_or(0.0), 0.0);
  return height_mm;
}

}  // namespace

double height_by_outlines_mm(const PlaneRectification& grid,
                             const std::array<ImageView<const std::uint8_t>, 2>& labels) {
  std::array<double, kByteValues> weights{};
  std::array<double, kByteValues> sums_mm{};
  for (int y = 0; y < labels[0].height; ++y) {
    const std::array<RowChords, 2> chords = {chords_of(labels[0].row(y), labels[0].width),
                                             chords_of(labels[1].row(y), labels[1].width)};
    const auto is_seen_from_both = [&](std::size_t label) {
      return !chords[0][label].empty() && !chords[1][label].empty() &&
             is_free(labels[0].row(y), labels[0].width, chords[0][label]) &&
             is_free(labels[1].row(y), labels[1].width, chords[1][label]);
    };
    for (std::size_t label = 0; label < kByteValues; ++label) {
      if (!is_seen_from_both(label)) continue;
      const double weight = chords[0][label].count();
      weights[label] += weight;
      sums_mm[label] += weight * middle_height_mm(grid, y, {chords[0][label], chords[1][label]});
    }
  }
  double highest_mm = 0.0;
  for (std::size_t label = 0; label < kByteValues; ++label) {
    if (weights[label] > 0.0) highest_mm = std::max(highest_mm, 2.0 * sums_mm[label] / weights[label]);
  }
  return highest_mm;
}

}  // namespace traygauge
