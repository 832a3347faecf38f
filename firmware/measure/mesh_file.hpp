// The food surface as a PLY file.
#pragma once

#include <filesystem>
#include <string>

#include "core/geometry/camera.hpp"
#include "core/paper/pipeline/working_pictures.hpp"
#include "core/pipeline/measurement.hpp"
#include "simulator/capture/picture.hpp"

namespace traygauge {

// False when the measurement did not come as far as a surface over a dish.
bool has_surface(const Measurement& measurement, const paper::WorkingPictures* pictures);

// Binary little-endian PLY: vertices in mm, z up from the bottom of the dish, origin under the middle of the
// food; colour from `picture` (the reference view as stored, seen through `lens`) and label; faces
// counter-clockwise from above, with label.
std::string compose_mesh(const Measurement& measurement, const paper::WorkingPictures* pictures,
                         const Picture& picture, const LensModel& lens);

// Throws OutputError.
void write_mesh(const std::filesystem::path& file, const std::string& mesh);

}  // namespace traygauge
