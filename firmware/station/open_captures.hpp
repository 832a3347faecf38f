// How a station comes by the captures that it plays.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace traygauge {

class MeasurableCaptures;

// How captures are outlined, as typed.
struct LabelChoice {
  std::string source;  // given, auto, or empty: auto for captures without label pictures
  int items = 0;       // on each tray, where they are found; 0: not known
};

// Reads what belongs to these folders, of which there is at least one; throws where a file or key of it is
// not as expected.
using OpenCaptures = std::unique_ptr<MeasurableCaptures>(const std::vector<std::filesystem::path>& folders,
                                                         const LabelChoice& labels);

// With the real measurement: a RecordedCaptures.
std::unique_ptr<MeasurableCaptures> open_recorded_captures(const std::vector<std::filesystem::path>& folders,
                                                           const LabelChoice& labels);

}  // namespace traygauge
