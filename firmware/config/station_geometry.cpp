// What a station knows of lens, arm and card, and whether it still holds.
#include <cmath>

#include "firmware/config/station_file.hpp"

namespace traygauge {

double ArmGeometry::angle_deg() const {
  return std::hypot(turn_deg[0], turn_deg[1], turn_deg[2]);
}

std::string find_lens_change(const LensConfig& lens, const V4l2CameraParams& camera,
                             std::optional<int> focus) {
  const PictureSize& size = lens.camera.size;
  const PictureSize taken{camera.mode.width, camera.mode.height};
  const std::string again = "; calibrate the lens again (traygauge calibrate lens).";
  if (size != taken) {
    return "The lens was calibrated with pictures of " + size_text(size) + ", the camera takes " +
           size_text(taken) + "; set camera.width and height to the former, or calibrate again.";
  }
  if (!lens.calibrated_camera.empty() && lens.calibrated_camera != camera.device) {
    return "The lens was calibrated on camera " + lens.calibrated_camera + ", this is " + camera.device +
           again;
  }
  if (!lens.changed_on.empty() && (lens.calibrated_on.empty() || lens.calibrated_on < lens.changed_on)) {
    return "The lens was changed on " + lens.changed_on + " and calibrated " +
           (lens.calibrated_on.empty() ? "on an unknown day" : "before, on " + lens.calibrated_on) + again;
  }
  if (lens.focus && focus && *focus != *lens.focus) {
    return "The lens was calibrated at focus " + std::to_string(*lens.focus) + " and stands at " +
           std::to_string(*focus) + "; set camera.focus to the former, or calibrate again.";
  }
  return {};
}

void require_geometry(const StationFile& station) {
  const auto require = [&station](const std::optional<LensConfig>& lens, const V4l2CameraParams& camera,
                                  const char* key) {
    if (!lens) {
      throw InputError({station.file, key}, "fx, fy, cx, cy and distortion of the lens", "nothing",
                       "run traygauge calibrate lens, or write them there");
    }
    const PictureSize& size = lens->camera.size;
    const PictureSize taken{camera.mode.width, camera.mode.height};
    if (size == taken) return;
    throw InputError({station.file, std::string(key) + ".width"},
                     "the camera's pictures, " + size_text(taken), size_text(size),
                     "take pictures of that size, or calibrate the lens again");
  };
  require(station.lens, station.camera, "lens");
  if (station.second_camera) require(station.second_lens, *station.second_camera, "second_lens");
  if (!station.card) {
    throw InputError({station.file, "card"}, "pattern, width_mm, height_mm and thickness_mm of the card",
                     "nothing", "describe the reference card there");
  }
}

}  // namespace traygauge
