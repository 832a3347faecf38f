// The outline of one item in both views, row by row of a plane rectification: there a row of either grid lies
// in the same plane through both cameras.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/stereo/outline_chord.hpp"
#include "core/stereo/surface_grid.hpp"

namespace traygauge {

struct OutlineRow {
  std::array<OutlineChord, 2> chords;  // by view
  // Of the middle between a view's chord ends: how far its line of sight runs along the row for every mm that
  // it falls.
  std::array<double, 2> middle_run{};
  Vec2 direction = Vec2::Zero();  // along the columns, table frame
  double length_mm = 0.0;         // of the shorter chord, on the level
  // The longer the chords and the more squarely outlines cross the row, the better is known where the middle
  // is. 0 where another item hides an end in either view.
  double weight = 0.0;
};

struct OutlineRows {
  std::span<const OutlineRow> rows;  // of the grids
  int shared = 0;                    // rows that both views see the item in
  double steepest_run = 0.0;         // of the lines of sight to its ends in usable rows
  int usable = 0;                    // of these, those with a weight
};

// How far the line of sight through a sample runs over the table for every mm that it falls.
Vec2 run_at(const SurfaceGrid& view, int x, int y);

// Where it meets the level.
Vec2 foot_on_level(const SurfaceGrid& view, const Vec2& run, double level_mm);

// Pieces that a label is in, less the holes in them (the Euler number; samples side by side belong together).
int count_pieces(ImageView<const std::uint8_t> labels, std::uint8_t label);

// `rows` has one entry for each row of the grids.
OutlineRows collect_outline_rows(const std::array<SurfaceGrid, 2>& views, std::uint8_t label, double level_mm,
                                 std::span<OutlineRow> rows);

// Height over the level of the centre of a body whose sections with the rows' planes are central conics, by
// all of its rows (centre_between_sides_mm). 0 without usable rows.
double centre_height_mm(const OutlineRows& outline, const std::array<SurfaceGrid, 2>& views, double level_mm);

}  // namespace traygauge
