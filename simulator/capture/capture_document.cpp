#include "simulator/capture/capture_document.hpp"

#include <nlohmann/json.hpp>

namespace traygauge {

nlohmann::ordered_json compose_camera(const CameraDescription& camera) {
  return {{"width", camera.size.width},
          {"height", camera.size.height},
          {"fx", camera.fx_px},
          {"fy", camera.fy_px},
          {"cx", camera.cx_px},
          {"cy", camera.cy_px},
          {"distortion", camera.coefficients()}};
}

}  // namespace traygauge
