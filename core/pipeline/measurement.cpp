#include "core/pipeline/measurement.hpp"

#include <algorithm>

namespace traygauge {
namespace {

// In the order of Stage.
constexpr std::array<const char*, kStageCount> kStageNames = {
    "image", "features", "matching", "pose", "scale", "rectification", "stereo", "surface", "volume"};

}  // namespace

const char* name(Stage stage) {
  return kStageNames[static_cast<std::size_t>(stage)];
}

bool is_measured(Status status) {
  return status.ok() || status.code() == StatusCode::partial;
}

bool is_measured(const Measurement& measurement) {
  return is_measured(measurement.status);
}

Status summarise(std::span<const ItemResult> items) {
  const auto is_measured = [](const ItemResult& item) { return item.status == StatusCode::ok; };
  const auto measured = std::count_if(items.begin(), items.end(), is_measured);
  if (measured == static_cast<std::ptrdiff_t>(items.size())) return StatusCode::ok;
  return measured > 0 ? StatusCode::partial : items.front().status;
}

}  // namespace traygauge
