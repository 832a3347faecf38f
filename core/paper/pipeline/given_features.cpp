#include "core/paper/pipeline/feature_preparation.hpp"

namespace traygauge {

Status take_features(std::span<const Keypoint> keypoints, std::span<const Descriptor> descriptors,
                     const ViewParams& params, PreparedView& view) {
  if (keypoints.size() != descriptors.size()) return StatusCode::invalid_configuration;
  view.keypoints.clear();
  view.keypoints_found = keypoints.size();
  for (std::size_t i = 0; i < keypoints.size() && !view.keypoints.full(); ++i) {
    const std::size_t at = view.keypoints.size();
    Vec2 ray;
    if (!view.lens.undistort_pixel(keypoints[i].pixel, ray)) continue;
    view.keypoints.push_back(keypoints[i]);
    view.ray_storage[at] = ray;
    view.descriptor_storage[at] = descriptors[i];
  }
  return view.keypoints.size() < static_cast<std::size_t>(params.min_keypoints) ? StatusCode::too_few_features
                                                                                : StatusCode::ok;
}

}  // namespace traygauge
