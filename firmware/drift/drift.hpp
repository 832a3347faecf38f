// Whether what many trays say together is too far off: a worn card or a lens that was moved shows there long
// before a single tray is refused.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "firmware/drift/check_values.hpp"
#include "firmware/drift/median_estimate.hpp"

namespace traygauge {

struct DriftParams {
  // A median is taken over so many scans. Dishes of a kind differ by 0.5 mm, which is 0.2 % of a plate; the
  // median of 50 is then sure to 0.04 %. A fault that comes at once has half of them after 26 trays.
  std::size_t values = 50;
  // With so many, the standard error itself is sure to a quarter.
  std::size_t min_values = 20;
  // The 50 are sought among so many scans at an end of what is stored: where a painted rim keeps nine of ten
  // dishes from being compared, the others still reach `min_values`. A station takes 40 kB.
  std::size_t scans_looked_at = 200;
  // A site has a few stations a hub. Those beyond are not watched, so that memory stays bounded.
  std::size_t max_stations = 64;
  // Where ten values are watched, one is by chance beyond two of its standard errors in a third of the time,
  // beyond three in 3 % of it.
  double sigmas = 3.0;
  // Of a change since the first scans. In a volume three times as much: half of the mean error of a good
  // capture.
  double max_scale_change_percent = 0.3;
  // Over a dish 25 mm deep, 0.8 % of a volume.
  double max_dish_height_change_mm = 0.2;
  // From the first scan on. Light and shade along a rim shift the edge that a picture shows: medians of up to
  // 0.3 % and 0.6 mm at ten rendered stations at which nothing is wrong (tests/evaluation/experiments.md, "A
  // card that is bent or leans").
  double max_scale_percent = 0.6;
  double max_dish_height_mm = 1.0;
  // Twice that of an edge: an inner surface is described by a curve that was fitted to it.
  double max_glaze_height_mm = 0.4;
  // Of the blur at first. Good pictures have 0.80 to 0.96 px, so that other trays alone make no such ratio;
  // from 1.17 px it is a third to the 1.5 px from which volumes suffer.
  double max_blur_ratio = 1.3;
  // A station from which nothing came for longer is gone: no holiday lasts so long.
  std::chrono::days forgotten_after{90};
};

// What the scans of a station say of one value together.
struct CheckTrend {
  WatchedCheck check = WatchedCheck::scale_percent;
  MedianEstimate last;                  // over the last scans that have it
  std::optional<MedianEstimate> first;  // over the first scans that are stored, where these are others
  bool drifts = false;
};

// Scale and heights are compared with zero, because two rulers should agree; scale, edges and blur with
// `first`, against which a smaller change is told.
CheckTrend judge_trend(WatchedCheck check, const MedianEstimate& last,
                       const std::optional<MedianEstimate>& first, const DriftParams& params);

// For a value that drifts: what was found and what to do, for people.
std::string drift_sentence(const CheckTrend& trend);

}  // namespace traygauge
