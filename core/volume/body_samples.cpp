#include "core/volume/body_samples.hpp"

namespace traygauge {

BodyPicture::BodyPicture(const SurfaceGrid& view, std::size_t index, const OutlineRows& outline,
                         std::uint8_t label, double level_mm, std::span<OutlineChord> columns)
    : view_(view), index_(index), outline_(outline), label_(label), columns_(columns) {
  int longest = 0;
  for (int y = 0; y < view.labels.height; ++y) {
    const OutlineChord& own = outline.rows[static_cast<std::size_t>(y)].chords[index];
    if (own.count() > outline.rows[static_cast<std::size_t>(longest)].chords[index].count()) longest = y;
  }
  const OutlineChord& chord = outline.rows[static_cast<std::size_t>(longest)].chords[index];
  const auto foot = [&](int x, int y) { return foot_on_level(view, run_at(view, x, y), level_mm); };
  if (chord.count() > 1)
    along_mm_ = (foot(chord.end - 1, longest) - foot(chord.first, longest)) / (chord.count() - 1);
  int middle = (chord.first + chord.end) / 2;
  while (middle + 1 < chord.end && view.labels.at(middle, longest) != label) ++middle;
  OutlineChord column{longest, longest + 1};
  while (column.first > 0 && view.labels.at(middle, column.first - 1) == label) --column.first;
  while (column.end < view.labels.height && view.labels.at(middle, column.end) == label) ++column.end;
  if (column.count() > 1)
    across_mm_ = (foot(middle, column.end - 1) - foot(middle, column.first)) / (column.count() - 1);
}

}  // namespace traygauge
