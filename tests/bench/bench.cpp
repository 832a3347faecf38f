// Speed of each stage and of the whole measurement beside peers from OpenCV, in one run on the same data, and
// the reported times against an outside clock. Pictures come from TRAYGAUGE_CAPTURES, else from a closed
// form.
#include <cstdio>
#include <opencv2/core.hpp>

#include "tests/bench/clock_check.hpp"
#include "tests/bench/comparisons.hpp"

int main(int argc, char** argv) {
  using namespace traygauge::bench;
  using traygauge::PixelFormat;
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
  for (const Scene& scene : scenes) {
    holds = check_reported_time(scene) && holds;
    holds = check_reported_paper_time(scene) && holds;
  }
  if (!holds) return 1;

  const BestData best(scenes.front());
  const StageData paper(scenes.front());
  if (!best.is_complete || paper.rectified[0].empty()) {
    std::printf("%s: the stages cannot be compared.\n", scenes.front().name.c_str());
    return 1;
  }
  std::vector<Comparison> comparisons;
  const auto add = [&](std::vector<Comparison> more) {
    for (Comparison& comparison : more) comparisons.push_back(std::move(comparison));
  };
  add(compare_best_sparse_stages(best));
  add(compare_best_dense_stages(best));
  add(compare_sparse_stages(paper));
  add(compare_dense_stages(paper));
  for (const Scene& scene : scenes) {
    const bool is_coloured = scene.frames[0].format != PixelFormat::gray8;
    if (is_coloured) comparisons.push_back(compare_segmentation(scene));
    comparisons.push_back(compare_measurement(scene));
    comparisons.push_back(compare_paper_measurement(scene));
  }
  return run_comparisons(comparisons, argc, argv) ? 0 : 1;
}
