#include "core/paper/card/card_tracks.hpp"

#include <algorithm>

namespace traygauge::paper {

namespace {

// The matches of one feature with the pattern.
std::span<const Match> matches_of(std::int32_t feature, std::span<const Match> sorted) {
  const auto before = [](const Match& match, std::int32_t value) { return match.first < value; };
  const auto begin = std::lower_bound(sorted.begin(), sorted.end(), feature, before);
  auto end = begin;
  while (end != sorted.end() && end->first == feature) ++end;
  return {begin, end};
}

// The pattern's point on which both ends agree, or −1.
std::int32_t common_pattern_point(std::span<const Match> first, std::span<const Match> second) {
  for (const Match& a : first) {
    for (const Match& b : second) {
      if (a.second == b.second) return a.second;
    }
  }
  return -1;
}

}  // namespace

void build_card_tracks(const CardObservations& observations, BoundedList<CardTrack>& tracks) {
  tracks.clear();
  for (std::size_t m = 0; m < observations.first_second.size(); ++m) {
    if (observations.in_cloud[m] == 0) continue;
    const Match& match = observations.first_second[m];
    const auto of_first = matches_of(match.first, observations.first_pattern);
    const auto of_second = matches_of(match.second, observations.second_pattern);
    const std::int32_t point = common_pattern_point(of_first, of_second);
    if (point < 0) continue;
    tracks.push_back({observations.pattern_mm[static_cast<std::size_t>(point)],
                      observations.first_rays[static_cast<std::size_t>(match.first)],
                      observations.second_rays[static_cast<std::size_t>(match.second)],
                      observations.cloud[m]});
  }
}

}  // namespace traygauge::paper
