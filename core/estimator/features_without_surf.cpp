// Stands in for feature_preparation.cpp and pattern_preparation.cpp where SURF is not built.
#include "core/estimator/estimator_state.hpp"
#include "core/estimator/feature_preparation.hpp"

namespace traygauge {

Status validate_feature_search(const Configuration&) {
  return StatusCode::surf_not_built;
}

Status prepare_features(const Configuration&, PreparationWorkspace&, PreparedView&) {
  return StatusCode::surf_not_built;
}

void EstimatorState::set_up_pattern(ImageView<const std::uint8_t>) {}

}  // namespace traygauge
