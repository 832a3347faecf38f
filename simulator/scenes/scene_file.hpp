// A scene that a person describes, in TOML.
#pragma once

#include <filesystem>

#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// Unknown keys are errors: they are typing mistakes. Throws InputError.
SceneDescription read_scene_file(const std::filesystem::path& file);

}  // namespace traygauge
