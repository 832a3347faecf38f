// What the pictures of a capture were made from, as a short name.
#pragma once

#include <string>

#include "simulator/render/render_settings.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// The generator's version and a hash of all that pictures and truth depend on: the scene with its dishes, the
// bytes of scanned meshes, and the settings. Left out: names, and what an arm says of its angle. Throws
// InputError for a mesh that cannot be read.
std::string digest_of(const SceneDescription& scene, const RenderSettings& settings);

}  // namespace traygauge
