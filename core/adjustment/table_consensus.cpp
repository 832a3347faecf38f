#include "core/adjustment/table_consensus.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "core/geometry/levenberg_marquardt.hpp"

namespace traygauge {
namespace {

// Height at the card's middle (mm), slopes along x and y.
using TableCorrection = Vec3;

// Between the directions of two points from the card, 12 degrees: nearly one line is no plane.
constexpr double kMinSine = 0.2;

Vec3 functional(const TableSighting& sighting) {
  return {1.0, sighting.x_mm, sighting.y_mm};
}

double squared_deviation(const TableSighting& sighting, const TableCorrection& table) {
  const double deviation = (sighting.height_mm - functional(sighting).dot(table)) / sighting.sigma_mm;
  return deviation * deviation;
}

double score(std::span<const TableSighting> sightings, const Mat3& information, const TableCorrection& table,
             const TableConsensusParams& params) {
  const double squared_limit = params.inlier_sigmas * params.inlier_sigmas;
  const double squared_reach = params.reach_mm * params.reach_mm;
  double sum = table.dot(information * table);
  for (const TableSighting& sighting : sightings) {
    const double squared_distance = sighting.x_mm * sighting.x_mm + sighting.y_mm * sighting.y_mm;
    const double weight = squared_reach / (squared_reach + squared_distance);
    sum += weight * std::min(squared_deviation(sighting, table), squared_limit);
  }
  return sum;
}

// The plane of no height at the card's middle through both points.
bool span_plane(const TableSighting& one, const TableSighting& other, TableCorrection& table) {
  const double cross = one.x_mm * other.y_mm - one.y_mm * other.x_mm;
  const double lengths = std::hypot(one.x_mm, one.y_mm) * std::hypot(other.x_mm, other.y_mm);
  if (!(std::abs(cross) > kMinSine * lengths)) return false;
  table = {0.0, (one.height_mm * other.y_mm - other.height_mm * one.y_mm) / cross,
           (one.x_mm * other.height_mm - other.x_mm * one.height_mm) / cross};
  return true;
}

// Least squares over the points within the limit, with the prior.
TableCorrection refit(std::span<const TableSighting> sightings, const Mat3& information,
                      const TableCorrection& table, double squared_limit) {
  NormalEquations<3> equations;
  equations.hessian = information;
  equations.gradient = information * table;
  for (const TableSighting& sighting : sightings) {
    if (squared_deviation(sighting, table) > squared_limit) continue;
    const double weight = 1.0 / (sighting.sigma_mm * sighting.sigma_mm);
    const Vec3 jacobian = functional(sighting);
    equations.add(jacobian.dot(table) - sighting.height_mm, jacobian, weight);
  }
  Vec3 step = Vec3::Zero();
  return equations.solve(0.0, step) ? TableCorrection(table + step) : table;
}

bool flag_table(std::span<TableSighting> sightings, const TableCorrection& table,
                const TableConsensusParams& params) {
  const double squared_limit = params.inlier_sigmas * params.inlier_sigmas;
  int on_table = 0;
  int beside = 0;
  for (TableSighting& sighting : sightings) {
    const double square = squared_deviation(sighting, table);
    sighting.is_table = square <= squared_limit;
    on_table += sighting.is_table ? 1 : 0;
    beside += !sighting.is_table && square <= 4.0 * squared_limit ? 1 : 0;
  }
  const bool stands_out = on_table >= params.min_points && beside <= params.max_side_fraction * on_table;
  if (!stands_out) {
    for (TableSighting& sighting : sightings) sighting.is_table = false;
  }
  return stands_out;
}

}  // namespace

bool find_table(std::span<TableSighting> sightings, const Mat3& prior, const TableConsensusParams& params) {
  const Mat3 information = prior.inverse();
  const double squared_limit = params.inlier_sigmas * params.inlier_sigmas;
  TableCorrection best = TableCorrection::Zero();
  double best_score = score(sightings, information, best, params);
  Random random(kFixedSeed);
  const auto count = static_cast<std::uint32_t>(sightings.size());
  for (int sample = 0; count >= 2 && sample < params.samples; ++sample) {
    TableCorrection table;
    const TableSighting& one = sightings[random.below(count)];
    if (!span_plane(one, sightings[random.below(count)], table)) continue;
    if (!(table.dot(information * table) <= params.max_squared_deviation)) continue;
    const double sum = score(sightings, information, table, params);
    if (!(sum < best_score)) continue;
    best = table;
    best_score = sum;
  }
  for (int round = 0; round < kSettlingRounds; ++round) {
    const TableCorrection table = refit(sightings, information, best, squared_limit);
    if (!(table.dot(information * table) <= params.max_squared_deviation)) break;
    best = table;
  }
  return flag_table(sightings, best, params);
}

}  // namespace traygauge
