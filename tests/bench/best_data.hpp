// The inputs of the stages of profile `best`, prepared once from a scene by the stages before them.
#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "core/card/card_alignment.hpp"
#include "core/image/gray_pyramid.hpp"
#include "core/stereo/dense_stereo.hpp"
#include "core/tracking/point_tracking.hpp"
#include "tests/bench/scene.hpp"
#include "tests/bench/workspace.hpp"

namespace traygauge::bench {

struct BestDataView {
  std::size_t index = 0;  // in the scene
  cv::Mat gray;           // of the frame
  cv::Mat labels;
  LabelRegions regions;
  GrayPyramid pyramid;
  Pose from_card;          // of the card's alignment alone
  Pose camera_from_table;  // as measured
  cv::Mat sampled;         // grey, over the dish's bottom
  cv::Mat sampled_labels;
};

// Reference first: the view that shows more of the dish, as in a measurement.
struct BestData {
  explicit BestData(const Scene& scene);
  BestData(const BestData&) = delete;
  BestData& operator=(const BestData&) = delete;

  TrackedView tracked(std::size_t i) const;
  std::array<StoredView, 2> stored() const;

  const Scene& scene;
  Configuration configuration;
  OwnedWorkspace<CardPattern> pattern;
  std::array<OwnedWorkspace<PyramidWorkspace>, 2> pyramids;
  bool is_complete = false;  // the scene could be measured
  std::array<BestDataView, 2> views;
  double top_mm = 0.0;   // nothing on the dish is higher above the table
  DisparityRange range;  // that is searched for heights up to it

 private:
  bool prepare_view(std::size_t i);
  bool sample_views();
};

}  // namespace traygauge::bench
