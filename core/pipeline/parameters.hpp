// All parameters that have a name, by the profile that reads them.
#pragma once

#include "core/paper/pipeline/parameters.hpp"
#include "core/pipeline/configuration.hpp"
#include "core/pipeline/dense_parameters.hpp"
#include "core/pipeline/segmenter_parameters.hpp"
#include "core/pipeline/sparse_parameters.hpp"

namespace traygauge {

// Those that both profiles read. `Config` and `visit` as in paper_parameters.hpp.
template <class Config, class Visit>
void visit_shared_parameters(Config& c, Visit&& visit) {
  using Range = ParameterRange;
  visit("geometry.min_angle_deg", c.geometry.min_angle_deg, Range{0, 180});
  visit("geometry.max_angle_deg", c.geometry.max_angle_deg, Range{0, 180});
  visit("geometry.small_angle_deg", c.geometry.small_angle_deg, Range{0, 180});
  visit("geometry.large_angle_deg", c.geometry.large_angle_deg, Range{0, 180});
}

// Those that one profile alone reads, in the order of its stages.
template <class Config, class Visit>
void visit_parameters_of(Profile profile, Config& c, Visit&& visit) {
  if (profile == Profile::paper) {
    visit_paper_features(c, visit);
    visit_paper_pose(c, visit);
    visit_paper_surface(c, visit);
    return;
  }
  visit_card_parameters(c.best, visit);
  visit_tracking_parameters(c.best, visit);
  visit_joint_parameters(c.best, visit);
  visit_surface_parameters(c.best, visit);
  visit_height_parameters(c.best, visit);
  visit_round_body_parameters(c.best, visit);
  visit_volume_parameters(c.best, visit);
}

}  // namespace traygauge
