#include <cmath>
#include <memory>

#include "tests/bench/comparisons.hpp"
#include "tests/bench/opencv_measurement.hpp"

namespace traygauge::bench {
namespace {

std::map<int, double> volumes_of(const Measurement& measurement) {
  std::map<int, double> volumes_ml;
  for (const ItemResult& item : measurement.items) {
    if (item.status == StatusCode::ok) volumes_ml[item.label] = item.volume_ml;
  }
  return volumes_ml;
}

template <class AnySession>
Comparison compare(const Scene& scene) {
  const auto session = std::make_shared<AnySession>(scene);
  const auto ours = [&scene, session] { return scene.error_percent(volumes_of(session->measure())); };
  const auto peer = [&scene, pattern = prepare_pattern(scene)] {
    return scene.error_percent(measure_by_opencv(scene, pattern));
  };
  return {scene.name + ", " + name_of<AnySession>(),
          "% volume error",
          {{"ours, whole measurement", ours}, {"OpenCV's parts, no bundle fit", peer}}};
}

}  // namespace

Comparison compare_measurement(const Scene& scene) {
  return compare<Session>(scene);
}

Comparison compare_paper_measurement(const Scene& scene) {
  return compare<PaperSession>(scene);
}

}  // namespace traygauge::bench
