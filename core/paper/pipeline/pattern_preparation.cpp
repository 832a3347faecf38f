#include <algorithm>

#include "core/paper/image/integral.hpp"
#include "core/paper/pipeline/estimator_state.hpp"
#include "core/paper/pipeline/feature_preparation.hpp"

namespace traygauge::paper {

// The card's picture is reduced to about the scale at which cameras see it, so that box filters meet like
// structures.
void EstimatorState::set_up_pattern(ImageView<const std::uint8_t> picture) {
  PreparationWorkspace& scratch = memory.preparation;
  const double wanted_px = configuration.view.card_px_per_mm * configuration.card.width_mm;
  const double scale = fit_search_scale(std::min(1.0, wanted_px / picture.width), picture.width,
                                        picture.height, configuration);
  const int width = std::max(1, static_cast<int>(picture.width * scale));
  const int height = std::max(1, static_cast<int>(picture.height * scale));
  const ImageView<std::uint8_t> reduced{scratch.feature_picture.data(), width, height};
  reduce_area(picture, reduced);
  const ImageView<std::uint32_t> integral{scratch.integral.data(), width + 1, height + 1};
  build_integral(reduced, integral);
  BoundedList<Keypoint>& keypoints = memory.pattern.keypoints;
  detect_surf(integral, configuration.surf, scratch.surf, keypoints);
  describe_surf(integral, configuration.surf, keypoints.items(),
                memory.pattern.descriptors.first(keypoints.size()));
  place_pattern(width);
}

}  // namespace traygauge::paper
