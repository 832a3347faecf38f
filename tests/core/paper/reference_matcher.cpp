#include "tests/core/paper/reference_matcher.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "core/image/pyramid.hpp"

namespace traygauge::test {
namespace {

constexpr int kBlockRows = 8;  // rows that share bands and the columns over which their paths run

int pixel(const cv::Mat_<std::uint8_t>& picture, int x, int y) {
  return picture(std::clamp(y, 0, picture.rows - 1), std::clamp(x, 0, picture.cols - 1));
}

bool is_set(const cv::Mat_<std::uint8_t>& mask, int x, int y) {
  return x >= 0 && y >= 0 && x < mask.cols && y < mask.rows && mask(y, x) != 0;
}

struct Reference {
  const TestPair& pair;
  const paper::StereoParams& params;

  int census_distance(int x, int partner, int y) const {
    const int radius = params.census_radius_px;
    int differing = 0;
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx) {
        const bool first = pixel(pair.first, x + dx, y + dy) > pixel(pair.first, x, y);
        const bool second = pixel(pair.second, partner + dx, y + dy) > pixel(pair.second, partner, y);
        differing += first != second;
      }
    }
    return differing;
  }

  int local_cost(int x, int y, int d) const {
    const bool census = params.cost == paper::MatchingCost::census;
    const int radius = params.census_radius_px;
    if (!is_set(pair.first_mask, x, y)) return 0;
    if (!is_set(pair.second_mask, x + d, y)) return census ? 4 * radius * (radius + 1) : params.sad_limit;
    if (census) return census_distance(x, x + d, y);
    return std::min(std::abs(pixel(pair.first, x, y) - pixel(pair.second, x + d, y)), params.sad_limit);
  }

  int correlation_cost(int x, int y, int d) const {
    const int radius = params.window_radius_px;
    const int area = (2 * radius + 1) * (2 * radius + 1);
    const auto weight = static_cast<float>(params.zncc_weight * area);
    if (!is_set(pair.first_mask, x, y)) return 0;
    if (!is_set(pair.second_mask, x + d, y)) return static_cast<int>(2.0F * weight + 0.5F);
    int a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx) {
        const int first = pixel(pair.first, x + dx, y + dy) - 128;
        const int second = pixel(pair.second, x + d + dx, y + dy) - 128;
        a += first, b += second, aa += first * first, bb += second * second, ab += first * second;
      }
    }
    const auto inverse_deviation = [&](int sum, int squares) {
      const int variation = area * squares - sum * sum;
      return variation > 0 ? 1.0F / std::sqrt(static_cast<float>(variation)) : 0.0F;
    };
    const float correlation =
        static_cast<float>(area * ab - a * b) * inverse_deviation(a, aa) * inverse_deviation(b, bb);
    return static_cast<int>(weight * (1.0F - correlation) + 0.5F);
  }

  int window_cost(int x, int y, int d) const {
    if (params.cost == paper::MatchingCost::zncc) return correlation_cost(x, y, d);
    int sum = 0;
    const int radius = params.window_radius_px;
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx) sum += local_cost(x + dx, y + dy, d);
    }
    return sum;
  }

  int smoothness(int x, int y) const {
    const int radius = params.variance_radius_px;
    const int window = 2 * params.window_radius_px + 1;
    int sum = 0, squares = 0;
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx) {
        const int value = pixel(pair.first, x + dx, y + dy);
        sum += value, squares += value * value;
      }
    }
    const auto area = static_cast<float>((2 * radius + 1) * (2 * radius + 1));
    const auto halving = static_cast<float>(params.smoothness_deviation * params.smoothness_deviation);
    const float mean = static_cast<float>(sum) / area;
    const float variance = std::max(static_cast<float>(squares) / area - mean * mean, 0.0F);
    const float cost =
        static_cast<float>(params.smoothness * window * window) * halving / (halving + variance);
    return static_cast<int>(std::clamp(cost, 1.0F, 8000.0F));
  }
};

struct Band {
  int lo = 0;
  int hi = -1;
};

