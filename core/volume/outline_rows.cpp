#include "core/volume/outline_rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

constexpr int kSlantRows = 2;  // to either side, over which an outline's slant is taken

OutlineChord chord_of(const std::uint8_t* labels, int width, std::uint8_t label) {
  OutlineChord chord;
  for (int x = 0; x < width; ++x) {
    if (labels[x] != label) continue;
    if (chord.empty()) chord.first = x;
    chord.end = x + 1;
  }
  return chord;
}

// Sum of squares over the four ends: columns by which an outline moves from row to row.
double squared_slant(const OutlineRow& above, const OutlineRow& below) {
  double sum = 0.0;
  for (std::size_t v = 0; v < 2; ++v) {
    const double first = below.chords[v].first - above.chords[v].first;
    const double end = below.chords[v].end - above.chords[v].end;
    sum += first * first + end * end;
  }
  constexpr double kApart = 2.0 * kSlantRows;
  return sum / (kApart * kApart);
}

// Returns the steepest run to a chord's ends.
double place_middle(const std::array<SurfaceGrid, 2>& views, int y, double level_mm, OutlineRow& row) {
  double steepest = 0.0;
  for (std::size_t v = 0; v < 2; ++v) {
    const OutlineChord& chord = row.chords[v];
    const Vec2 left = run_at(views[v], chord.first, y);
    const Vec2 right = run_at(views[v], chord.end - 1, y);
    const Vec2 along = foot_on_level(views[v], right, level_mm) - foot_on_level(views[v], left, level_mm);
    const double inner_mm = along.norm();  // between the outermost samples' centres
    if (v == 0) row.direction = along / inner_mm;
    const double length_mm = inner_mm * chord.count() / (chord.count() - 1);
    row.length_mm = v == 0 ? length_mm : std::min(row.length_mm, length_mm);
    row.middle_run[v] = 0.5 * row.direction.dot(left + right);
    steepest = std::max({steepest, left.norm(), right.norm()});
  }
  return steepest;
}

}  // namespace

Vec2 run_at(const SurfaceGrid& view, int x, int y) {
  const SurfacePoint& point = view.points.at(x, y);
  const Vec3 sight = Vec3(point.x_mm, point.y_mm, point.z_mm) - view.camera_mm;
  return sight.head<2>() / -sight.z();
}

Vec2 foot_on_level(const SurfaceGrid& view, const Vec2& run, double level_mm) {
  return view.camera_mm.head<2>() + (view.camera_mm.z() - level_mm) * run;
}

int count_pieces(ImageView<const std::uint8_t> labels, std::uint8_t label) {
  // Every run of a row is a new piece, every overlap with a run above ties two together.
  int pieces = 0;
  for (int y = 0; y < labels.height; ++y) {
    const std::uint8_t* row = labels.row(y);
    const std::uint8_t* above = y > 0 ? labels.row(y - 1) : nullptr;
    bool in_run = false;
    bool in_overlap = false;
    for (int x = 0; x < labels.width; ++x) {
      const bool here = row[x] == label;
      const bool overlaps = here && above != nullptr && above[x] == label;
      pieces += (here && !in_run ? 1 : 0) - (overlaps && !in_overlap ? 1 : 0);
      in_run = here;
      in_overlap = overlaps;
    }
  }
  return pieces;
}

OutlineRows collect_outline_rows(const std::array<SurfaceGrid, 2>& views, std::uint8_t label, double level_mm,
                                 std::span<OutlineRow> rows) {
  const int height = views[0].labels.height;
  OutlineRows outline;
  outline.rows = rows.first(static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    OutlineRow& row = rows[static_cast<std::size_t>(y)];
    row = {};
    for (std::size_t v = 0; v < 2; ++v) {
      row.chords[v] = chord_of(views[v].labels.row(y), views[v].labels.width, label);
    }
    outline.shared += !row.chords[0].empty() && !row.chords[1].empty() ? 1 : 0;
  }
  for (int y = kSlantRows; y + kSlantRows < height; ++y) {
    OutlineRow& row = rows[static_cast<std::size_t>(y)];
    const OutlineRow& above = rows[static_cast<std::size_t>(y) - kSlantRows];
    const OutlineRow& below = rows[static_cast<std::size_t>(y) + kSlantRows];
    bool usable = true;
    for (std::size_t v = 0; v < 2; ++v) {
      usable = usable && row.chords[v].count() > 1 && !above.chords[v].empty() && !below.chords[v].empty() &&
               is_free(views[v].labels.row(y), views[v].labels.width, row.chords[v]);
    }
    if (!usable) continue;
    outline.steepest_run = std::max(outline.steepest_run, place_middle(views, y, level_mm, row));
    row.weight = row.length_mm / (1.0 + squared_slant(above, below));
    ++outline.usable;
  }
  return outline;
}

double centre_height_mm(const OutlineRows& outline, const std::array<SurfaceGrid, 2>& views,
                        double level_mm) {
  double centre_mm = 0.0;
  for (int step = 0; step < kCentreSteps; ++step) {
    double sum = 0.0;
    double weight = 0.0;
    for (const OutlineRow& row : outline.rows) {
      if (!(row.weight > 0.0)) continue;
      std::array<ChordSight, 2> sights;
      for (std::size_t v = 0; v < 2; ++v)
        sights[v] = {row.direction.dot(views[v].camera_mm.head<2>()), views[v].camera_mm.z() - level_mm,
                     row.middle_run[v], 0.5 * row.length_mm};
      const std::optional<double> height_mm = centre_between_sides_mm(sights, centre_mm);
      if (!height_mm) continue;
      sum += row.weight * *height_mm;
      weight += row.weight;
    }
    if (!(weight > 0.0)) return 0.0;
    centre_mm = std::max(sum / weight, 0.0);
  }
  return centre_mm;
}

}  // namespace traygauge
