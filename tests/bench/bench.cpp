// Speed of each stage and of the whole measurement beside peers from OpenCV, in one run on the same data, and
// the reported times against an outside clock. Pictures come from TRAYGAUGE_CAPTURES, else from a closed
// form.
#include <cstdio>
#include <opencv2/core.hpp>

#include "tests/bench/clock_check.hpp"
#include "tests/bench/comparisons.hpp"

int main(int argc, char** argv) {
  using namespace traygauge::bench;
  cv::setNumThreads(1);
  std::vector<Scene> scenes;
  for (const char* capture : {"meals/m01", "meals/m06"}) {
    if (auto scene = load_capture_scene(capture)) scenes.push_back(std::move(*scene));
  }
  if (scenes.empty()) {
    std::printf("TRAYGAUGE_CAPTURES names no captures: measuring a synthetic scene.\n");
    scenes.push_back(render_scene());
  }

  bool holds = true;
  for (const Scene& scene : scenes) holds = check_reported_time(scene) && holds;
  if (!holds) return 1;

  const StageData data(scenes.front());
  if (data.rectified[0].empty()) {
    std::printf("%s: the stages cannot be compared.\n", data.scene.name.c_str());
    return 1;
  }
  std::vector<Comparison> comparisons = compare_sparse_stages(data);
  for (Comparison& comparison : compare_dense_stages(data)) comparisons.push_back(std::move(comparison));
  for (const Scene& scene : scenes) comparisons.push_back(compare_measurement(scene));
  return run_comparisons(comparisons, argc, argv) ? 0 : 1;
}