int floor_divide(int a, int b) {
  return static_cast<int>(std::floor(static_cast<double>(a) / b));
}
int ceil_divide(int a, int b) {
  return static_cast<int>(std::ceil(static_cast<double>(a) / b));
}

// Bands of the columns lo … hi of a block, from the coarser level (empty: the whole range).
std::vector<Band> search_bands(const cv::Mat_<Disparity>& coarse, int top, int lo, int hi,
                               DisparityRange range, const paper::StereoParams& params) {
  std::vector<Band> bands(static_cast<std::size_t>(hi + 1), Band{range.min_px, range.max_px});
  if (coarse.empty()) return bands;
  std::vector<bool> known(bands.size(), false);
  for (int x = lo; x <= hi; ++x) {
    // The first column of a row stands for itself, every odd one after it for its coarse pixel.
    int low = 1 << 20, high = -(1 << 20);
    for (int y = top / 2 - params.band_reach_px; y <= (top + kBlockRows - 1) / 2 + params.band_reach_px;
         ++y) {
      for (int u = x / 2 - params.band_reach_px; u <= x / 2 + params.band_reach_px; ++u) {
        if (y < 0 || u < 0 || y >= coarse.rows || u >= coarse.cols || coarse(y, u) == kNoDisparity) continue;
        low = std::min<int>(low, coarse(y, u));
        high = std::max<int>(high, coarse(y, u));
      }
    }
    if (high < low) continue;
    const int fine_low = floor_divide(2 * low, kDisparityScale) - params.band_px;
    const int fine_high = ceil_divide(2 * high, kDisparityScale) + params.band_px;
    bands[static_cast<std::size_t>(x)] = {std::clamp(fine_low, range.min_px, range.max_px),
                                          std::clamp(fine_high, range.min_px, range.max_px)};
    known[static_cast<std::size_t>(x)] = true;
  }
  // Unknown ones take the nearest known to the left, before the first the first, and without any the range.
  const auto first = std::find(known.begin() + lo, known.end(), true);
  if (first == known.end()) return bands;
  Band last = bands[static_cast<std::size_t>(first - known.begin())];
  for (std::size_t x = static_cast<std::size_t>(lo); x < bands.size(); ++x) {
    if (known[x]) last = bands[x];
    bands[x] = last;
  }
  return bands;
}

// Viterbi over one row, every pair of states compared.
std::vector<int> best_path(const Reference& reference, int y, int lo, int hi,
                           const std::vector<Band>& bands) {
  constexpr int kHighestStep = 8000;
  std::vector<std::vector<int>> costs(static_cast<std::size_t>(hi + 1)), origins(costs.size());
  int best = 0;
  for (int x = lo; x <= hi; ++x) {
    const auto column = static_cast<std::size_t>(x);
    const Band band = bands[column];
    for (int d = band.lo; d <= band.hi; ++d) {
      int cost = x == lo ? 0 : kHighestStep;
      int origin = best;
      if (x > lo) {
        const Band previous = bands[column - 1];
        const int step = reference.smoothness(x, y);
        for (int from = std::min(d, previous.hi); from >= previous.lo; --from) {
          const int path =
              costs[column - 1][static_cast<std::size_t>(from - previous.lo)] + step * (d - from);
          if (path < cost) cost = path, origin = from;
        }
        if (d + 1 >= previous.lo && d + 1 <= previous.hi) {
          const int path = costs[column - 1][static_cast<std::size_t>(d + 1 - previous.lo)] + step;
          if (path < cost) cost = path, origin = d + 1;
        }
      }
      costs[column].push_back(cost + reference.window_cost(x, y, d));
      origins[column].push_back(origin);
    }
    const auto lowest = std::min_element(costs[column].begin(), costs[column].end());
    best = band.lo + static_cast<int>(lowest - costs[column].begin());
    const int lowest_cost = *lowest;
    for (int& cost : costs[column]) cost -= lowest_cost;
  }
  std::vector<int> path(static_cast<std::size_t>(hi + 1));
  for (int x = hi; x >= lo; --x) {
    path[static_cast<std::size_t>(x)] = best;
    best = origins[static_cast<std::size_t>(x)]
                  [static_cast<std::size_t>(best - bands[static_cast<std::size_t>(x)].lo)];
  }
  return path;
}

