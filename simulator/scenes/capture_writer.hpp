// Scenes rendered into capture folders.
#pragma once

#include <filesystem>
#include <functional>

#include "simulator/render/render_settings.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// Whether `folder` holds all files of a capture of this scene, by its origin.
bool is_complete_capture(const std::filesystem::path& folder, const SceneDescription& scene);

// Writes capture.json of such a folder anew where this program describes the scene otherwise than the one
// that rendered it. Throws OutputError.
void update_description(const std::filesystem::path& folder, const SceneDescription& scene);

// Renders every view of the scene and stores them with capture.json and truth.json in `folder`, which appears
// only when it is complete. `progress` is called with the share that is done. Throws InputError, OutputError,
// and std::invalid_argument for a scene that makes no sense.
void render_capture(const SceneDescription& scene, const std::filesystem::path& folder,
                    const RenderSettings& settings, const std::function<void(double share)>& progress);

}  // namespace traygauge
