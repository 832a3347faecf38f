// What a segmentation found, for people and for scripts.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "firmware/segment/label_scores.hpp"
#include "firmware/segment/pair_labels.hpp"

namespace traygauge {

struct SegmentReport {
  std::string capture;  // as named by the caller
  std::array<int, 2> pair{};
  std::string message;
  const PairLabels* drawn = nullptr;  // outlives the report
  // Against the capture's own labels, where both views have them.
  std::optional<std::array<LabelScores, 2>> scores;
};

// One JSON document on one line.
std::string compose_segment_document(const SegmentReport& report);

// The same for people.
std::string compose_segment_table(const SegmentReport& report);

}  // namespace traygauge