int subpixel(const Reference& reference, int x, int y, int d, Band band) {
  if (d == band.lo || d == band.hi) return 0;
  const int before = reference.window_cost(x, y, d - 1);
  const int middle = reference.window_cost(x, y, d);
  const int after = reference.window_cost(x, y, d + 1);
  if (before < middle || after < middle || before + after == 2 * middle) return 0;
  return static_cast<int>(std::lround(8.0 * (before - after) / (before - 2 * middle + after)));
}

cv::Mat_<Disparity> median(const cv::Mat_<Disparity>& picture, int radius) {
  cv::Mat_<Disparity> filtered = picture.clone();
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      if (picture(y, x) == kNoDisparity) continue;
      std::vector<Disparity> known;
      for (int v = std::max(y - radius, 0); v <= std::min(y + radius, picture.rows - 1); ++v) {
        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, picture.cols - 1); ++u) {
          if (picture(v, u) != kNoDisparity) known.push_back(picture(v, u));
        }
      }
      std::sort(known.begin(), known.end());
      filtered(y, x) = known[known.size() / 2];
    }
  }
  return filtered;
}

cv::Mat_<Disparity> match_level(const TestPair& pair, const cv::Mat_<Disparity>& coarse, DisparityRange range,
                                const paper::StereoParams& params) {
  const Reference reference{pair, params};
  cv::Mat_<Disparity> disparity(pair.first.size(), kNoDisparity);
  for (int top = 0; top < pair.first.rows; top += kBlockRows) {
    const int bottom = std::min(top + kBlockRows, pair.first.rows);
    const cv::Mat block = pair.first_mask.rowRange(top, bottom);
    const cv::Rect masked = cv::boundingRect(block);
    if (masked.empty()) continue;
    const int lo = masked.x;
    const int hi = masked.x + masked.width - 1;
    const auto bands = search_bands(coarse, top, lo, hi, range, params);
    for (int y = top; y < bottom; ++y) {
      const auto path = best_path(reference, y, lo, hi, bands);
      for (int x = lo; x <= hi; ++x) {
        bool has_partner = false;
        for (int d = range.min_px; d <= range.max_px; ++d) has_partner |= is_set(pair.second_mask, x + d, y);
        if (!is_set(pair.first_mask, x, y) || !has_partner) continue;
        const int d = path[static_cast<std::size_t>(x)];
        disparity(y, x) = static_cast<Disparity>(
            kDisparityScale * d + subpixel(reference, x, y, d, bands[static_cast<std::size_t>(x)]));
      }
    }
  }
  return median(disparity, params.median_radius_px);
}

TestPair halve_pair(const TestPair& pair) {
  const auto reduce = [](const cv::Mat_<std::uint8_t>& source, auto&& function) {
    cv::Mat_<std::uint8_t> target(halved(source.rows), halved(source.cols));
    function(view_of(source), view_of(target));
    return target;
  };
  TestPair coarse;
  coarse.first = reduce(pair.first, halve);
  coarse.second = reduce(pair.second, halve);
  coarse.first_mask = reduce(pair.first_mask, halve_mask);
  coarse.second_mask = reduce(pair.second_mask, halve_mask);
  return coarse;
}

}  // namespace

cv::Mat_<Disparity> match_by_definition(const TestPair& pair, DisparityRange range,
                                        const paper::StereoParams& params) {
  std::vector<TestPair> pyramid{pair};
  for (int level = 1; level < params.levels; ++level) pyramid.push_back(halve_pair(pyramid.back()));
  cv::Mat_<Disparity> disparity;
  for (int level = params.levels - 1; level >= 0; --level) {
    const DisparityRange level_range{floor_divide(range.min_px, 1 << level),
                                     ceil_divide(range.max_px, 1 << level)};
    disparity = match_level(pyramid[static_cast<std::size_t>(level)], disparity, level_range, params);
  }
  return disparity;
}

}  // namespace traygauge::test
