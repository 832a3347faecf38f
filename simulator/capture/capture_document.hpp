// Parts of capture.json, as every writer of captures needs them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "simulator/capture/capture.hpp"

namespace traygauge {

nlohmann::ordered_json compose_camera(const CameraDescription& camera);

}  // namespace traygauge
