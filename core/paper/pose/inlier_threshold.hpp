// How far from a model a match may lie and still count as its inlier (paper III-A-2, "Adaptive threshold
// estimation").
#pragma once

#include <cstdint>
#include <span>

namespace traygauge::paper {

enum class InlierThreshold : std::uint8_t {
  fixed,            // one distance for all pairs
  a_contrario,      // Moisan, Moulon, Monasse [30]
  false_discovery,  // the paper's: bound on the share of random matches among the inliers
};

// The largest data distance T, not above `max_threshold_px`, at which random matches can make up less than
// `max_noise_fraction` of the inliers: Cdf_noise(T) / Cdf_data(T) < p. Negative when there is none. Both
// spans hold distances to the model in any order, and come back rearranged. Cdf_noise is taken as (k + 1) /
// (m + 1) for k of m random matches: at the start of the curve, where none lies below T, the plain quotient
// would be zero and would trust any handful of data.
double false_discovery_threshold_px(std::span<double> data_px, std::span<double> noise_px,
                                    double max_noise_fraction, double max_threshold_px);

struct AContrarioModel {
  int sample_size = 5;  // matches that define a model
  int outcomes = 10;    // most models that one sample yields
  // Probability per pixel that a random point lies so near a given line: 2D / A for a picture of diagonal D
  // and area A.
  double band_probability_per_px = 0.0;
};

// The data distance T, not above `max_threshold_px`, at which the logarithm of the number of false alarms
// (eq. 3 of [30]) is smallest. Negative when none makes it meaningful (below one). `log_factorials`: at least
// data_px.size() + 1 values, written by fill_log_factorials.
double a_contrario_threshold_px(std::span<double> data_px, const AContrarioModel& model,
                                std::span<const double> log_factorials, double max_threshold_px);

// values[n] = ln n!, with the same bits on every processor.
void fill_log_factorials(std::span<double> values);

}  // namespace traygauge::paper
