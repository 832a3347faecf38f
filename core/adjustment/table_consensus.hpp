// Which of the points around the dishes lie on the table: those on the plane through the card's level on
// which most agree, weighed against how well the card says where the table is. Napkins, cutlery, a tray's rim
// and the furniture beside the tray lie on other levels, and may be the majority.
#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/geometry.hpp"

namespace traygauge {

// A point near the table: its place from the card's middle, its height over the table as known so far.
struct TableSighting {
  double x_mm = 0.0;
  double y_mm = 0.0;
  double height_mm = 0.0;
  double sigma_mm = 1.0;
  std::uint32_t track = 0;
  bool is_table = false;
};

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.01 points at most
// (tests/evaluation/numbers.tsv).
struct TableConsensusParams {
  // Pairs of points tried: a fifth of them on the table is found with 99 %, 1 − (1 − 0.2²)^120.
  int samples = 120;
  double inlier_sigmas = 2.5;
  // Squared deviation from the card's level in its standard deviations, three degrees of freedom: one card in
  // 300 lies worse. No number of points outvotes it.
  double max_squared_deviation = 14.0;
  // A point counts for 1 / (1 + (distance / this)²): the card's level is carried outwards, or else a large
  // table under the tray takes the plane away with a slope that the card alone would still allow.
  double reach_mm = 150.0;
  // The table stands out: so many points within the limit, and of those as far off again at most this share
  // of them. A tray's rim or a cloth passes through any level, with as many points beside it as on it.
  int min_points = 16;
  double max_side_fraction = 0.5;
};

// MSAC over planes through the card's middle and two of the points, none further from nought than its
// covariance `prior` (positive definite) allows, refitted by least squares: height at the card's middle (mm),
// slopes along x and y. Flags the points on the table; false, and none, when no plane stands out.
bool find_table(std::span<TableSighting> sightings, const Mat3& prior, const TableConsensusParams& params);

}  // namespace traygauge
