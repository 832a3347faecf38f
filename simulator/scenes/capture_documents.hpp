// capture.json and truth.json of a scene.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "simulator/scenes/laid_scene.hpp"

namespace traygauge {

nlohmann::ordered_json compose_capture(const SceneDescription& scene);

// `visible`: for each view how many pixels each label has.
nlohmann::ordered_json compose_truth(const LaidScene& laid,
                                     const std::vector<std::vector<std::size_t>>& visible);

}  // namespace traygauge
