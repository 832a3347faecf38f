// How honest and how sharp the stated standard deviations are.
#pragma once

#include <array>
#include <vector>

#include "firmware/evaluate/accuracy.hpp"

namespace traygauge {

// Over all estimates. Shares in per cent; NaN where not defined.
struct SigmaFigures {
  bool is_estimated = false;  // at least one estimate states a sigma; else nothing below holds
  int estimates = 0;
  int without_sigma = 0;         // of those; they count as not covered
  double coverage = kUndefined;  // truth within two sigma; 95.4 for a normal distribution
  std::array<double, 3> coverage_by_thirds{kUndefined, kUndefined, kUndefined};  // small, middle, large sigma
  // The same with sigma as a share of the volume.
  std::array<double, 3> coverage_by_relative_thirds{kUndefined, kUndefined, kUndefined};
  double median_relative_sigma = kUndefined;      // sharpness: of sigma / volume
  double rank_correlation = kUndefined;           // Spearman: sigma, absolute error
  double relative_rank_correlation = kUndefined;  // sigma / volume, relative error
};
SigmaFigures sigma_figures(const std::vector<ItemSeries>& items);

// The truth lies within two sigma of an estimate that states one.
bool is_covered(const Attempt& attempt, double truth_ml);

}  // namespace traygauge
