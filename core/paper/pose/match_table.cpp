#include "core/paper/pose/match_table.hpp"

#include <algorithm>

#include "core/paper/pose/epipolar.hpp"

namespace traygauge::paper {
namespace {

constexpr std::size_t kMatchLanes = 4;   // matches computed side by side
constexpr std::size_t kCheckEvery = 64;  // matches between two looks at whether a model can still win
using MatchLanes = Eigen::Array<double, kMatchLanes, 1>;

MatchLanes load(std::span<const double> values, std::size_t i) {
  return Eigen::Map<const MatchLanes, Eigen::AlignedMax>(values.data() + i);
}

// Distances of the matches i, i + 1, i + 2, i + 3: the same operations as symmetric_epipolar_distance_px.
MatchLanes distances_px(const EpipolarTerms<MatchLanes>& terms, double focal_px) {
  const auto fraction = squared_distance_fraction(terms);
  return focal_px * (fraction.numerator / fraction.denominator.max(kMinDenominator)).sqrt();
}

}  // namespace

bool MatchTable::push_back(const RayMatch& match) {
  if (size_ == capacity()) return false;
  x1_[size_] = match.first.x();
  y1_[size_] = match.first.y();
  x2_[size_] = match.second.x();
  y2_[size_] = match.second.y();
  ++size_;
  return true;
}

void MatchTable::measure_distances(const Mat3& essential, double focal_px,
                                   std::span<double> distances) const {
  std::size_t i = 0;
  for (; i + kMatchLanes <= size_; i += kMatchLanes) {
    const auto terms =
        epipolar_terms<MatchLanes>(essential, load(x1_, i), load(y1_, i), load(x2_, i), load(y2_, i));
    Eigen::Map<MatchLanes>(distances.data() + i) = distances_px(terms, focal_px);
  }
  for (; i < size_; ++i) distances[i] = symmetric_epipolar_distance_px(essential, (*this)[i], focal_px);
}

std::size_t MatchTable::count_inliers(const Mat3& essential, double focal_px, double threshold_px,
                                      std::size_t to_beat) const {
  const double limit = (threshold_px / focal_px) * (threshold_px / focal_px);
  std::size_t count = 0;
  for (std::size_t start = 0; start < size_; start += kCheckEvery) {
    if (count + (size_ - start) <= to_beat) return count;
    const std::size_t end = std::min(start + kCheckEvery, size_);
    MatchLanes hits = MatchLanes::Zero();
    std::size_t i = start;
    for (; i + kMatchLanes <= end; i += kMatchLanes) {
      const auto fraction = squared_distance_fraction(
          epipolar_terms<MatchLanes>(essential, load(x1_, i), load(y1_, i), load(x2_, i), load(y2_, i)));
      hits +=
          (fraction.numerator <= limit * fraction.denominator).select(MatchLanes::Ones(), MatchLanes::Zero());
    }
    count += static_cast<std::size_t>(hits.sum());
    for (; i < end; ++i) {
      const auto fraction =
          squared_distance_fraction(epipolar_terms<double>(essential, x1_[i], y1_[i], x2_[i], y2_[i]));
      count += fraction.numerator <= limit * fraction.denominator ? 1U : 0U;
    }
  }
  return count;
}

double MatchTable::fitness(const Mat3& essential, double focal_px, double threshold_px,
                           double to_beat) const {
  double fitness = 0.0;
  for (std::size_t start = 0; start < size_; start += kCheckEvery) {
    if (fitness + static_cast<double>(size_ - start) * threshold_px <= to_beat) return fitness;
    const std::size_t end = std::min(start + kCheckEvery, size_);
    MatchLanes sum = MatchLanes::Zero();
    std::size_t i = start;
    for (; i + kMatchLanes <= end; i += kMatchLanes) {
      const auto terms =
          epipolar_terms<MatchLanes>(essential, load(x1_, i), load(y1_, i), load(x2_, i), load(y2_, i));
      sum += (threshold_px - distances_px(terms, focal_px)).max(0.0);
    }
    fitness += sum.sum();
    for (; i < end; ++i) {
      const double distance = symmetric_epipolar_distance_px(essential, (*this)[i], focal_px);
      fitness += std::max(threshold_px - distance, 0.0);
    }
  }
  return fitness;
}

}  // namespace traygauge::paper
