#include "core/paper/matching/matcher.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge::paper {

namespace {

FeatureSet first_features(const FeatureSet& features, std::size_t cap) {
  const std::size_t count = std::min({features.keypoints.size(), features.descriptors.size(), cap});
  return {features.keypoints.first(count), features.descriptors.first(count)};
}

// The place of `index` among the `top` nearest, or `top`.
int rank_of(std::int32_t index, const Neighbours& neighbours, int top) {
  int rank = 0;
  while (rank < top && neighbours.index[static_cast<std::size_t>(rank)] != index) ++rank;
  return rank;
}

// Whether the neighbour of this rank is clearly nearer than the next. Two exact copies are not distinct.
bool is_distinct(const Neighbours& neighbours, int rank, float ratio) {
  if (ratio <= 1.0F) return true;
  const auto place = static_cast<std::size_t>(rank);
  const float next = neighbours.square[place + 1];
  return next > 0.0F && next >= ratio * ratio * neighbours.square[place];
}

std::size_t collect_symmetric(std::size_t first_count, const MatcherParams& params, int top,
                              MatcherWorkspace& workspace) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < first_count; ++i) {
    const Neighbours& forward = workspace.of_first[i];
    for (int rank = 0; rank < top; ++rank) {
      const std::int32_t j = forward.index[static_cast<std::size_t>(rank)];
      if (j < 0) break;
      const Neighbours& backward = workspace.of_second[static_cast<std::size_t>(j)];
      const int rank_back = rank_of(static_cast<std::int32_t>(i), backward, top);
      if (rank_back == top || !is_distinct(forward, rank, params.distinctiveness_ratio) ||
          !is_distinct(backward, rank_back, params.distinctiveness_ratio)) {
        continue;
      }
      const float distance = std::sqrt(forward.square[static_cast<std::size_t>(rank)]);
      workspace.candidates[found++] = {static_cast<std::int32_t>(i), j, distance};
    }
  }
  return found;
}

bool comes_before(const Match& a, const Match& b) {
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}

bool is_nearer(const Match& a, const Match& b) {
  return a.distance != b.distance ? a.distance < b.distance : comes_before(a, b);
}

}  // namespace

void match_features(const FeatureSet& first, const FeatureSet& second, const MatcherParams& params,
                    MatcherWorkspace& workspace, BoundedList<Match>& matches) {
  const FeatureSet a = first_features(first, workspace.of_first.size());
  const FeatureSet b = first_features(second, workspace.of_second.size());
  const int top = std::clamp(params.top_ranking, 1, kMaxNeighbours - 1);
  find_nearest_neighbours(a, b, top + 1, workspace.search, workspace.of_first.first(a.descriptors.size()),
                          workspace.of_second.first(b.descriptors.size()));
  const std::size_t found = collect_symmetric(a.descriptors.size(), params, top, workspace);
  const auto candidates = workspace.candidates.first(found);

  const double share = std::clamp(static_cast<double>(params.distance_cutoff), 0.0, 1.0);
  const std::size_t kept = found - static_cast<std::size_t>(std::floor(share * static_cast<double>(found)));
  const std::size_t fitting = std::min(kept, matches.capacity());
  if (fitting < found) std::sort(candidates.begin(), candidates.end(), is_nearer);
  std::sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(fitting), comes_before);
  matches.clear();
  for (const Match& match : candidates.first(kept)) matches.push_back(match);
}

}  // namespace traygauge::paper
